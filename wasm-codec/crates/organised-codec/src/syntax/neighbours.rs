//! What the tiles of a packet know of those before them.

use wide::i16x8;

use super::plane::{Channel, Side};
use crate::tile::TILE;

/// What a block leaves to its neighbours.
#[derive(Clone, Copy)]
pub struct BlockEdge {
    pub(super) dc: i32,
    pub(super) count: i32,
}

/// `dc` of no block.
pub const NO_BLOCK: BlockEdge = BlockEdge { dc: i32::MIN, count: 0 };

/// Kind of no tile.
const NO_KIND: usize = 3;

/// What a tile leaves to the one on its right.
#[derive(Clone, Copy)]
pub(super) struct Edge {
    pub(super) kind: usize,
    /// False where there is nothing to predict from.
    pub(super) known: bool,
    /// By channel.
    pub(super) sides: [Side; Channel::COUNT],
    pub(super) blocks: [[BlockEdge; 2]; 3],
}

pub(super) const NO_EDGE: Edge =
    Edge { kind: NO_KIND, known: false, sides: [[0; TILE]; Channel::COUNT], blocks: [[NO_BLOCK; 2]; 3] };

/// What the tiles of a packet know of those before them.
#[derive(Clone)]
pub struct Neighbours {
    pub(super) left: Edge,
    pub(super) pattern: usize,
    pub(super) point: [i32; 3],
    /// Depth at the upper right corner of the last tile that is not empty.
    pub(super) last_depth: Option<i16>,
    /// Of the last block of each plane.
    pub(super) last_dc: [Option<i32>; 3],
    /// By channel, lane by lane: the size of the last residual.
    pub(super) activity: [i16x8; Channel::COUNT],
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
            activity: [i16x8::ZERO; Channel::COUNT],
        }
    }
}

impl Default for Neighbours {
    fn default() -> Self {
        Self::new()
    }
}
