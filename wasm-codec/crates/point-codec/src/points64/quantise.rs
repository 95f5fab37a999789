//! A point's coordinates and colour as integers.

use bytemuck::must_cast;
use wide::{f32x4, i16x8, i32x4};

use crate::Point;

/// Metres to int16 millimetres: rounded half away from zero, saturating at ±32767. The product is exact in `f64`, so
/// every implementation that follows the rule gives the same integer.
#[inline]
#[must_use]
pub fn quantise(metres: f32) -> i16 {
    let mm = f64::from(metres) * 1000.0;
    // The cast truncates toward zero, saturates, and takes NaN to 0.
    let rounded = (mm + 0.5_f64.copysign(mm)) as i32;
    rounded.clamp(-i32::from(i16::MAX), i32::from(i16::MAX)) as i16
}

/// True where [`quantise`] cannot give the nearest millimetre.
#[inline]
#[must_use]
pub fn saturates(metres: f32) -> bool {
    f64::from(metres).abs() * 1000.0 >= 32767.5
}

/// Bytes R, G, B, A (R lowest) to 6-6-4 bits, R highest, by truncation.
#[inline]
#[must_use]
pub const fn colour_664(rgba: u32) -> u16 {
    ((rgba & 0xfc) << 8 | rgba >> 6 & 0x3f0 | rgba >> 20 & 0xf) as u16
}

/// The coordinates in the lower 48 bits, and the colour.
#[inline(always)]
pub(super) fn quantise_point(point: Point, saturated: &mut usize) -> (u64, u16) {
    let coordinates = quantise_vector(point).unwrap_or_else(|| {
        let [x, y, z, _] = point;
        *saturated += usize::from(saturates(x) | saturates(y) | saturates(z));
        let bits = |c: f32| u64::from(quantise(c) as u16);
        bits(x) | bits(y) << 16 | bits(z) << 32
    });
    (coordinates, colour_664(point[3].to_bits()))
}

/// x, y and z as [`quantise`] gives them, in the lower 48 bits, and nothing of meaning above; `None` where single precision cannot tell.
#[inline(always)]
fn quantise_vector(point: Point) -> Option<u64> {
    // Products and sums up to 32767.5 are off by at most 2⁻⁹ together: nearer than that to a whole number, the lower one
    // and the upper one are both possible.
    const DOUBT: f32 = 1.0 / 256.0;
    // The colour is no number to calculate with.
    let metres: i32x4 = must_cast::<Point, i32x4>(point) & i32x4::new([-1, -1, -1, 0]);
    let mm = must_cast::<i32x4, f32x4>(metres).abs() * f32x4::splat(1000.0);
    let shifted = mm + f32x4::splat(0.5);
    let whole = shifted.floor();
    let rest = shifted - whole;
    let sure = rest.simd_ge(f32x4::splat(DOUBT))
        & rest.simd_le(f32x4::splat(1.0 - DOUBT))
        & mm.simd_le(f32x4::splat(32767.0));
    if sure.to_bitmask() & 0b111 != 0b111 {
        return None;
    }
    // In 2²³ + n the lower bits of the mantissa are n.
    let magnitude = must_cast::<f32x4, i32x4>(whole + f32x4::splat(8_388_608.0)) & i32x4::splat(0x7fff);
    let sign: i32x4 = metres >> 31;
    let mm = (magnitude ^ sign) - sign;
    let narrow: [u64; 2] = must_cast(i16x8::from_i32x8_saturate(must_cast([mm, mm])));
    Some(narrow[0])
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::points64::LATENCY_TEST_COLOUR;
    use proptest::prelude::*;

    /// Coordinates of all sizes, many of them on or next to half a millimetre.
    pub fn coordinate() -> impl Strategy<Value = f32> {
        prop_oneof![
            -40.0_f32..40.0,
            any::<f32>(),
            (-65_540_i32..65_540, -2_i32..3).prop_map(|(half, ulps)| {
                let metres = half as f32 / 2000.0;
                f32::from_bits(metres.to_bits().saturating_add_signed(ulps))
            }),
        ]
    }

    #[test]
    fn rounds_half_away_from_zero_and_saturates() {
        let cases = [
            (0.0, 0),
            (-0.0, 0),
            (0.0005, 1),
            (-0.0005, -1),
            (0.000_499, 0),
            (1.2345, 1235),
            (32.767, 32767),
            (32.768, 32767),
            (-32.768, -32767),
            (1e30, 32767),
            (f32::NEG_INFINITY, -32767),
        ];
        for (metres, mm) in cases {
            assert_eq!(quantise(metres), mm, "{metres}");
        }
    }

    #[test]
    fn colours_keep_their_upper_bits() {
        assert_eq!(colour_664(0x0000_00ff), 0xfc00);
        assert_eq!(colour_664(0x0000_ff00), LATENCY_TEST_COLOUR);
        assert_eq!(colour_664(0x00ff_0000), 0x000f);
        assert_eq!(colour_664(0xff03_0303), 0);
        assert_eq!(colour_664(0xff10_0404), (1 << 10) | (1 << 4) | 1);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn vectors_quantise_as_single_numbers_do(x in coordinate(), y in coordinate(), z in coordinate(), rgba: u32) {
            if let Some(bits) = quantise_vector([x, y, z, f32::from_bits(rgba)]) {
                prop_assert!(!saturates(x) && !saturates(y) && !saturates(z));
                let got = [bits as u16 as i16, (bits >> 16) as u16 as i16, (bits >> 32) as u16 as i16];
                prop_assert_eq!(got, [quantise(x), quantise(y), quantise(z)]);
            }
        }
    }
}
