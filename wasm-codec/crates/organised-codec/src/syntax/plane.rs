//! Depth, and palette indices: a plane of numbers, each predicted from its neighbours.

use wide::i16x8;

use super::TileCoder;
use crate::lanes::Ranks;
use crate::tile::{Plane, TILE};

/// A tile's outermost pixels, spread over 16.
pub type Side = [i16; TILE];

/// What a plane's coding needs to know of its tile.
pub struct Shape {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// Which of them are valid.
    pub rows: [u16; TILE],
}

/// What surrounds a plane.
pub struct Around {
    /// To the left of each row, where it is known.
    pub left: Option<Side>,
    /// What stands for all where nothing is known.
    pub anchor: i16,
    /// Lane by lane, the size of the residual of the last valid pixel; it goes on from tile to tile.
    pub activity: i16x8,
}

/// Codes a plane and returns its right side. `left` is that of the left tile where it is known. `base` is the first of the
/// plane's contexts.
#[inline(always)]
pub fn code_plane<C: TileCoder>(
    coder: &mut C,
    plane: &mut Plane,
    shape: &Shape,
    left: Option<&Side>,
    anchor: i16,
    activity: &mut i16x8,
    base: usize,
) -> Side {
    let (width, height) = (shape.width, shape.height);
    coder.first_turn();
    let left = left.map(|side| core::array::from_fn(|y| side[y * TILE / height % TILE]));
    *activity = coder.plane(plane, shape, &Around { left, anchor, activity: *activity }, base);
    core::array::from_fn(|i| plane.row(i * height / TILE)[width - 1])
}

/// Median of the left pixel, the upper one, and the plane through them and the diagonal one (LOCO-I).
#[inline(always)]
pub fn predict(l: i16x8, a: i16x8, d: i16x8) -> i16x8 {
    l.saturating_add(a - d).max(l.min(a)).min(l.max(a))
}

/// The same of a single pixel.
#[inline(always)]
pub fn predict_one(l: i16, a: i16, d: i16) -> i16 {
    l.saturating_add(a - d).max(l.min(a)).min(l.max(a))
}

/// The bin of what surrounds a pixel, and for each of the last three bins whether it is that or one beyond.
#[inline(always)]
pub fn bins(l: i16x8, a: i16x8, d: i16x8, r: i16x8) -> (i16x8, [i16x8; 3]) {
    const RANKS: Ranks = Ranks::new(&[0, 1, 2, 4, 7, 12]);
    let gradient = (l - d).abs().saturating_add((a - d).abs()).saturating_add((r - a).abs());
    let shifted = [22, 45, 130].map(|limit| gradient.simd_gt(i16x8::splat(limit)));
    (RANKS.of(gradient) - (shifted[0] + shifted[1] + shifted[2]), shifted)
}

/// Contexts by a bin and the size of the residual before.
#[inline(always)]
pub fn contexts(base: i16x8, bin: i16x8, activity: i16x8) -> i16x8 {
    const RANKS: Ranks = Ranks::new(&[0, 1, 4]);
    base + (bin << 2) + RANKS.of(activity)
}

/// 0, −1, 1, −2 … become 0, 1, 2, 3 ….
#[inline(always)]
pub fn fold(difference: i16x8) -> i16x8 {
    (difference << 1) ^ (difference >> 15)
}
