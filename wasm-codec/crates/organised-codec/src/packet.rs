//! The header of a packet, and why packets are refused.

use core::ops::Range;

use crate::crc16::crc16;
use crate::rans::code_octaves;
use crate::tables::Sets;
use crate::tile::{ColourMode, Grid};

/// Bytes of a packet before its words, where its colour has signs: they are left in the states, which then cannot hold the
/// check value.
const LONG_HEADER_BYTES: usize = 5;
/// Of another packet.
const SHORT_HEADER_BYTES: usize = 2;
/// A packet is never longer.
pub const MAX_PACKET_BYTES: usize = 1200;
/// What follows a header is never shorter: four states of 19 bits and a count of 4.
const MIN_BODY_BYTES: usize = 10;

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

/// Bytes of the header of packets with such colours.
#[must_use]
pub const fn header_bytes(mode: ColourMode) -> usize {
    if mode.has_signs() { LONG_HEADER_BYTES } else { SHORT_HEADER_BYTES }
}

impl PacketHeader {
    /// The header, of which [`header_bytes`] count; 0 for the check value.
    #[must_use]
    pub fn to_bytes(&self) -> [u8; LONG_HEADER_BYTES] {
        let geometry = self.geometry_set | self.depth_level << 3 | (self.mode as u8) << 6;
        [self.id, geometry, self.quality | self.colour_set << 5, 0, 0]
    }

    /// The tables that it names.
    #[must_use]
    pub const fn sets(&self) -> Sets {
        (self.geometry_set, self.colour_set)
    }

    /// Reads the header; the check value is compared where it is in it.
    ///
    /// # Errors
    /// `TooShort`, `TooLong`, `Check`, `Reserved`.
    pub fn parse(packet: &[u8]) -> Result<Self, PacketError> {
        if packet.len() > MAX_PACKET_BYTES {
            return Err(PacketError::TooLong);
        }
        let Some(mode) = mode_of(packet).filter(|mode| packet.len() >= header_bytes(*mode) + MIN_BODY_BYTES)
        else {
            return Err(PacketError::TooShort);
        };
        let (mut quality, mut colour_set) = (0, 0);
        if mode.has_signs() {
            if u16::from_le_bytes([packet[3], packet[4]]) != check_of(packet) {
                return Err(PacketError::Check);
            }
            if packet[2] >> 7 != 0 {
                return Err(PacketError::Reserved);
            }
            (quality, colour_set) = (packet[2] & 31, packet[2] >> 5);
        }
        let (id, geometry_set, depth_level) = (packet[0], packet[1] & 7, packet[1] >> 3 & 7);
        Ok(Self { id, geometry_set, colour_set, mode, depth_level, quality })
    }
}

/// Writes a packet's check value, where its header has one.
pub fn seal(packet: &mut [u8]) {
    if packet.len() >= LONG_HEADER_BYTES && mode_of(packet).is_some_and(ColourMode::has_signs) {
        let check = check_of(packet);
        packet[3..LONG_HEADER_BYTES].copy_from_slice(&check.to_le_bytes());
    }
}

fn mode_of(packet: &[u8]) -> Option<ColourMode> {
    const MODES: [ColourMode; 4] =
        [ColourMode::None, ColourMode::Subsampled, ColourMode::Full, ColourMode::Palette];
    packet.get(1).map(|byte| MODES[usize::from(byte >> 6)])
}

fn check_of(packet: &[u8]) -> u16 {
    crc16(&[&packet[..3], &packet[LONG_HEADER_BYTES..]])
}

/// The tiles of a packet: what comes first of its raw bits behind the states.
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

    /// Their numbers.
    #[must_use]
    pub const fn tiles(self) -> Range<usize> {
        self.first..self.first + self.count
    }

    /// As raw bits.
    #[must_use]
    pub fn to_raw(self, grid: Grid) -> [(u32, u32); 3] {
        let mut entries = [(0, 0); 3];
        let mut at = 0;
        self.code(grid, |bits, value| {
            entries[at] = (bits, value);
            at += 1;
            value
        });
        entries
    }

    /// From raw bits.
    pub fn from_raw(grid: Grid, mut raw: impl FnMut(u32) -> u32) -> Self {
        Self { first: 0, count: 0 }.code(grid, |bits, _| raw(bits))
    }

    /// Writes or reads a span by a coder of raw bits, which is given each value and returns the one that counts.
    fn code(self, grid: Grid, mut raw: impl FnMut(u32, u32) -> u32) -> Self {
        let first = raw(Self::first_bits(grid), self.first as u32) as usize;
        Self { first, count: code_octaves(raw, self.count as u32) as usize }
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
