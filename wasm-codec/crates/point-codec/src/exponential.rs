//! Exponentially distributed variates, four at a time, exact to a few units in the last place of an `f32`.
//!
//! A variate is −ln(1 − t) with t uniform in (0, 1) on a grid of 2⁻³¹, computed from t itself and not from 1 − t alone, so
//! that small variates, the very ones that a selection of the smallest keys compares, keep their relative precision.

use bytemuck::must_cast;
use wide::{f32x4, i32x4, u32x4};

/// xoshiro128+ (Blackman and Vigna, made for floating-point numbers) in four lanes with states of their own.
#[derive(Clone, Debug)]
pub struct Generator {
    state: [u32x4; 4],
}

impl Generator {
    /// All four lanes are seeded from one number through SplitMix64, as the generator's authors advise.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        let mut mix = seed;
        let mut next = || {
            mix = mix.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let z = (mix ^ (mix >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            ((z ^ (z >> 31)) >> 32) as u32
        };
        let mut state = [u32x4::ZERO; 4];
        for word in &mut state {
            *word = u32x4::from([next(), next(), next(), next()]);
        }
        // A lane that starts at all zeros would stay there.
        state[0] |= u32x4::splat(1);
        Self { state }
    }

    /// The next 32 random bits of each lane.
    #[inline(always)]
    pub fn bits(&mut self) -> u32x4 {
        let [s0, s1, s2, s3] = self.state;
        let result = s0 + s3;
        let shifted = s1 << 9;
        let s2 = s2 ^ s0;
        let s3 = s3 ^ s1;
        self.state = [s0 ^ s3, s1 ^ s2, s2 ^ shifted, (s3 << 11) | (s3 >> 21)];
        result
    }

    /// The next uniform number of each lane: a whole number from 1 to [`UNIFORM_SCALE`], as a float. Divided by
    /// [`UNIFORM_SCALE`] it is the t of [`minus_ln_one_minus`].
    #[inline(always)]
    pub fn uniform(&mut self) -> f32x4 {
        // 31 bits, so that the conversion to float is one of signed integers; never 0.
        let bits: i32x4 = must_cast((self.bits() >> 1) | u32x4::splat(1));
        f32x4::from_i32x4(bits)
    }
}

/// What the numbers of [`Generator::uniform`] are to be divided by: 2³¹.
pub const UNIFORM_SCALE: f32 = 2_147_483_648.0;

/// The Exp(1) variate that belongs to a number of [`Generator::uniform`].
#[inline(always)]
#[must_use]
pub fn exponential(uniform: f32x4) -> f32x4 {
    minus_ln_one_minus(uniform * f32x4::splat(1.0 / UNIFORM_SCALE))
}

/// The largest variate, −ln 2⁻²⁵ (rounded up): larger ones have a probability of 3e-8.
pub const LARGEST: f32 = 17.33;

/// −ln(1 − t) for t in [0, 1], with a relative error below 4e-7 up to t = ½ and an absolute one of 2⁻²⁵ / (1 − t) beyond;
/// never more than [`LARGEST`].
#[inline(always)]
#[must_use]
pub fn minus_ln_one_minus(t: f32x4) -> f32x4 {
    let w = (f32x4::ONE - t).fast_max(f32x4::splat(1.0 / 33_554_432.0));
    // What the subtraction rounded away: all of t where t is small.
    let lost = (f32x4::ONE - w) - t;
    // w = m · 2ᵏ with m in [√½, √2): then ln m is 2 artanh(s) with |s| ≤ 0.172, close to a polynomial in s². The
    // coefficients are the minimax ones of degree 3 (relative error 7e-10 before rounding to f32).
    const SQRT_HALF_BITS: i32 = 0x3f35_04f3;
    const COEFFICIENTS: [f32; 4] = [2.0, 0.666_668_2, 0.399_747_95, 0.299_256_5];
    let bits = must_cast::<f32x4, i32x4>(w) - i32x4::splat(SQRT_HALF_BITS);
    let k = f32x4::from_i32x4(bits >> 23);
    let m: f32x4 = must_cast((bits & i32x4::splat(0x007f_ffff)) + i32x4::splat(SQRT_HALF_BITS));
    let f = (m - f32x4::ONE) + lost;
    let s = f / (f32x4::splat(2.0) + f);
    let square = s * s;
    let mut sum = f32x4::splat(-COEFFICIENTS[3]);
    for coefficient in COEFFICIENTS[..3].iter().rev() {
        sum = sum * square - f32x4::splat(*coefficient);
    }
    s * sum - k * f32x4::splat(core::f32::consts::LN_2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logarithm_keeps_its_relative_precision() {
        let mut worst = 0.0_f64;
        for i in 0..200_000_u32 {
            // From 2^-31 to 1/2, evenly in the logarithm.
            let t = f64::from(i + 1).mul_add(30.0 / 200_000.0, -31.0).exp2() as f32;
            let exact = -(-f64::from(t)).ln_1p();
            let got = f64::from(minus_ln_one_minus(f32x4::splat(t)).to_array()[0]);
            worst = worst.max((got / exact - 1.0).abs());
        }
        assert!(worst < 4e-7, "relative error {worst:e}");
        assert_eq!(minus_ln_one_minus(f32x4::ZERO).to_array(), [0.0; 4]);
        for i in 0..200_000_u32 {
            let t = 0.5 + 0.5 * (i as f32 / 200_000.0);
            let rest = 1.0 - f64::from(t);
            let error = f64::from(minus_ln_one_minus(f32x4::splat(t)).to_array()[0]) + rest.ln();
            assert!(error.abs() < 2.0_f64.powi(-25) / rest + 1e-6, "at {t}: {error:e}");
        }
        let last = minus_ln_one_minus(f32x4::ONE).to_array()[0];
        assert!(last <= LARGEST && last > LARGEST - 0.01);
    }

    #[test]
    fn variates_follow_the_exponential_distribution() {
        // Kolmogorov–Smirnov over both ends: with x itself, and with the small values on their own.
        let mut generator = Generator::new(7);
        let mut values: Vec<f32> =
            (0..250_000).flat_map(|_| exponential(generator.uniform()).to_array()).collect();
        values.sort_by(f32::total_cmp);
        assert!(values[0] > 0.0 && values[values.len() - 1] <= LARGEST);
        let distance = |sorted: &[f32], cdf: &dyn Fn(f64) -> f64| {
            let n = sorted.len() as f64;
            let mut worst = 0.0_f64;
            for (i, x) in sorted.iter().enumerate() {
                let p = cdf(f64::from(*x));
                worst = worst.max((p - i as f64 / n).abs()).max((p - (i + 1) as f64 / n).abs());
            }
            worst * n.sqrt()
        };
        // 1.95 is the distance exceeded with probability 0.001.
        assert!(distance(&values, &|x| -(-x).exp_m1()) < 1.95);
        let small = values.partition_point(|x| *x < 0.01);
        let within = -(-0.01_f64).exp_m1();
        assert!(distance(&values[..small], &|x| -(-x).exp_m1() / within) < 1.95);
    }

    #[test]
    fn lanes_and_seeds_differ() {
        let first = Generator::new(0).bits().to_array();
        let second = Generator::new(1).bits().to_array();
        for i in 0..4 {
            assert_ne!(first[i], second[i]);
            for j in 0..i {
                assert_ne!(first[i], first[j]);
            }
        }
        assert_eq!(first, Generator::new(0).bits().to_array());
    }
}
