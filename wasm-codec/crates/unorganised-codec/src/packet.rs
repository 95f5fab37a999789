//! A packet's bytes: header, coded points, check value.

use crate::crc32::crc32;
use crate::fault::Fault;
use crate::predictor::Mode;
use crate::quantise::GridPoint;
use crate::start::{AttributeKind, Start};

/// The most bytes a packet may have.
pub const MAX_PACKET_BYTES: usize = 1200;
/// The least that an encoder can be held to.
pub const MIN_PACKET_BYTES: usize = 128;
/// The most points of a packet: bounds what a few bytes can ask of a decoder.
pub const MAX_POINTS_PER_PACKET: usize = 4096;
/// Bytes before the words.
pub const HEADER_BYTES: usize = 19;
/// Bytes after them.
pub const CHECK_BYTES: usize = 4;
/// The largest coordinate of a first point, in millimetres.
const MAX_ORIGIN_MM: i32 = 500_100;
const VERSION: u8 = 1;

/// What the header says.
#[derive(Clone, Copy)]
pub struct Header {
    /// Where the model starts.
    pub start: Start,
    /// The grid's step, 1 to 100 mm.
    pub step_mm: u8,
    /// Points, the first one included.
    pub count: usize,
    /// The coder's state.
    pub state: u32,
}

impl Header {
    /// Appends a whole packet.
    pub fn write(&self, words: &[u16], out: &mut Vec<u8>) {
        let begin = out.len();
        let Start { mode, kind, top, first } = self.start;
        let (number, attribute) = match kind {
            AttributeKind::None => (0, [0, 0]),
            AttributeKind::Intensity => (1, [first.attribute as u8, top]),
            AttributeKind::Colour => (2, first.attribute.to_le_bytes()),
        };
        out.push(VERSION << 4 | number << 2 | mode.number());
        out.push(self.step_mm);
        out.extend((self.count as u16).to_le_bytes());
        for coordinate in first.at {
            out.extend(&coordinate.to_le_bytes()[..3]);
        }
        out.extend(attribute);
        out.extend(self.state.to_le_bytes());
        for word in words {
            out.extend(word.to_le_bytes());
        }
        let check = crc32(&out[begin..]);
        out.extend(check.to_le_bytes());
    }

    /// The header and the words of a packet whose check value is right.
    pub fn read(packet: &[u8]) -> Result<(Header, &[[u8; 2]]), Fault> {
        if packet.len() > MAX_PACKET_BYTES {
            return Err(Fault::TooLong);
        }
        let (body, check) = packet.split_last_chunk::<CHECK_BYTES>().ok_or(Fault::TooShort)?;
        let (header, words) = body.split_first_chunk::<HEADER_BYTES>().ok_or(Fault::TooShort)?;
        if crc32(body) != u32::from_le_bytes(*check) {
            return Err(Fault::Check);
        }
        if header[0] >> 4 != VERSION {
            return Err(Fault::Version);
        }
        let count = usize::from(u16::from_le_bytes([header[2], header[3]]));
        let step_mm = header[1];
        let coordinate = |at: usize| i32::from_le_bytes([0, header[at], header[at + 1], header[at + 2]]) >> 8;
        let at = [4, 7, 10].map(coordinate);
        let pair = [header[13], header[14]];
        let (kind, attribute, top) = match header[0] >> 2 & 3 {
            0 if pair == [0, 0] => (AttributeKind::None, 0, 0),
            1 if pair[1] > 0 && pair[0] <= pair[1] => (AttributeKind::Intensity, u16::from(pair[0]), pair[1]),
            2 => (AttributeKind::Colour, u16::from_le_bytes(pair), 0),
            _ => return Err(Fault::Header),
        };
        let (words, rest) = words.as_chunks::<2>();
        let reach = MAX_ORIGIN_MM / i32::from(step_mm.max(1));
        if !(1..=100).contains(&step_mm)
            || !(1..=MAX_POINTS_PER_PACKET).contains(&count)
            || at.iter().any(|coordinate| coordinate.abs() > reach)
            || !rest.is_empty()
        {
            return Err(Fault::Header);
        }
        let mode = Mode::ALL[usize::from(header[0] & 3)];
        let state = u32::from_le_bytes([header[15], header[16], header[17], header[18]]);
        let start = Start { mode, kind, top, first: GridPoint { at, attribute } };
        Ok((Header { start, step_mm, count, state }, words))
    }
}

/// Writes the check value over a packet's last four bytes; false where it has not that many.
pub fn seal(packet: &mut [u8]) -> bool {
    let Some((body, check)) = packet.split_last_chunk_mut::<4>() else { return false };
    *check = crc32(body).to_le_bytes();
    true
}
