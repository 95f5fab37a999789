//! Points to data blocks, and back.

use super::quantise::quantise_point;
use super::{BYTES_PER_POINT, LATENCY_TEST_COLOUR, POINTS_PER_PACKET, SlotLayout};
use crate::Point;

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
    use super::super::quantise::tests::coordinate;
    use super::super::{colour_664, quantise, saturates};
    use super::*;
    use proptest::prelude::*;

    const LAYOUT: SlotLayout = SlotLayout::new(1248, 16).unwrap();

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
