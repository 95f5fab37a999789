//! Masks and planes, by a decoder and by an encoder.

use wide::i16x8;

use super::plane::PlaneTask;
use super::{mask, rows, wavefront};
use crate::rans::{Coder, Decoder, TileTokens};
use crate::tile::{Plane, TILE};

/// A decoder finds a tile's masks and planes symbol by symbol; an encoder knows them, and finds many symbols at once.
pub trait TileCoder: Coder {
    /// Codes which pixels of the rows are valid.
    fn mask(&mut self, rows: &mut [u16; TILE], width: usize, height: usize);
    /// Codes a plane, gives pixels that are not valid what is predicted for them, and returns the lanes' activity.
    fn plane(&mut self, plane: &mut Plane, task: &PlaneTask) -> i16x8;
}

impl TileCoder for Decoder<'_> {
    fn mask(&mut self, rows: &mut [u16; TILE], width: usize, height: usize) {
        self.with_copy(|decoder| mask::walk(decoder, rows, width, height));
    }

    fn plane(&mut self, plane: &mut Plane, task: &PlaneTask) -> i16x8 {
        let [activity] = wavefront::decode([self], [plane], [task]);
        activity
    }
}

impl TileCoder for TileTokens {
    fn mask(&mut self, rows: &mut [u16; TILE], width: usize, height: usize) {
        if width == TILE && height == TILE {
            self.push_mask(mask::tokens(rows));
        } else {
            self.with_copy(|tokens| mask::walk(tokens, rows, width, height));
        }
    }

    #[inline(never)]
    fn plane(&mut self, plane: &mut Plane, task: &PlaneTask) -> i16x8 {
        rows::code(self, plane, task)
    }
}
