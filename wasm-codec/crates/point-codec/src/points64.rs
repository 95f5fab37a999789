//! `points64`: the mandatory point layout, 64 bits a point.
//!
//! A data block of n ≤ 150 points is n × (x, y, z as little-endian int16 millimetres) and then n × u16 of 6-6-4 colour. A
//! frame's blocks lie in *slots*: one every `stride` bytes, each beginning `data_offset` bytes into its slot, which leaves
//! room for a packet's header and trailer. The last block may be partial; it is packed by its own n.

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
        let (coordinates, colours) = block.split_at_mut(chosen.len() * 6);
        let coordinates = coordinates.as_chunks_mut::<6>().0;
        let colours = colours.as_chunks_mut::<2>().0;
        for ((index, coordinates), colour) in chosen.iter().zip(coordinates).zip(colours) {
            let [x, y, z, rgba] = frame[*index as usize];
            saturated += usize::from(saturates(x) | saturates(y) | saturates(z));
            let [x0, x1] = quantise(x).to_le_bytes();
            let [y0, y1] = quantise(y).to_le_bytes();
            let [z0, z1] = quantise(z).to_le_bytes();
            *coordinates = [x0, x1, y0, y1, z0, z1];
            let bits = if latency_test { LATENCY_TEST_COLOUR } else { colour_664(rgba.to_bits()) };
            *colour = bits.to_le_bytes();
        }
    }
    Packed { packets, points: chosen.len(), saturated }
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
