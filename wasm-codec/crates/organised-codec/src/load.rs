//! Where a frame's depth and colour come from, tile by tile, and their quantisation.

use bytemuck::must_cast;
use wide::{f32x4, i32x4};

use crate::Point;
use crate::syntax::MAX_DEPTH;
use crate::tile::{Grid, Place, TILE};

/// Beyond this int16 millimetres cannot follow, metres.
pub const MAX_COORDINATE: f32 = 32.767;

/// A frame.
#[derive(Clone, Copy)]
pub enum Source<'a> {
    /// x, y, z and colour of each pixel, row by row.
    Points(&'a [Point]),
    /// Depth along z in metres and the colour's bytes R, G, B, A of each pixel, row by row.
    Images {
        /// Metres; NaN, infinite, zero or negative where there is none.
        depth: &'a [f32],
        /// R lowest.
        colour: &'a [u32],
    },
}

impl Source<'_> {
    /// Pixels.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Points(points) => points.len(),
            Self::Images { depth, colour } => depth.len().min(colour.len()),
        }
    }

    /// True where there are no pixels.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Depth of four neighbouring pixels, NaN where x or y is not finite, and their colours.
    #[inline(always)]
    fn four(&self, at: usize) -> (f32x4, [u32; 4]) {
        match self {
            Self::Points(points) => {
                let four: &[Point; 4] = points[at..at + 4].first_chunk().expect("four points");
                let [x, y, z, c] = f32x4::transpose(four.map(f32x4::from));
                // Zero where both are finite, NaN otherwise.
                let doubt = x * 0.0 + y * 0.0;
                (z + doubt, must_cast(c))
            }
            Self::Images { depth, colour } => {
                let depth: [f32; 4] = *depth[at..at + 4].first_chunk().expect("four depths");
                (f32x4::from(depth), *colour[at..at + 4].first_chunk().expect("four colours"))
            }
        }
    }

    /// Depth of a pixel.
    #[inline(always)]
    pub(crate) fn depth(&self, at: usize) -> f32 {
        match self {
            Self::Points(points) => points[at][2],
            Self::Images { depth, .. } => depth[at],
        }
    }

    pub(crate) fn one(&self, at: usize) -> (f32, u32) {
        match self {
            Self::Points(points) => {
                let [x, y, z, c] = points[at];
                let doubt = x * 0.0 + y * 0.0;
                (z + doubt, c.to_bits())
            }
            Self::Images { depth, colour } => (depth[at], colour[at]),
        }
    }
}

/// Why pixels carry no point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Left {
    /// A coordinate is NaN or infinite.
    pub not_finite: u32,
    /// Depth is zero or negative.
    pub non_positive_depth: u32,
    /// Nearer than the finest inverse depth, or a coordinate beyond ±32.767 m.
    pub out_of_range: u32,
}

/// A tile at full resolution.
pub struct Loaded {
    /// Quantised inverse depth, meaningless where not valid.
    pub depth: [i32; TILE * TILE],
    /// Colours.
    pub rgba: [u32; TILE * TILE],
    /// Valid pixels of each row.
    pub rows: [u16; TILE],
    /// Number of them.
    pub valid: u32,
}

impl Loaded {
    /// Nothing valid.
    #[must_use]
    pub const fn new() -> Self {
        Self { depth: [0; TILE * TILE], rgba: [0; TILE * TILE], rows: [0; TILE], valid: 0 }
    }
}

impl Default for Loaded {
    fn default() -> Self {
        Self::new()
    }
}

/// How depth is quantised and how far each column and row may see.
pub struct Quantiser {
    /// 1 / step, metres.
    pub scale: f32,
    /// Largest depth of each column, padded to whole tiles with 0, metres.
    pub column_limits: Vec<f32>,
    /// Largest depth of each row.
    pub row_limits: Vec<f32>,
}

impl Quantiser {
    /// Loads a tile; what is not valid is added to `left`.
    #[inline]
    pub fn load(&self, source: Source<'_>, grid: Grid, place: Place, tile: &mut Loaded, left: &mut Left) {
        let (x0, y0) = (place.column * TILE, place.row * TILE);
        let columns = TILE.min(grid.width - x0);
        let rows = TILE.min(grid.height - y0);
        tile.rows = [0; TILE];
        let (mut finite, mut positive, mut valid) = (0, 0, 0);
        for y in 0..rows {
            let start = (y0 + y) * grid.width + x0;
            let row_limit = self.row_limits[y0 + y];
            let mut bits = 0;
            for x in (0..columns).step_by(4) {
                let (depth, colours) = if x + 4 <= columns {
                    source.four(start + x)
                } else {
                    let mut depth = [f32::NAN; 4];
                    let mut colours = [0; 4];
                    for i in 0..columns - x {
                        (depth[i], colours[i]) = source.one(start + x + i);
                    }
                    (f32x4::from(depth), colours)
                };
                let limits = self.column_limits[x0 + x..].first_chunk::<4>().expect("padded to whole tiles");
                let limit = f32x4::from(*limits).fast_min(f32x4::splat(row_limit));
                let is_finite = depth.abs().simd_lt(f32x4::splat(f32::INFINITY));
                let is_positive = is_finite & depth.simd_gt(f32x4::ZERO);
                let scaled = f32x4::splat(self.scale) / depth + f32x4::splat(0.5);
                let is_valid = is_positive
                    & depth.simd_le(limit)
                    & scaled.simd_lt(f32x4::splat(MAX_DEPTH as f32 + 1.0))
                    & scaled.simd_ge(f32x4::ONE);
                let safe: f32x4 = scaled & is_valid;
                let quantised: i32x4 = safe.fast_trunc_int();
                let at = y * TILE + x;
                tile.depth[at..at + 4].copy_from_slice(&quantised.to_array());
                tile.rgba[at..at + 4].copy_from_slice(&colours);
                let mask = is_valid.to_bitmask();
                bits |= (mask as u16) << x;
                if mask != 15 {
                    finite += is_finite.to_bitmask().count_ones();
                    positive += is_positive.to_bitmask().count_ones();
                } else {
                    finite += 4;
                    positive += 4;
                }
            }
            tile.rows[y] = bits;
            valid += bits.count_ones();
        }
        tile.valid = valid;
        left.not_finite += (rows * columns) as u32 - finite;
        left.non_positive_depth += finite - positive;
        left.out_of_range += positive - valid;
    }
}
