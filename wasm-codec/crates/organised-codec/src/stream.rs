//! The stream header, which goes reliably, and the header of a packet.

use crate::contexts::{INDEX_CONTEXTS, SYMBOLS};
use crate::grid::Intrinsics;
use crate::tables::TABLE_VERSION;
use crate::tile::{ColourMode, Grid};

/// Bytes of a stream header before its palette and its check value.
pub const STREAM_HEADER_BYTES: usize = 34;
/// Colours of a palette.
pub const MAX_PALETTE: usize = 256;
/// Bytes of a packet before the states of the entropy coder.
pub const PACKET_HEADER_BYTES: usize = 9;
/// A packet is never longer.
pub const MAX_PACKET_BYTES: usize = 1200;
/// Version of the format.
pub const VERSION: u8 = 1;
/// The finest step of inverse depth, 1/m: an error of 0.0625 mm · z² at most, with something in hand for the far end.
pub const DEPTH_UNIT: f32 = 0.000_124;
/// Steps of inverse depth to choose from: each twice the one before.
pub const DEPTH_LEVELS: u8 = 8;
/// Largest side of an image, pixels.
pub const MAX_SIDE: usize = 4080;

/// What a stream's packets have in common.
#[derive(Clone, Debug, PartialEq)]
pub struct StreamHeader {
    /// Named by every packet.
    pub id: u8,
    /// Image width, pixels, 1 to [`MAX_SIDE`].
    pub width: u16,
    /// Image height, pixels, 1 to [`MAX_SIDE`].
    pub height: u16,
    /// The camera.
    pub intrinsics: Intrinsics,
    /// Step of inverse depth at level 0, 1/m.
    pub depth_unit: f32,
    /// R, G, B of each colour, for [`ColourMode::Palette`]; neighbours should be alike. Mostly empty.
    pub palette: Vec<[u8; 3]>,
    /// Frequencies of the contexts of palette indices, which differ from picture to picture: [`INDEX_CONTEXTS`] where there
    /// is a palette, else none. Each context's sum is 4096 and none is 0.
    pub index_frequencies: Vec<[u16; SYMBOLS]>,
}

/// Why a stream header is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HeaderError {
    /// Not of the header's length.
    Length,
    /// Not a header of this format.
    Magic,
    /// Another version of the format or its tables.
    Version,
    /// The check value does not fit the bytes.
    Check,
    /// A size, focal length or step outside its range.
    Value,
}

impl StreamHeader {
    /// The header as it goes over the wire.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = b"FPOC".to_vec();
        bytes.extend([VERSION, TABLE_VERSION, self.id, 0]);
        bytes.extend(self.width.to_le_bytes());
        bytes.extend(self.height.to_le_bytes());
        let Intrinsics { fx, fy, cx, cy } = self.intrinsics;
        for value in [fx, fy, cx, cy, self.depth_unit] {
            bytes.extend(value.to_le_bytes());
        }
        bytes.extend((self.palette.len() as u16).to_le_bytes());
        bytes.extend(self.palette.iter().flatten());
        bytes.extend(self.index_frequencies.iter().flatten().flat_map(|frequency| frequency.to_le_bytes()));
        let check = crc16(&[&bytes]);
        bytes.extend(check.to_le_bytes());
        bytes
    }

    /// Reads a header.
    ///
    /// # Errors
    /// See [`HeaderError`].
    pub fn parse(bytes: &[u8]) -> Result<Self, HeaderError> {
        let (bytes, check) = bytes.split_last_chunk::<2>().ok_or(HeaderError::Length)?;
        let (fixed, palette) = bytes.split_first_chunk::<STREAM_HEADER_BYTES>().ok_or(HeaderError::Length)?;
        if bytes[..4] != *b"FPOC" {
            return Err(HeaderError::Magic);
        }
        let colours = usize::from(u16::from_le_bytes([fixed[32], fixed[33]]));
        let (palette, frequencies) = palette.split_at_checked(3 * colours).ok_or(HeaderError::Length)?;
        if frequencies.len() != if colours > 0 { INDEX_CONTEXTS * SYMBOLS * 2 } else { 0 } {
            return Err(HeaderError::Length);
        }
        let (frequencies, _) = frequencies.as_chunks::<{ 2 * SYMBOLS }>();
        if u16::from_le_bytes(*check) != crc16(&[bytes]) {
            return Err(HeaderError::Check);
        }
        if bytes[4] != VERSION || bytes[5] != TABLE_VERSION {
            return Err(HeaderError::Version);
        }
        let float = |at: usize| f32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]]);
        let header = Self {
            id: bytes[6],
            width: u16::from_le_bytes([bytes[8], bytes[9]]),
            height: u16::from_le_bytes([bytes[10], bytes[11]]),
            intrinsics: Intrinsics { fx: float(12), fy: float(16), cx: float(20), cy: float(24) },
            depth_unit: float(28),
            palette: palette.as_chunks::<3>().0.to_vec(),
            index_frequencies: frequencies
                .iter()
                .map(|bytes| core::array::from_fn(|i| u16::from_le_bytes([bytes[2 * i], bytes[2 * i + 1]])))
                .collect(),
        };
        if bytes[7] == 0 && header.is_valid() { Ok(header) } else { Err(HeaderError::Value) }
    }

    /// True where every value lies in its range.
    #[must_use]
    pub fn is_valid(&self) -> bool {
        let side = |side: u16| (1..=MAX_SIDE).contains(&usize::from(side));
        side(self.width)
            && side(self.height)
            && self.intrinsics.is_valid()
            && (1e-6..=0.1).contains(&self.depth_unit)
            && self.palette.len() <= MAX_PALETTE
            && self.index_frequencies.len() == if self.palette.is_empty() { 0 } else { INDEX_CONTEXTS }
            && self.index_frequencies.iter().all(|context| {
                context.iter().map(|frequency| u32::from(*frequency)).sum::<u32>() == 4096
                    && !context.contains(&0)
            })
    }

    /// The image's tiles.
    #[must_use]
    pub const fn grid(&self) -> Grid {
        Grid::new(self.width as usize, self.height as usize)
    }

    /// Step of inverse depth, 1/m.
    #[must_use]
    pub fn depth_step(&self, level: u8) -> f32 {
        self.depth_unit * f32::from(1_u16 << level.min(DEPTH_LEVELS - 1))
    }
}

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
    /// First tile.
    pub first: u16,
    /// Tiles, at least 1.
    pub count: u16,
}

impl PacketHeader {
    /// Writes the header before the rest of the packet, and the check value over all.
    pub fn write(&self, packet: &mut [u8]) {
        packet[0] = self.id;
        packet[1] = self.geometry_set | self.colour_set << 3 | (self.mode as u8) << 5;
        packet[2] = self.depth_level | self.quality << 3;
        packet[3..5].copy_from_slice(&self.first.to_le_bytes());
        packet[5..7].copy_from_slice(&self.count.to_le_bytes());
        let check = crc16(&[&packet[..7], &packet[9..]]);
        packet[7..9].copy_from_slice(&check.to_le_bytes());
    }

    /// Reads the header; the check value is compared.
    ///
    /// # Errors
    /// `TooShort`, `TooLong`, `Check`, `Reserved`.
    pub fn parse(packet: &[u8]) -> Result<Self, PacketError> {
        if packet.len() > MAX_PACKET_BYTES {
            return Err(PacketError::TooLong);
        }
        if packet.len() < PACKET_HEADER_BYTES + 8 {
            return Err(PacketError::TooShort);
        }
        if u16::from_le_bytes([packet[7], packet[8]]) != crc16(&[&packet[..7], &packet[9..]]) {
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
            first: u16::from_le_bytes([packet[3], packet[4]]),
            count: u16::from_le_bytes([packet[5], packet[6]]),
        })
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

/// CRC-16/CCITT-FALSE (polynomial 0x1021, first 0xFFFF) over parts that belong together.
#[must_use]
pub fn crc16(parts: &[&[u8]]) -> u16 {
    const TABLE: [[u16; 256]; 4] = {
        let mut table = [[0; 256]; 4];
        let mut i = 0;
        while i < 256 {
            let mut crc = (i as u16) << 8;
            let mut bit = 0;
            while bit < 8 {
                crc = if crc & 0x8000 == 0 { crc << 1 } else { crc << 1 ^ 0x1021 };
                bit += 1;
            }
            table[0][i] = crc;
            i += 1;
        }
        // table[n]: the byte with n zero bytes after it.
        let mut n = 1;
        while n < 4 {
            let mut i = 0;
            while i < 256 {
                let crc: u16 = table[n - 1][i];
                table[n][i] = crc << 8 ^ table[0][(crc >> 8) as usize];
                i += 1;
            }
            n += 1;
        }
        table
    };
    let mut crc = 0xffff_u16;
    for part in parts {
        let (fours, rest) = part.as_chunks::<4>();
        for four in fours {
            crc = TABLE[3][usize::from((crc >> 8) as u8 ^ four[0])]
                ^ TABLE[2][usize::from(crc as u8 ^ four[1])]
                ^ TABLE[1][usize::from(four[2])]
                ^ TABLE[0][usize::from(four[3])];
        }
        for byte in rest {
            crc = crc << 8 ^ TABLE[0][usize::from((crc >> 8) as u8 ^ byte)];
        }
    }
    crc
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_check_value_is_the_standards() {
        assert_eq!(crc16(&[b"123456789"]), 0x29b1);
        assert_eq!(crc16(&[b"1234", b"56789"]), 0x29b1);
        assert_eq!(crc16(&[b"1", b"23456789"]), 0x29b1);
    }

    fn header() -> StreamHeader {
        StreamHeader {
            id: 7,
            width: 480,
            height: 481,
            intrinsics: Intrinsics { fx: 240.0, fy: 241.0, cx: 239.5, cy: 240.0 },
            depth_unit: DEPTH_UNIT,
            palette: vec![[1, 2, 3], [4, 5, 6]],
            index_frequencies: vec![[256; SYMBOLS]; INDEX_CONTEXTS],
        }
    }

    #[test]
    fn a_header_comes_back_and_every_damaged_bit_is_told() {
        let bytes = header().to_bytes();
        assert_eq!(StreamHeader::parse(&bytes), Ok(header()));
        for bit in 0..bytes.len() * 8 {
            let mut damaged = bytes.clone();
            damaged[bit / 8] ^= 1 << (bit % 8);
            assert!(StreamHeader::parse(&damaged).is_err(), "bit {bit}");
        }
        assert_eq!(StreamHeader::parse(&bytes[..bytes.len() - 1]), Err(HeaderError::Length));
    }

    #[test]
    fn other_versions_and_values_are_refused() {
        let change = |at: usize, value: u8| {
            let mut bytes = header().to_bytes();
            bytes[at] = value;
            let end = bytes.len() - 2;
            let check = crc16(&[&bytes[..end]]);
            bytes[end..].copy_from_slice(&check.to_le_bytes());
            StreamHeader::parse(&bytes)
        };
        assert_eq!(change(4, 2), Err(HeaderError::Version));
        assert_eq!(change(5, 2), Err(HeaderError::Version));
        assert_eq!(change(7, 1), Err(HeaderError::Value));
        assert_eq!(change(9, 255), Err(HeaderError::Value));
        assert_eq!(change(15, 255), Err(HeaderError::Value));
    }
}
