//! The order of symbols in a packet and the contexts they are coded with: one walk for coding and decoding.

mod blocks;
mod mask;
mod number;
mod plane;
mod rows;
mod wavefront;

use blocks::{BlockEdge, NO_BLOCK, code_blocks, code_points};
use mask::code_mask;
use number::{code_number, fold, unfold};
use plane::{Around, Shape, Side, code_plane};
use wide::i16x8;

use crate::contexts::{ANCHOR, DEPTH, INDEX, KIND, PATTERN};
use crate::rans::{Coder, Decoder, TileTokens, code_octaves};
use crate::tile::{ColourMode, Kind, LAST_TRANSFORMED, Pattern, Place, Plane, TILE, Tile};

/// A decoder finds a tile's masks and planes symbol by symbol; an encoder knows them, and finds many symbols at once.
pub trait TileCoder: Coder {
    /// Codes which pixels of the rows are valid.
    fn mask(&mut self, rows: &mut [u16; TILE], width: usize, height: usize);
    /// Codes a plane with contexts from `base` on, gives pixels that are not valid what is predicted for them, and returns the
    /// lanes' activity.
    fn plane(&mut self, plane: &mut Plane, shape: &Shape, around: &Around, base: usize) -> i16x8;
}

impl TileCoder for Decoder<'_> {
    fn mask(&mut self, rows: &mut [u16; TILE], width: usize, height: usize) {
        self.with_copy(|decoder| mask::walk(decoder, rows, width, height));
    }

    fn plane(&mut self, plane: &mut Plane, shape: &Shape, around: &Around, base: usize) -> i16x8 {
        wavefront::decode(self, plane, shape, around, base)
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
    fn plane(&mut self, plane: &mut Plane, shape: &Shape, around: &Around, base: usize) -> i16x8 {
        rows::code(self, plane, shape, around, base)
    }
}

/// The largest quantised inverse depth.
pub const MAX_DEPTH: i32 = 32_767;
/// Levels of a mean lie within ±this.
pub const MAX_DC: i32 = 16_383;

/// Kind of no tile.
const NO_KIND: usize = 3;

/// What a tile leaves to the one on its right.
#[derive(Clone, Copy)]
struct Edge {
    kind: usize,
    /// False where there is nothing to predict from.
    known: bool,
    depth: Side,
    index: Side,
    blocks: [[BlockEdge; 2]; 3],
}

const NO_EDGE: Edge =
    Edge { kind: NO_KIND, known: false, depth: [0; TILE], index: [0; TILE], blocks: [[NO_BLOCK; 2]; 3] };

/// What the tiles of a packet know of those before them.
#[derive(Clone)]
pub struct Neighbours {
    left: Edge,
    pattern: usize,
    point: [i32; 3],
    /// Depth at the upper right corner of the last tile that is not empty.
    last_depth: Option<i16>,
    /// Of the last block of each plane.
    last_dc: [Option<i32>; 3],
    /// Of depth and indices, lane by lane: the size of the last residual.
    activity: [i16x8; 2],
}

impl Neighbours {
    /// At the beginning of a packet: nothing.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            left: NO_EDGE,
            pattern: 8,
            point: [0; 3],
            last_depth: None,
            last_dc: [None; 3],
            activity: [i16x8::ZERO; 2],
        }
    }
}

impl Default for Neighbours {
    fn default() -> Self {
        Self::new()
    }
}

/// Codes a tile. `last`: the packet's last one; a coder that does not decode need not know.
#[inline(always)]
pub fn code_tile<C: TileCoder>(
    coder: &mut C,
    tile: &mut Tile,
    near: &mut Neighbours,
    place: Place,
    mode: ColourMode,
    last: bool,
) {
    if place.column == 0 {
        near.left = NO_EDGE;
    }
    coder.first_turn();
    let kind = coder.symbol(KIND + near.left.kind, tile.kind as u32);
    tile.kind = match kind {
        0 => Kind::Empty,
        1 => Kind::Full,
        _ => Kind::Mixed,
    };
    if tile.kind == Kind::Empty {
        tile.rows = [0; TILE];
        near.left = Edge { kind: 0, ..NO_EDGE };
        return;
    }
    let pattern = coder.symbol(PATTERN + near.pattern, u32::from(tile.pattern.0));
    tile.pattern = Pattern(pattern as u8 & 7);
    near.pattern = usize::from(tile.pattern.0);
    code_mask(coder, tile);
    let shape = Shape { width: tile.pattern.width(), height: tile.pattern.height(), rows: tile.rows };
    let known = near.left.known;
    let anchor =
        if known { 1 } else { code_anchor(coder, first_valid::<C>(&tile.depth, &shape), near.last_depth) };
    let left = known.then_some(&near.left.depth);
    let side = code_plane(coder, &mut tile.depth, &shape, left, anchor, &mut near.activity[0], DEPTH);
    near.left.depth = side;
    near.last_depth = Some(side[0]);
    if mode == ColourMode::Palette {
        let anchor =
            if known { 1 } else { coder.raw(8, first_valid::<C>(&tile.index, &shape) - 1) as i16 + 1 };
        let left = known.then_some(&near.left.index);
        let side = code_plane(coder, &mut tile.index, &shape, left, anchor, &mut near.activity[1], INDEX);
        near.left.index = side;
    }
    near.left.kind = tile.kind as usize;
    near.left.known = true;
    match mode {
        ColourMode::None | ColourMode::Palette => {}
        _ if tile.pattern <= LAST_TRANSFORMED => code_blocks(coder, tile, near, mode, last),
        _ => code_points(coder, tile, near),
    }
}

/// The first valid pixel's value, where it is known.
fn first_valid<C: Coder>(plane: &Plane, shape: &Shape) -> u32 {
    match shape.rows.iter().position(|row| *row != 0) {
        Some(y) if !C::DECODES => plane.row(y)[shape.rows[y].trailing_zeros() as usize] as u32,
        _ => 1,
    }
}

/// What stands in for a tile's surroundings where none are known.
fn code_anchor<C: Coder>(coder: &mut C, value: u32, before: Option<i16>) -> i16 {
    match before {
        None => code_octaves(|bits, value| coder.raw(bits, value), value).min(MAX_DEPTH as u32) as i16,
        Some(before) => {
            let before = i32::from(before);
            let folded = code_number(coder, ANCHOR, fold(value as i32 - before));
            (before + unfold(folded)).clamp(1, MAX_DEPTH) as i16
        }
    }
}
