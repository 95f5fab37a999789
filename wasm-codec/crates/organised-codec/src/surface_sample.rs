//! A surface's sample: inverse depth and colour.

use crate::tile::TILE;

/// Samples of a tile.
pub const TILE_SAMPLES: usize = TILE * TILE;
/// Noise of inverse depth between neighbouring pixels, as a share of it.
pub(crate) const NOISE: f32 = 0.02;

/// A positive number as a half float, rounded to the nearest; those below 2⁻¹⁴ mean nothing.
#[inline(always)]
pub(crate) fn half(value: f32) -> u32 {
    const BIAS: u32 = (127 - 15) << 23;
    (value.to_bits().wrapping_sub(BIAS).wrapping_add(1 << 12) >> 13) & 0x7fff
}

/// From R, G, B, A, R lowest.
#[inline(always)]
pub(crate) const fn bits565(rgba: u32) -> u32 {
    (rgba & 0xf8) << 8 | (rgba >> 5 & 0x7e0) | (rgba >> 19 & 0x1f)
}

/// The inverse depth of a sample that is there.
#[inline(always)]
pub(crate) fn value(sample: u32) -> f32 {
    f32::from_bits(((sample & 0x7fff) << 13) + ((127 - 15) << 23))
}
