//! What the codec needs of vectors beside plain arithmetic, in a few instructions on every machine.

use bytemuck::must_cast;
use wide::{f32x4, f32x8, i16x8, i32x4};

/// Lanes of a wavefront.
pub const LANES: usize = 8;

#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
mod shuffle {
    use core::arch::wasm32::{i8x16_swizzle, i16x8_shuffle};
    use wide::{i8x16, i16x8};

    #[inline(always)]
    pub fn rotate(lanes: i16x8) -> i16x8 {
        i16x8_shuffle::<7, 0, 1, 2, 3, 4, 5, 6>(lanes.into(), lanes.into()).into()
    }

    /// For each mask of lanes the bytes of those, one after another.
    const GATHER: [[u8; 16]; 256] = {
        let mut gather = [[0; 16]; 256];
        let mut mask = 0;
        while mask < 256 {
            let (mut lane, mut at) = (0, 0);
            while lane < 8 {
                if mask >> lane & 1 == 1 {
                    gather[mask][at] = 2 * lane;
                    gather[mask][at + 1] = 2 * lane + 1;
                    at += 2;
                }
                lane += 1;
            }
            mask += 1;
        }
        gather
    };

    #[inline(always)]
    pub fn gather(lanes: i16x8, mask: u8) -> [u16; 8] {
        let bytes: i8x16 = bytemuck::must_cast(GATHER[usize::from(mask)]);
        bytemuck::must_cast::<i8x16, [u16; 8]>(i8x16_swizzle(lanes.into(), bytes.into()).into())
    }

    #[inline(always)]
    pub fn interleave(a: i16x8, b: i16x8) -> [i16x8; 2] {
        [
            i16x8_shuffle::<0, 8, 1, 9, 2, 10, 3, 11>(a.into(), b.into()).into(),
            i16x8_shuffle::<4, 12, 5, 13, 6, 14, 7, 15>(a.into(), b.into()).into(),
        ]
    }
}

#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
#[allow(unsafe_code, reason = "SSE2 intrinsics, of which every x86-64 processor has all")]
mod shuffle {
    use core::arch::x86_64::{
        _mm_or_si128, _mm_slli_si128, _mm_srli_si128, _mm_unpackhi_epi16, _mm_unpacklo_epi16,
    };
    use wide::i16x8;

    pub(crate) use super::gather_one_by_one as gather;

    #[inline(always)]
    pub fn rotate(lanes: i16x8) -> i16x8 {
        let lanes = lanes.into();
        // SAFETY: this module is compiled for SSE2 alone; so below.
        unsafe { _mm_or_si128(_mm_slli_si128::<2>(lanes), _mm_srli_si128::<14>(lanes)) }.into()
    }

    #[inline(always)]
    pub fn interleave(a: i16x8, b: i16x8) -> [i16x8; 2] {
        let (a, b) = (a.into(), b.into());
        unsafe { [_mm_unpacklo_epi16(a, b).into(), _mm_unpackhi_epi16(a, b).into()] }
    }
}

#[cfg(not(any(
    all(target_arch = "wasm32", target_feature = "simd128"),
    all(target_arch = "x86_64", target_feature = "sse2")
)))]
mod shuffle {
    use wide::i16x8;

    pub(crate) use super::gather_one_by_one as gather;

    #[inline(always)]
    pub fn rotate(lanes: i16x8) -> i16x8 {
        let lanes = lanes.to_array();
        i16x8::new(core::array::from_fn(|lane| lanes[(lane + 7) % 8]))
    }

    #[inline(always)]
    pub fn interleave(a: i16x8, b: i16x8) -> [i16x8; 2] {
        let (a, b) = (a.to_array(), b.to_array());
        let half = |start: usize| {
            i16x8::new(core::array::from_fn(|i| if i % 2 == 0 { a[start + i / 2] } else { b[start + i / 2] }))
        };
        [half(0), half(4)]
    }
}

#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
#[inline(always)]
pub(crate) fn gather_one_by_one(lanes: i16x8, mask: u8) -> [u16; 8] {
    let lanes = lanes.to_array();
    let mut gathered = [0; 8];
    let mut at = 0;
    for (lane, value) in lanes.into_iter().enumerate() {
        gathered[at % 8] = value as u16;
        at += usize::from(mask >> lane & 1);
    }
    gathered
}

/// The lanes of a mask, one after another; what follows them means nothing.
#[inline(always)]
pub fn gather(lanes: i16x8, mask: u8) -> [u16; 8] {
    if mask == u8::MAX {
        return must_cast(lanes);
    }
    shuffle::gather(lanes, mask)
}

/// Lane k gets lane k − 1, the first one the last.
#[inline(always)]
pub fn rotate(lanes: i16x8) -> i16x8 {
    shuffle::rotate(lanes)
}

/// Rows become columns.
#[inline(always)]
pub fn transpose(mut rows: [i16x8; LANES]) -> [i16x8; LANES] {
    // Three perfect shuffles of the eight.
    for _ in 0..3 {
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| shuffle::interleave(rows[i], rows[i + 4]));
        rows = [a[0], a[1], b[0], b[1], c[0], c[1], d[0], d[1]];
    }
    rows
}

/// The first lanes of both in turn, then the last ones.
#[inline(always)]
pub fn interleave(a: i16x8, b: i16x8) -> [i16x8; 2] {
    shuffle::interleave(a, b)
}

/// As 16 bits, limited to what those hold.
#[inline(always)]
pub fn narrow(low: i32x4, high: i32x4) -> i16x8 {
    i16x8::from_i32x8_saturate(must_cast([low, high]))
}

/// Rows become columns.
#[inline(always)]
pub fn transpose_floats(rows: [f32x8; LANES]) -> [f32x8; LANES] {
    let halves: [[f32x4; 2]; LANES] = rows.map(must_cast);
    let quarter = |row: usize, half: usize| f32x4::transpose(core::array::from_fn(|i| halves[row + i][half]));
    let [a, b, c, d] = [quarter(0, 0), quarter(0, 1), quarter(4, 0), quarter(4, 1)];
    core::array::from_fn(|i| if i < 4 { must_cast([a[i], c[i]]) } else { must_cast([b[i - 4], d[i - 4]]) })
}

/// 1.5 · 2²³: added to a float of at most 2²², it leaves the nearest whole number (of two, the even one) in the lowest bits.
const MAGIC: f32 = 12_582_912.0;

/// The nearest whole numbers, of two the even one, as 32 bits whose lower 16 are right; the numbers must lie within
/// ±2²².
#[inline(always)]
pub fn round_low(numbers: f32x4) -> i32x4 {
    must_cast(numbers + f32x4::splat(MAGIC))
}

/// The nearest whole numbers, of two the even one; the numbers must lie within ±2²².
#[inline(always)]
pub fn round(numbers: f32x4) -> i32x4 {
    round_low(numbers) - i32x4::splat(MAGIC.to_bits() as i32)
}

/// `yes` where the mask's bits are set, else `no`.
#[inline(always)]
pub fn select(mask: i16x8, yes: i16x8, no: i16x8) -> i16x8 {
    (mask & yes) | (!mask & no)
}

/// Masks of a single lane.
pub const ONLY: [i16x8; LANES] = {
    let mut masks = [i16x8::new([0; LANES]); LANES];
    let mut lane = 0;
    while lane < LANES {
        let mut bits = [0; LANES];
        bits[lane] = -1;
        masks[lane] = i16x8::new(bits);
        lane += 1;
    }
    masks
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lanes_turn_and_rows_become_columns() {
        assert_eq!(rotate(i16x8::new([0, 1, 2, 3, 4, 5, 6, 7])).to_array(), [7, 0, 1, 2, 3, 4, 5, 6]);
        let rows = core::array::from_fn(|y| i16x8::new(core::array::from_fn(|x| (10 * y + x) as i16)));
        for (x, column) in transpose(rows).iter().enumerate() {
            assert_eq!(column.to_array(), core::array::from_fn(|y| (10 * y + x) as i16));
        }
    }
}
