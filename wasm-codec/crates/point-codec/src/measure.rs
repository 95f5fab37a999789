//! The depth of every point, and which points cannot be sent at all.

use bytemuck::must_cast;
use wide::{f32x4, i32x4};

use crate::Point;

/// The largest coordinate that int16 millimetres can hold, metres.
pub const MAX_COORDINATE: f32 = 32.767;

/// A depth below a micrometre counts as none, metres: no sensor means it, and its powers would underflow.
pub const MIN_DEPTH: f32 = 1e-6;

/// What "depth" means for the sampling weights.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DepthMeasure {
    /// The z coordinate (a camera); a point at or behind the sensor's plane is rejected.
    #[default]
    Z,
    /// The distance from the origin (a LiDAR, which sees in every direction).
    Range,
}

/// What becomes of points with a coordinate beyond ±[`MAX_COORDINATE`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum OutOfRange {
    /// They are left out and counted.
    #[default]
    Reject,
    /// They take part, and their coordinates saturate when packed.
    Keep,
}

/// What one pass over a frame finds. Each rejected point counts once, under the first reason that holds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Measured {
    pub valid: usize,
    pub not_finite: usize,
    pub non_positive_depth: usize,
    pub out_of_range: usize,
    /// Over the valid points; 0 where there are none.
    pub min_depth: f32,
    pub max_depth: f32,
}

const INFINITY_BITS: i32 = 0x7f80_0000;
/// Coordinates are cut to this before they are squared: (1e18)² × 3 is still finite.
const SQUARABLE: f32 = 1e18;

/// Writes the depth of every point to `depths` in whole vectors, NaN where the point is not valid.
///
/// `depths` has one vector for each four points of the frame, the last one padded with NaN.
pub(crate) fn measure(
    frame: &[Point],
    measure: DepthMeasure,
    out_of_range: OutOfRange,
    depths: &mut [f32x4],
) -> Measured {
    match measure {
        DepthMeasure::Z => pass::<false>(frame, out_of_range, depths),
        DepthMeasure::Range => pass::<true>(frame, out_of_range, depths),
    }
}

fn pass<const RANGE: bool>(frame: &[Point], out_of_range: OutOfRange, depths: &mut [f32x4]) -> Measured {
    assert_eq!(depths.len(), frame.len().div_ceil(4));
    let limit = i32x4::splat(match out_of_range {
        OutOfRange::Reject => MAX_COORDINATE.to_bits() as i32,
        OutOfRange::Keep => INFINITY_BITS - 1,
    });
    let mut totals = Totals::new();
    let (quads, rest) = frame.as_chunks::<4>();
    for (quad, depth) in quads.iter().zip(depths.iter_mut()) {
        *depth = totals.add::<RANGE>(quad, limit);
    }
    if !rest.is_empty() {
        let mut quad = [[f32::NAN; 4]; 4];
        quad[..rest.len()].copy_from_slice(rest);
        depths[quads.len()] = totals.add::<RANGE>(&quad, limit);
    }
    totals.measured(frame.len())
}

/// What a pass has found so far.
pub(crate) struct Totals {
    finite: i32x4,
    positive: i32x4,
    valid: i32x4,
    min_depth: f32x4,
    max_depth: f32x4,
}

impl Totals {
    pub fn new() -> Self {
        Self {
            finite: i32x4::ZERO,
            positive: i32x4::ZERO,
            valid: i32x4::ZERO,
            min_depth: f32x4::splat(f32::INFINITY),
            max_depth: f32x4::ZERO,
        }
    }

    /// Of `points` points; padding was added as NaN.
    pub fn measured(&self, points: usize) -> Measured {
        let finite = lane_sum(self.finite);
        let positive = lane_sum(self.positive);
        let valid = lane_sum(self.valid);
        let lowest = self.min_depth.to_array().into_iter().fold(f32::INFINITY, f32::min);
        Measured {
            valid,
            not_finite: points - finite,
            non_positive_depth: finite - positive,
            out_of_range: positive - valid,
            min_depth: if valid == 0 { 0.0 } else { lowest },
            max_depth: self.max_depth.to_array().into_iter().fold(0.0, f32::max),
        }
    }

    #[inline(always)]
    fn add<const RANGE: bool>(&mut self, quad: &[Point; 4], limit: i32x4) -> f32x4 {
        let [x, y, z, _colour] = f32x4::transpose(quad.map(f32x4::from));
        // The bits of |c| as an integer order as |c| does, with infinity and then NaN at the end.
        let magnitude = |c: f32x4| must_cast::<f32x4, i32x4>(c) & i32x4::splat(i32::MAX);
        let largest = magnitude(x).max(magnitude(y)).max(magnitude(z));
        let finite = largest.simd_lt(i32x4::splat(INFINITY_BITS));
        let depth = if RANGE {
            let square = |c: f32x4| {
                let cut = c.abs().fast_min(f32x4::splat(SQUARABLE));
                cut * cut
            };
            (square(x) + square(y) + square(z)).sqrt()
        } else {
            z
        };
        let positive = finite & must_cast::<f32x4, i32x4>(depth.simd_ge(f32x4::splat(MIN_DEPTH)));
        let valid = positive & !largest.simd_gt(limit);
        self.count(depth, finite, positive, valid)
    }

    /// Counts four points by their masks; NaN where one is not valid.
    #[inline(always)]
    pub fn count(&mut self, depth: f32x4, finite: i32x4, positive: i32x4, valid: i32x4) -> f32x4 {
        // A mask is −1 in its lanes.
        self.finite -= finite;
        self.positive -= positive;
        self.valid -= valid;
        let mask: f32x4 = must_cast(valid);
        self.max_depth = self.max_depth.fast_max(depth & mask);
        self.min_depth = self.min_depth.fast_min(mask.select(depth, f32x4::splat(f32::INFINITY)));
        // All bits set are a NaN.
        depth | !mask
    }
}

fn lane_sum(counts: i32x4) -> usize {
    counts.to_array().into_iter().map(|count| count as usize).sum()
}
