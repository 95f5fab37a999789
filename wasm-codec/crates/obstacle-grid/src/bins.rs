//! Counts points in cells, four at a time.

use bytemuck::must_cast;
use wide::{f32x4, i32x4};

use crate::SensorPose;
use crate::settings::Settings;

/// Nearer points are a sensor's way to say that it has none, metres.
const NEAREST: f32 = 0.02;
/// Farther points are not looked at, metres: their squares stay finite.
const FARTHEST: f32 = 1e6;
/// What a point adds to its cell: nothing, one to the obstacle's count, or one to the floor's.
const ADDS: [u64; 4] = [0, 1, 1 << FLOOR_BITS, 0];
/// The lowest band of heights, where the point is one of an obstacle.
const LOWEST_BAND: [u64; 4] = [0, 1 << BAND_BITS, 0, 0];
const FLOOR_BITS: u32 = 24;
const BAND_BITS: u32 = 48;
const COUNT_MASK: u64 = (1 << FLOOR_BITS) - 1;
/// The height up to which the robot would hit something is divided into so many bands.
const BANDS: u32 = 64 - BAND_BITS;

/// The counts of one cloud.
pub(crate) struct Bins {
    side: usize,
    /// From the lowest bit: points of obstacles, points of the floor, and in which bands of heights obstacles have points. In
    /// one number, because each point costs one access then. The last entry takes what is in no cell.
    counts: Vec<u64>,
    /// Rays that passed through the floor's level.
    holes: Vec<u32>,
    any_hole: bool,
}

/// What does not change from point to point, in every lane.
pub(crate) struct Rule {
    half: f32x4,
    per_cell: f32x4,
    side: f32x4,
    stride: i32x4,
    nowhere: i32x4,
    clearance: f32x4,
    height: f32x4,
    drop: f32x4,
    slope: f32x4,
    bands_per_metre: f32x4,
    highest_band: f32x4,
    /// What is higher than this is in no cell.
    top: f32x4,
    sensor: [f32; 3],
}

impl Rule {
    pub(crate) fn new(settings: &Settings, pose: &SensorPose) -> Self {
        let side = settings.side as f32;
        Self {
            half: f32x4::splat(side / 2.0),
            per_cell: f32x4::splat(1.0 / settings.cell),
            side: f32x4::splat(side),
            stride: i32x4::splat(settings.side as i32),
            nowhere: i32x4::splat((settings.side * settings.side) as i32),
            clearance: f32x4::splat(settings.clearance),
            height: f32x4::splat(settings.height),
            drop: f32x4::splat(-settings.drop),
            slope: f32x4::splat(settings.slope),
            bands_per_metre: f32x4::splat(BANDS as f32 / settings.height),
            highest_band: f32x4::splat((BANDS - 1) as f32),
            top: f32x4::splat(
                settings.height.max(settings.clearance + settings.slope * side / 2.0 * settings.cell),
            ),
            sensor: pose.position,
        }
    }
}

impl Rule {
    /// Which of the valid lanes may be in a cell, by their heights: most of what is left out is walls and ceilings.
    #[inline(always)]
    pub(crate) fn low_enough(&self, z: f32x4, valid: i32x4) -> i32x4 {
        must_cast::<f32x4, i32x4>(z.simd_le(self.top)) & valid
    }
}

impl Bins {
    pub(crate) fn new(side: usize) -> Self {
        Self { side, counts: vec![0; side * side + 1], holes: vec![0; side * side], any_hole: false }
    }

    pub(crate) fn clear(&mut self) {
        self.counts.fill(0);
        if self.any_hole {
            self.holes.fill(0);
        }
        self.any_hole = false;
    }

    /// Whether nothing was counted in a cell.
    pub(crate) fn is_empty(&self, cell: usize) -> bool {
        self.counts[cell] == 0 && (!self.any_hole || self.holes[cell] == 0)
    }

    /// Points of obstacles, points of the floor, and rays through the floor in a cell.
    pub(crate) fn of(&self, cell: usize) -> (u32, u32, u32) {
        let count = self.counts[cell];
        ((count & COUNT_MASK) as u32, ((count >> FLOOR_BITS) & COUNT_MASK) as u32, self.holes[cell])
    }

    /// From the lowest to the highest point of obstacles in a cell, metres, to the bounds of their bands. Only of a cell with
    /// an obstacle.
    pub(crate) fn span_of(&self, cell: usize, settings: &Settings) -> [f32; 2] {
        let bands = self.counts[cell] >> BAND_BITS;
        let (low, high) = (bands.trailing_zeros(), u64::BITS - bands.leading_zeros());
        [low, high].map(|band| band as f32 * settings.height / BANDS as f32)
    }

    /// Counts four points of the grid's frame. Lanes of `valid` that are not all ones are left out.
    #[inline(always)]
    pub(crate) fn add(&mut self, rule: &Rule, [x, y, z]: [f32x4; 3], valid: i32x4) {
        let mask = must_cast::<f32x4, i32x4>;
        let zero = f32x4::ZERO;
        // Products of numbers beyond any cell are cut off, so that they can be converted.
        let column = x * rule.per_cell + rule.half;
        let row = y * rule.per_cell + rule.half;
        let inside = mask(
            column.simd_ge(zero) & column.simd_lt(rule.side) & row.simd_ge(zero) & row.simd_lt(rule.side),
        );
        let tolerance = rule.slope * x.abs().fast_max(y.abs());
        let high = rule.clearance + tolerance;
        let low = rule.drop - tolerance;
        let below = mask(z.simd_lt(low)) & valid;
        let floor = mask(z.simd_le(high) & z.simd_ge(low));
        let obstacle = mask(z.simd_gt(high) & z.simd_le(rule.height));
        let counted = inside & valid & (floor | obstacle);
        if below.to_bitmask() != 0 {
            self.add_holes(rule, [x.to_array(), y.to_array(), z.to_array()], below.to_array());
        }
        // Most of what is far away is in no cell.
        if counted.to_bitmask() == 0 {
            return;
        }
        let cell = column.fast_trunc_int() + row.fast_trunc_int() * rule.stride;
        let cells = ((cell & counted) | (rule.nowhere & !counted)).to_array();
        let kinds = ((obstacle & i32x4::splat(1)) | (floor & i32x4::splat(2))).to_array();
        let band = (z * rule.bands_per_metre).fast_max(zero).fast_min(rule.highest_band);
        let bands = band.fast_trunc_int().to_array();
        for ((cell, kind), band) in cells.into_iter().zip(kinds).zip(bands) {
            // All are in range: the cell by `inside`, the others by their making.
            if let Some(count) = self.counts.get_mut(cell as usize) {
                let kind = (kind & 3) as usize;
                *count = (*count + ADDS[kind]) | (LOWEST_BAND[kind] << (band & 15));
            }
        }
    }

    /// Points below the floor show a hole where their ray passed through the floor's level.
    #[cold]
    #[inline(never)]
    fn add_holes(&mut self, rule: &Rule, [x, y, z]: [[f32; 4]; 3], below: [i32; 4]) {
        let [sx, sy, sz] = rule.sensor;
        if sz <= 0.0 {
            return;
        }
        for lane in 0..4 {
            if below[lane] == 0 {
                continue;
            }
            let share = sz / (sz - z[lane]);
            let at = |from: f32, to: f32| {
                let place =
                    (from + share * (to - from)) * rule.per_cell.to_array()[0] + self.side as f32 / 2.0;
                (place >= 0.0 && place < self.side as f32).then_some(place as usize)
            };
            if let (Some(column), Some(row)) = (at(sx, x[lane]), at(sy, y[lane])) {
                self.holes[row * self.side + column] += 1;
                self.any_hole = true;
            }
        }
    }
}

/// Which lanes are points at all, by the square of their distance from the sensor.
#[inline(always)]
pub(crate) fn valid_ranges(squared: f32x4) -> i32x4 {
    let near = f32x4::splat(NEAREST * NEAREST);
    let far = f32x4::splat(FARTHEST * FARTHEST);
    must_cast(squared.simd_gt(near) & squared.simd_lt(far))
}

/// The same by their depth.
#[inline(always)]
pub(crate) fn valid_depths(depth: f32x4) -> i32x4 {
    must_cast(depth.simd_gt(f32x4::splat(NEAREST)) & depth.simd_lt(f32x4::splat(FARTHEST)))
}
