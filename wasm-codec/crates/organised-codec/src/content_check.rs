//! The check value of packets without signs: over what they say, where that of others is over their bytes. The encoder
//! knows it before it codes, so the states can begin with it: it takes no room of its own.

use wide::i16x8;

use crate::lanes::{LANES, row_mask};
use crate::packet::{PacketHeader, Span};
use crate::tile::{ColourMode, Kind, TILE, Tile};

/// Odd, so that each value alone changes the result whatever the others are.
const MIX: i16x8 = i16x8::splat(0x6a4d);
const INDEX_WEIGHT: i16x8 = i16x8::splat(0x2b85);

/// FNV-1a of 64 bits.
const FNV_FIRST: u64 = 0xcbf2_9ce4_8422_2325;
const FNV_PRIME: u64 = 0x0000_0100_0000_01b3;

/// Grows tile by tile.
#[derive(Clone, Copy, Default)]
pub struct ContentCheck {
    /// Of the left and the right half of rows.
    halves: [i16x8; 2],
}

impl ContentCheck {
    /// Adds a tile that is not empty. Its mode is one without signs.
    #[inline(never)]
    pub fn add_tile(&mut self, number: usize, tile: &Tile, mode: ColourMode) {
        let mut own = *self;
        own.add([number as i16, i16::from(tile.pattern.0)].map(i16x8::splat));
        let (width, height) = (tile.pattern.width(), tile.pattern.height());
        let mut rows = [0; TILE];
        for (row, bits) in rows.iter_mut().zip(&tile.rows[..height]) {
            *row = (*bits & (u16::MAX >> (TILE - width))) as i16;
        }
        own.add(halves(&rows));
        for (y, bits) in rows.into_iter().enumerate().take(height) {
            let mut values = halves(tile.depth.row(y));
            if mode == ColourMode::Palette {
                let indices = halves(tile.index.row(y));
                values = core::array::from_fn(|half| values[half] + indices[half] * INDEX_WEIGHT);
            }
            if tile.kind != Kind::Full || width < TILE {
                values = core::array::from_fn(|half| values[half] & row_mask(bits as u16, half));
            }
            own.add(values);
        }
        *self = own;
    }

    /// The value, 60 bits, of a packet with such a header and such tiles.
    #[must_use]
    pub fn value(mut self, header: &PacketHeader, span: Span) -> u64 {
        let [id, geometry, ..] = header.to_bytes();
        self.add([i16::from_le_bytes([id, geometry]), span.first as i16].map(i16x8::splat));
        self.add([span.count as i16; 2].map(i16x8::splat));
        let numbers = self.halves.iter().flat_map(|half| half.to_array());
        let bytes = numbers.flat_map(i16::to_le_bytes);
        bytes.fold(FNV_FIRST, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(FNV_PRIME)) >> 4
    }

    #[inline(always)]
    fn add(&mut self, values: [i16x8; 2]) {
        for (own, values) in self.halves.iter_mut().zip(values) {
            let mixed = (*own ^ values) * MIX;
            *own = mixed ^ (mixed >> 7);
        }
    }
}

#[inline(always)]
fn halves(row: &[i16; TILE]) -> [i16x8; 2] {
    let (left, right) = row.split_at(LANES);
    [left, right].map(|half| i16x8::from(*half.first_chunk::<LANES>().expect("eight")))
}
