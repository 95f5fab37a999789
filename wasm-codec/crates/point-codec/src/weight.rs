//! The paper's depth weights (equations 4 and 5), as their reciprocals.
//!
//! v = 1 / ((z / max z)^λ + ε), and v = max(v) where z < D. The sampler's key is an exponential variate divided by v, so
//! what it needs is the *cost* 1/v = (z / max z)^λ + ε: no division, and no overflow where ε is small.

use wide::f32x4;

/// The power of a depth between 0 and the deepest; NaN stays NaN.
pub(crate) trait Power: Copy {
    fn of(self, ratio: f32x4) -> f32x4;
}

/// λ = 0: every point weighs the same.
#[derive(Clone, Copy)]
pub(crate) struct Even;

impl Power for Even {
    #[inline(always)]
    fn of(self, ratio: f32x4) -> f32x4 {
        ratio * f32x4::ZERO + f32x4::ONE
    }
}

/// λ is a whole number, by repeated multiplication.
#[derive(Clone, Copy)]
pub(crate) struct Whole(pub u32);

impl Power for Whole {
    #[inline(always)]
    fn of(self, ratio: f32x4) -> f32x4 {
        let mut power = f32x4::ONE;
        let mut square = ratio;
        let mut rest = self.0;
        while rest > 0 {
            if rest & 1 == 1 {
                power *= square;
            }
            square *= square;
            rest >>= 1;
        }
        power
    }
}

/// Any other λ.
#[derive(Clone, Copy)]
pub(crate) struct Real(pub f32);

impl Power for Real {
    #[inline(always)]
    fn of(self, ratio: f32x4) -> f32x4 {
        ratio.powf_simd(f32x4::splat(self.0))
    }
}

/// The cost 1/v of a point.
#[derive(Clone, Copy)]
pub(crate) struct Cost<P> {
    power: P,
    epsilon: f32x4,
    near: f32x4,
    per_depth: f32x4,
    lowest: f32x4,
}

impl<P: Power> Cost<P> {
    /// `min_depth` and `max_depth` are those of the frame's valid points, both normal numbers; points nearer than
    /// `near_distance` cost as little as the nearest.
    pub fn new(power: P, epsilon: f32, near_distance: f32, min_depth: f32, max_depth: f32) -> Self {
        let mut cost = Self {
            power,
            epsilon: f32x4::splat(epsilon),
            near: f32x4::ZERO,
            per_depth: f32x4::splat(1.0 / max_depth),
            lowest: f32x4::ZERO,
        };
        cost.lowest = cost.of(f32x4::splat(min_depth));
        cost.near = f32x4::splat(near_distance);
        cost
    }

    /// NaN for a depth of NaN.
    #[inline(always)]
    pub fn of(&self, depth: f32x4) -> f32x4 {
        let cost = self.power.of(depth * self.per_depth) + self.epsilon;
        depth.simd_lt(self.near).select(self.lowest, cost)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cost<P: Power>(power: P, depth: f32) -> f64 {
        f64::from(Cost::new(power, 1e-6, 3.85, 0.5, 20.0).of(f32x4::splat(depth)).to_array()[0])
    }

    fn assert_close(got: f64, exact: f64) {
        assert!((got / exact - 1.0).abs() < 2e-6, "{got:e} is not {exact:e}");
    }

    #[test]
    fn costs_are_the_reciprocals_of_the_papers_weights() {
        for depth in [3.85_f32, 4.0, 7.5, 12.25, 20.0] {
            let ratio = f64::from(depth) / 20.0;
            assert_close(cost(Even, depth), 1.0 + 1e-6);
            assert_close(cost(Whole(1), depth), ratio + 1e-6);
            assert_close(cost(Whole(3), depth), ratio.powi(3) + 1e-6);
            assert_close(cost(Whole(9), depth), ratio.powi(9) + 1e-6);
            assert_close(cost(Real(2.5), depth), ratio.powf(2.5) + 1e-6);
            assert_close(cost(Real(9.0), depth), ratio.powi(9) + 1e-6);
        }
    }

    #[test]
    fn no_depth_no_cost() {
        assert!(cost(Even, f32::NAN).is_nan());
        assert!(cost(Whole(3), f32::NAN).is_nan());
        assert!(cost(Real(2.5), f32::NAN).is_nan());
    }

    #[test]
    fn near_points_cost_what_the_nearest_costs() {
        let nearest = (0.5_f64 / 20.0).powi(3) + 1e-6;
        assert_close(cost(Whole(3), 0.5), nearest);
        assert_close(cost(Whole(3), 2.0), nearest);
        assert_close(cost(Whole(3), 3.849), nearest);
        assert!(cost(Whole(3), 3.85) > 50.0 * nearest);
    }
}
