//! `points64`: the mandatory point layout, 64 bits a point.
//!
//! A data block of n ≤ 150 points is n × (x, y, z as little-endian int16 millimetres) and then n × u16 of 6-6-4 colour. A
//! frame's blocks lie in *slots*: one every `stride` bytes, each beginning `data_offset` bytes into its slot, which leaves
//! room for a packet's header and trailer. The last block may be partial; it is packed by its own n.

use bytemuck::must_cast;
use wide::{f32x4, i16x8, i32x4};

use crate::Point;

/// The points of a full packet.
pub const POINTS_PER_PACKET: usize = 150;
/// Three int16 coordinates and 16 bits of colour.
pub const BYTES_PER_POINT: usize = 8;
/// The bytes of a full data block.
pub const MAX_BLOCK_BYTES: usize = POINTS_PER_PACKET * BYTES_PER_POINT;
/// The colour of every point of a latency-test frame: pure green.
pub const LATENCY_TEST_COLOUR: u16 = 0x03f0;

/// Where the blocks of a frame lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SlotLayout {
    stride: usize,
    data_offset: usize,
}

impl SlotLayout {
    /// `None` where a full block does not fit into its slot.
    #[must_use]
    pub const fn new(stride: usize, data_offset: usize) -> Option<Self> {
        match data_offset.checked_add(MAX_BLOCK_BYTES) {
            Some(end) if end <= stride => Some(Self { stride, data_offset }),
            _ => None,
        }
    }

    /// The bytes from one slot to the next.
    #[must_use]
    pub const fn stride(&self) -> usize {
        self.stride
    }

    /// Where in its slot a block begins.
    #[must_use]
    pub const fn data_offset(&self) -> usize {
        self.data_offset
    }
}

/// What [`pack`] wrote.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Packed {
    /// Slots used; all blocks but the last one are full.
    pub packets: usize,
    /// Points written.
    pub points: usize,
    /// Points with a coordinate beyond ±32.767 m (by half a millimetre or more), which now lie on that limit.
    pub saturated: usize,
}

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

/// Writes the points `chosen` (indices into `frame`) as blocks into `slots`.
///
/// # Panics
/// If an index is outside the frame, or the slots do not suffice.
pub fn pack(
    frame: &[Point],
    chosen: &[u32],
    layout: SlotLayout,
    latency_test: bool,
    slots: &mut [u8],
) -> Packed {
    let packets = chosen.len().div_ceil(POINTS_PER_PACKET);
    let used = &mut slots[..packets * layout.stride];
    let mut saturated = 0;
    for (chosen, slot) in chosen.chunks(POINTS_PER_PACKET).zip(used.chunks_exact_mut(layout.stride)) {
        let block = &mut slot[layout.data_offset..][..chosen.len() * BYTES_PER_POINT];
        saturated += pack_block(frame, chosen, latency_test, block);
    }
    Packed { packets, points: chosen.len(), saturated }
}

fn pack_block(frame: &[Point], chosen: &[u32], latency_test: bool, block: &mut [u8]) -> usize {
    let Some((last, others)) = chosen.split_last() else { return 0 };
    let mut saturated = 0;
    let (coordinates, colours) = block.split_at_mut(chosen.len() * 6);
    let (colours, _) = colours.as_chunks_mut::<2>();
    let (last_colour, other_colours) = colours.split_last_mut().expect("one colour a point");
    for (i, (index, colour)) in others.iter().zip(other_colours).enumerate() {
        let (bits, own_colour) = quantise_point(frame[*index as usize], &mut saturated);
        // Eight bytes where six belong: the next point is written over the rest.
        coordinates[i * 6..i * 6 + 8].copy_from_slice(&bits.to_le_bytes());
        *colour = own_colour.to_le_bytes();
    }
    let (bits, own_colour) = quantise_point(frame[*last as usize], &mut saturated);
    coordinates[others.len() * 6..].copy_from_slice(&bits.to_le_bytes()[..6]);
    *last_colour = own_colour.to_le_bytes();
    if latency_test {
        colours.fill(LATENCY_TEST_COLOUR.to_le_bytes());
    }
    saturated
}

/// The coordinates in the lower 48 bits, and the colour.
#[inline(always)]
fn quantise_point(point: Point, saturated: &mut usize) -> (u64, u16) {
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

/// Writes one block of points as x, y, z and colour bits, four 16-bit numbers a point: the renderer's vertex layout.
///
/// # Panics
/// If `points` has not one place for each 8 bytes of the block.
pub fn unpack_block(block: &[u8], points: &mut [u64]) {
    assert_eq!(block.len(), points.len() * BYTES_PER_POINT);
    let (_, colours) = block.split_at(points.len() * 6);
    let colours = colours.as_chunks::<2>().0;
    for (i, (point, colour)) in points.iter_mut().zip(colours).enumerate() {
        // Eight bytes from where the coordinates begin: the last two are the next point's, or a colour's.
        let mut bytes = [0; 8];
        bytes.copy_from_slice(&block[i * 6..i * 6 + 8]);
        let coordinates = u64::from_le_bytes(bytes) & 0xffff_ffff_ffff;
        *point = coordinates | u64::from(u16::from_le_bytes(*colour)) << 48;
    }
}

/// A slot's number of points is not one that a block may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InvalidCount {
    /// The slot, from 0.
    pub slot: usize,
}

/// Unpacks `counts.len()` slots one after another and returns the number of points.
///
/// # Errors
/// A count is over [`POINTS_PER_PACKET`]; what lies in `points` then is of no use.
///
/// # Panics
/// If there are fewer slots than counts, or `points` is too short.
pub fn unpack(
    slots: &[u8],
    layout: SlotLayout,
    counts: &[u16],
    points: &mut [u64],
) -> Result<usize, InvalidCount> {
    let used = &slots[..counts.len() * layout.stride];
    let mut total = 0;
    for (slot, (count, bytes)) in counts.iter().zip(used.chunks_exact(layout.stride)).enumerate() {
        let count = usize::from(*count);
        if count > POINTS_PER_PACKET {
            return Err(InvalidCount { slot });
        }
        let block = &bytes[layout.data_offset..][..count * BYTES_PER_POINT];
        unpack_block(block, &mut points[total..total + count]);
        total += count;
    }
    Ok(total)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const LAYOUT: SlotLayout = SlotLayout::new(1248, 16).unwrap();

    /// Coordinates of all sizes, many of them on or next to half a millimetre.
    fn coordinate() -> impl Strategy<Value = f32> {
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

    #[test]
    fn a_layout_holds_a_full_block() {
        assert!(SlotLayout::new(1216, 16).is_some());
        assert!(SlotLayout::new(1215, 16).is_none());
        assert!(SlotLayout::new(usize::MAX, usize::MAX).is_none());
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

    proptest! {
        #[test]
        fn unpacking_gives_back_what_was_packed(
            points in prop::collection::vec((coordinate(), coordinate(), coordinate(), any::<u32>()), 0..400),
            latency_test: bool,
        ) {
            let frame: Vec<Point> = points.iter().map(|(x, y, z, c)| [*x, *y, *z, f32::from_bits(*c)]).collect();
            let chosen: Vec<u32> = (0..frame.len() as u32).filter(|i| i % 3 != 1).collect();
            let packets = chosen.len().div_ceil(POINTS_PER_PACKET);
            let mut slots = vec![0xaa; packets * LAYOUT.stride()];
            let packed = pack(&frame, &chosen, LAYOUT, latency_test, &mut slots);
            prop_assert_eq!((packed.packets, packed.points), (packets, chosen.len()));
            let beyond = |i: &&u32| frame[**i as usize][..3].iter().any(|c| saturates(*c));
            prop_assert_eq!(packed.saturated, chosen.iter().filter(beyond).count());

            let counts: Vec<u16> = chosen.chunks(POINTS_PER_PACKET).map(|chunk| chunk.len() as u16).collect();
            let mut unpacked = vec![0; chosen.len()];
            prop_assert_eq!(unpack(&slots, LAYOUT, &counts, &mut unpacked), Ok(chosen.len()));
            for (index, bits) in chosen.iter().zip(unpacked) {
                let [x, y, z, colour] = frame[*index as usize];
                let colour = if latency_test { LATENCY_TEST_COLOUR } else { colour_664(colour.to_bits()) };
                let expected = [quantise(x) as u16, quantise(y) as u16, quantise(z) as u16, colour];
                prop_assert_eq!([bits as u16, (bits >> 16) as u16, (bits >> 32) as u16, (bits >> 48) as u16], expected);
            }
        }

        #[test]
        fn counts_from_outside_are_checked(counts in prop::collection::vec(0_u16..200, 0..4)) {
            let slots = vec![0; counts.len() * LAYOUT.stride()];
            let mut points = vec![0; counts.len() * POINTS_PER_PACKET];
            let result = unpack(&slots, LAYOUT, &counts, &mut points);
            match counts.iter().position(|count| usize::from(*count) > POINTS_PER_PACKET) {
                Some(slot) => prop_assert_eq!(result, Err(InvalidCount { slot })),
                None => prop_assert_eq!(result, Ok(counts.iter().map(|count| usize::from(*count)).sum())),
            }
        }
    }
}
