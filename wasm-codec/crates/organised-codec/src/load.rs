//! Where a frame's depth and colour come from, tile by tile, and their quantisation.

use bytemuck::must_cast;
use wide::{f32x4, i16x8, i32x4};

use crate::Point;
use crate::lanes::{narrow, round};
use crate::tile::{Grid, MAX_DEPTH, TILE};

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

impl Left {
    /// Adds others.
    pub(crate) fn add(&mut self, other: &Self) {
        self.not_finite += other.not_finite;
        self.non_positive_depth += other.non_positive_depth;
        self.out_of_range += other.out_of_range;
    }
}

/// A tile at full resolution.
#[derive(Clone)]
pub struct Loaded {
    /// Quantised inverse depth, meaningless where not valid.
    pub depth: [i16; TILE * TILE],
    /// Colours.
    pub rgba: [u32; TILE * TILE],
    /// Valid pixels of each row.
    pub rows: [u16; TILE],
    /// Number of them.
    pub valid: u32,
    /// The largest depth value of a valid one.
    pub nearest: i16,
}

impl Loaded {
    /// Nothing valid.
    #[must_use]
    pub const fn new() -> Self {
        Self { depth: [0; TILE * TILE], rgba: [0; TILE * TILE], rows: [0; TILE], valid: 0, nearest: 0 }
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
    /// Loads tiles of a row of tiles, into places by column, and returns what is not valid. Row by row over all of them:
    /// memory is read in its order.
    pub fn load(
        &self,
        source: Source<'_>,
        grid: Grid,
        row: usize,
        columns: core::ops::Range<usize>,
        tiles: &mut [Loaded],
    ) -> Left {
        for tile in &mut tiles[columns.clone()] {
            (tile.rows, tile.valid, tile.nearest) = ([0; TILE], 0, 0);
        }
        let mut left = Left::default();
        for v in row * TILE..grid.height.min((row + 1) * TILE) {
            for column in columns.clone() {
                self.load_row(source, grid, (column, v), v % TILE, &mut tiles[column], &mut left);
            }
        }
        left
    }

    #[inline(always)]
    fn load_row(
        &self,
        source: Source<'_>,
        grid: Grid,
        (column, v): (usize, usize),
        y: usize,
        tile: &mut Loaded,
        left: &mut Left,
    ) {
        let x0 = column * TILE;
        let start = v * grid.width + x0;
        let columns = TILE.min(grid.width - x0);
        let row_limit = f32x4::splat(self.row_limits[v]);
        let limits: &[f32; TILE] = self.column_limits[x0..][..TILE].first_chunk().expect("whole tiles");
        let colours: &mut [u32; TILE] = tile.rgba[y * TILE..][..TILE].first_chunk_mut().expect("a row");
        let mut quantised = [i32x4::ZERO; 4];
        let mut bits = 0;
        for (quarter, place) in quantised.iter_mut().enumerate() {
            let x = 4 * quarter;
            let (depth, rgba) = if x + 4 <= columns {
                source.four(start + x)
            } else {
                let mut depth = [f32::NAN; 4];
                let mut rgba = [0; 4];
                for i in 0..columns.saturating_sub(x) {
                    (depth[i], rgba[i]) = source.one(start + x + i);
                }
                (f32x4::from(depth), rgba)
            };
            colours[x..x + 4].copy_from_slice(&rgba);
            let limit = f32x4::from(*limits[x..].first_chunk::<4>().expect("four")).fast_min(row_limit);
            let scaled = f32x4::splat(self.scale) / depth;
            // What is not finite or not positive fails one of these.
            let is_valid = depth.simd_le(limit)
                & scaled.simd_lt(f32x4::splat(MAX_DEPTH as f32 + 0.5))
                & scaled.simd_gt(f32x4::splat(0.5));
            *place = round(scaled & is_valid);
            let mask = is_valid.to_bitmask() & 15;
            bits |= mask << x;
            if mask != 15 {
                let there = (1 << columns.saturating_sub(x).min(4)) - 1;
                let finite = depth.abs().simd_lt(f32x4::splat(f32::INFINITY)).to_bitmask() & there;
                let positive = depth.simd_gt(f32x4::ZERO).to_bitmask() & finite;
                left.not_finite += (there & !finite).count_ones();
                left.non_positive_depth += (finite & !positive).count_ones();
                left.out_of_range += (positive & !mask).count_ones();
            }
        }
        let halves = [narrow(quantised[0], quantised[1]), narrow(quantised[2], quantised[3])];
        tile.depth[y * TILE..][..TILE].copy_from_slice(&must_cast::<[i16x8; 2], [i16; TILE]>(halves));
        tile.rows[y] = bits as u16;
        tile.valid += bits.count_ones();
        tile.nearest = tile.nearest.max(halves[0].max(halves[1]).reduce_max());
    }
}
