//! The stream header, which goes reliably.

use crate::contexts::{INDEX_CONTEXTS, SYMBOLS};
use crate::crc16::crc16;
use crate::grid::Intrinsics;
use crate::rans::TOTAL;
use crate::tables::TABLE_VERSION;
use crate::tile::Grid;

/// Bytes of a stream header before its palette and its check value.
pub const STREAM_HEADER_BYTES: usize = 34;
/// Colours of a palette.
pub const MAX_PALETTE: usize = 256;
/// Version of the format.
pub const VERSION: u8 = 3;
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
    /// is a palette, else none. Each context's sum is [`TOTAL`] and none is 0.
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
                context.iter().map(|frequency| u32::from(*frequency)).sum::<u32>() == TOTAL.into()
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tables::EVEN;

    fn header() -> StreamHeader {
        StreamHeader {
            id: 7,
            width: 480,
            height: 481,
            intrinsics: Intrinsics { fx: 240.0, fy: 241.0, cx: 239.5, cy: 240.0 },
            depth_unit: DEPTH_UNIT,
            palette: vec![[1, 2, 3], [4, 5, 6]],
            index_frequencies: vec![EVEN; INDEX_CONTEXTS],
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
        assert_eq!(change(4, VERSION - 1), Err(HeaderError::Version));
        assert_eq!(change(5, TABLE_VERSION + 1), Err(HeaderError::Version));
        assert_eq!(change(7, 1), Err(HeaderError::Value));
        assert_eq!(change(9, 255), Err(HeaderError::Value));
        assert_eq!(change(15, 255), Err(HeaderError::Value));
    }
}
