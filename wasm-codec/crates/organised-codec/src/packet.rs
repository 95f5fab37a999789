//! The header of a packet, and why packets are refused.

use crate::crc16::crc16;
use crate::tile::{ColourMode, Grid};

/// Bytes of a packet before its words.
pub const PACKET_HEADER_BYTES: usize = 5;
/// A packet is never longer.
pub const MAX_PACKET_BYTES: usize = 1200;
/// A packet is never shorter: its header, a count of 4 raw bits and four states of 19.
pub const MIN_PACKET_BYTES: usize = PACKET_HEADER_BYTES + 10;

/// The first bytes of a packet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PacketHeader {
    /// Of the stream.
    pub id: u8,
    /// Table set for geometry.
    pub geometry_set: u8,
    /// Table set for colour.
    pub colour_set: u8,
    /// How colour is coded.
    pub mode: ColourMode,
    /// Level of the depth step.
    pub depth_level: u8,
    /// Quality of colour, 0 the finest.
    pub quality: u8,
}

impl PacketHeader {
    /// Writes the header before the rest of the packet, and the check value over all.
    pub fn write(&self, packet: &mut [u8]) {
        packet[0] = self.id;
        packet[1] = self.geometry_set | self.colour_set << 3 | (self.mode as u8) << 5;
        packet[2] = self.depth_level | self.quality << 3;
        seal(packet);
    }

    /// Reads the header; the check value is compared.
    ///
    /// # Errors
    /// `TooShort`, `TooLong`, `Check`, `Reserved`.
    pub fn parse(packet: &[u8]) -> Result<Self, PacketError> {
        if packet.len() > MAX_PACKET_BYTES {
            return Err(PacketError::TooLong);
        }
        if packet.len() < MIN_PACKET_BYTES {
            return Err(PacketError::TooShort);
        }
        if u16::from_le_bytes([packet[3], packet[4]]) != check_of(packet) {
            return Err(PacketError::Check);
        }
        let mode = match packet[1] >> 5 {
            0 => ColourMode::None,
            1 => ColourMode::Subsampled,
            2 => ColourMode::Full,
            3 => ColourMode::Palette,
            _ => return Err(PacketError::Reserved),
        };
        Ok(Self {
            id: packet[0],
            geometry_set: packet[1] & 7,
            colour_set: packet[1] >> 3 & 3,
            mode,
            depth_level: packet[2] & 7,
            quality: packet[2] >> 3,
        })
    }
}

/// Writes a packet's check value.
pub fn seal(packet: &mut [u8]) {
    let check = check_of(packet);
    packet[3..5].copy_from_slice(&check.to_le_bytes());
}

fn check_of(packet: &[u8]) -> u16 {
    crc16(&[&packet[..3], &packet[5..]])
}

/// The tiles of a packet: what its raw bits begin with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    /// The first.
    pub first: usize,
    /// How many, at least 1.
    pub count: usize,
}

impl Span {
    /// Bits of the first tile's number.
    #[must_use]
    pub const fn first_bits(grid: Grid) -> u32 {
        usize::BITS - (grid.tiles() - 1).leading_zeros()
    }

    /// As raw bits.
    #[must_use]
    pub fn to_raw(self, grid: Grid) -> [(u32, u32); 3] {
        let octave = self.count.ilog2();
        [(Self::first_bits(grid), self.first as u32), (4, octave), (octave, self.count as u32 ^ 1 << octave)]
    }

    /// From raw bits.
    pub fn from_raw(grid: Grid, mut raw: impl FnMut(u32) -> u32) -> Self {
        let first = raw(Self::first_bits(grid)) as usize;
        let octave = raw(4);
        Self { first, count: (1 << octave | raw(octave)) as usize }
    }
}

/// Why a packet is refused. Nothing of it is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PacketError {
    /// Shorter than its header and the coder's states.
    TooShort,
    /// Longer than [`MAX_PACKET_BYTES`].
    TooLong,
    /// The check value does not fit the bytes.
    Check,
    /// A reserved bit is set.
    Reserved,
    /// Of another stream, or one whose header has not come.
    UnknownStream,
    /// No tiles, or tiles beyond the image's last.
    Tiles,
    /// A tile that has come before in this frame.
    Duplicate,
    /// The coded data does not end where it should, or says what no encoder says.
    Corrupt,
}
