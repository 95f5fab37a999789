//! Depth, and palette indices: a plane of numbers, each predicted from its neighbours.

use wide::i16x8;

use crate::contexts::{DEPTH, INDEX};
use crate::lanes::{Ranks, rank};
use crate::tile::{ColourMode, Plane, TILE, Tile};

/// What a tile tells of each pixel in a plane.
#[derive(Clone, Copy)]
pub enum Channel {
    /// Inverse depth.
    Depth,
    /// The colour's place in the palette.
    Index,
}

impl Channel {
    /// How many there are.
    pub const COUNT: usize = 2;

    /// Those of tiles whose colours are coded so, in their order.
    #[inline(always)]
    pub const fn of(mode: ColourMode) -> &'static [Self] {
        match mode {
            ColourMode::Palette => &[Self::Depth, Self::Index],
            _ => &[Self::Depth],
        }
    }

    /// The first of its contexts.
    #[inline(always)]
    pub const fn base(self) -> usize {
        match self {
            Self::Depth => DEPTH,
            Self::Index => INDEX,
        }
    }

    /// A tile's plane.
    #[inline(always)]
    pub const fn plane(self, tile: &Tile) -> &Plane {
        match self {
            Self::Depth => &tile.depth,
            Self::Index => &tile.index,
        }
    }

    /// A tile's plane.
    #[inline(always)]
    pub const fn plane_mut(self, tile: &mut Tile) -> &mut Plane {
        match self {
            Self::Depth => &mut tile.depth,
            Self::Index => &mut tile.index,
        }
    }
}

/// A tile's outermost pixels, spread over 16.
pub type Side = [i16; TILE];

/// What a plane's coding needs to know of its tile and what surrounds it.
pub struct PlaneTask {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// Which of them are valid.
    pub rows: [u16; TILE],
    /// To the left of each row, where it is known.
    pub left: Option<Side>,
    /// What stands for all where nothing is known.
    pub anchor: i16,
    /// Lane by lane, the size of the residual of the last valid pixel; it goes on from tile to tile.
    pub activity: i16x8,
    /// The first of the plane's contexts.
    pub base: usize,
}

impl PlaneTask {
    /// True where both take the same steps, whatever their pixels are.
    #[inline(always)]
    pub const fn is_like(&self, other: &Self) -> bool {
        self.width == other.width
            && self.height == other.height
            && self.left.is_some() == other.left.is_some()
            && self.base == other.base
    }
}

/// Median of the left pixel, the upper one, and the plane through them and the diagonal one (LOCO-I).
#[inline(always)]
pub fn predict(l: i16x8, a: i16x8, d: i16x8) -> i16x8 {
    l.saturating_add(a - d).max(l.min(a)).min(l.max(a))
}

/// The same of a single pixel.
#[inline(always)]
pub fn predict_one(l: i16, a: i16, d: i16) -> i16 {
    let plane = i32::from(l) + i32::from(a) - i32::from(d);
    plane.max(l.min(a).into()).min(l.max(a).into()) as i16
}

/// The bin of what surrounds a pixel, and for each of the last three bins whether it is that or one beyond.
#[inline(always)]
pub fn bins(l: i16x8, a: i16x8, d: i16x8, r: i16x8) -> (i16x8, [i16x8; 3]) {
    const RANKS: Ranks = Ranks::new(&[0, 1, 2, 4, 7, 12]);
    let gradient = (l - d).abs().saturating_add((a - d).abs()).saturating_add((r - a).abs());
    let shifted = [22, 45, 130].map(|limit| gradient.simd_gt(i16x8::splat(limit)));
    (rank(&RANKS, gradient) - (shifted[0] + shifted[1] + shifted[2]), shifted)
}

/// Contexts by a bin and the size of the residual before.
#[inline(always)]
pub fn contexts(base: i16x8, bin: i16x8, activity: i16x8) -> i16x8 {
    const RANKS: Ranks = Ranks::new(&[0, 1, 4]);
    base + (bin << 2) + rank(&RANKS, activity)
}

/// 0, −1, 1, −2 … become 0, 1, 2, 3 ….
#[inline(always)]
pub fn fold(difference: i16x8) -> i16x8 {
    (difference << 1) ^ (difference >> 15)
}
