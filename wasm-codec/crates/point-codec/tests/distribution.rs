//! The sampler's draws against the exact distribution of successive weighted sampling without replacement.
//!
//! For a small population the probability of every set of k points is computed by adding up, over subsets, the ways to
//! draw it one point after another. Many seeds give how often each set is drawn; a chi-square test compares. The seeds
//! are fixed: the outcome is always the same.

use farpoint_point_codec::{Point, Sampler, SamplingParameters};
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// The paper's weights (equations 4 and 5).
fn weights(depths: &[f32], parameters: &SamplingParameters) -> Vec<f64> {
    let max = depths.iter().copied().fold(0.0, f32::max);
    let weight = |z: f32| {
        let power = (f64::from(z) / f64::from(max)).powf(f64::from(parameters.lambda));
        1.0 / (power + f64::from(parameters.epsilon))
    };
    let highest = depths.iter().map(|z| weight(*z)).fold(0.0, f64::max);
    depths.iter().map(|z| if *z < parameters.near_distance { highest } else { weight(*z) }).collect()
}

/// The probability of each set of points (a bit mask) being the first that are drawn.
fn set_probabilities(weights: &[f64], count: u32) -> Vec<f64> {
    let total: f64 = weights.iter().sum();
    let sets = 1_usize << weights.len();
    let weight_of = |set: usize| -> f64 {
        weights.iter().enumerate().filter(|(i, _)| set >> i & 1 == 1).map(|(_, weight)| weight).sum()
    };
    let mut probability = vec![0.0; sets];
    probability[0] = 1.0;
    for set in 0..sets {
        if set.count_ones() < count {
            let rest = total - weight_of(set);
            for (i, weight) in weights.iter().enumerate() {
                if set >> i & 1 == 0 {
                    // Every larger set comes later in this order.
                    probability[set | 1 << i] += probability[set] * weight / rest;
                }
            }
        }
    }
    probability.iter().enumerate().map(|(set, p)| if set.count_ones() == count { *p } else { 0.0 }).collect()
}

/// How often each set is drawn.
fn draw(depths: &[f32], parameters: &SamplingParameters, draws: u64) -> Vec<u32> {
    let frame: Vec<Point> = depths.iter().map(|z| [0.0, 0.0, *z, 0.0]).collect();
    let mut sampler = Sampler::new(frame.len());
    let mut counts = vec![0; 1 << depths.len()];
    for seed in 0..draws {
        sampler.sample(&frame, &SamplingParameters { seed, ..*parameters }).unwrap();
        let set: usize = sampler.chosen().iter().map(|index| 1 << index).sum();
        counts[set] += 1;
    }
    counts
}

fn p_value(counts: &[u32], probabilities: &[f64], draws: u64) -> f64 {
    let mut statistic = 0.0;
    let mut cells = 0;
    // Sets too rare for the approximation count together.
    let (mut rare_count, mut rare_expected) = (0.0, 0.0);
    let mut add = |count: f64, expected: f64| {
        statistic += (count - expected).powi(2) / expected;
        cells += 1;
    };
    for (count, probability) in counts.iter().zip(probabilities) {
        let (count, expected) = (f64::from(*count), probability * draws as f64);
        if expected < 10.0 {
            rare_count += count;
            rare_expected += expected;
        } else {
            add(count, expected);
        }
    }
    if rare_expected > 1e-9 {
        add(rare_count, rare_expected);
    } else {
        assert_eq!(rare_count, 0.0, "an impossible set was drawn");
    }
    ChiSquared::new(f64::from(cells - 1)).unwrap().sf(statistic)
}

const DRAWS: u64 = 200_000;
const DEPTHS: [f32; 9] = [6.5, 0.9, 4.2, 12.0, 3.9, 2.1, 8.8, 5.0, 10.4];

fn check(parameters: SamplingParameters) -> f64 {
    let exact = set_probabilities(&weights(&DEPTHS, &parameters), parameters.count as u32);
    assert!((exact.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    p_value(&draw(&DEPTHS, &parameters, DRAWS), &exact, DRAWS)
}

#[test]
fn draws_follow_the_exact_distribution() {
    let paper = SamplingParameters { count: 3, ..SamplingParameters::default() };
    let cases = [
        paper,
        SamplingParameters { lambda: 0.0, ..paper },
        SamplingParameters { lambda: 1.0, near_distance: 0.0, ..paper },
        SamplingParameters { lambda: 2.5, near_distance: 0.0, ..paper },
        SamplingParameters { lambda: 7.0, count: 5, ..paper },
        // The widest spread of weights.
        SamplingParameters { lambda: 9.0, near_distance: 0.0, count: 6, ..paper },
        SamplingParameters { lambda: 3.0, epsilon: 0.5, count: 8, ..paper },
        SamplingParameters { count: 1, ..paper },
    ];
    for parameters in cases {
        let p = check(parameters);
        assert!(p > 0.001, "p = {p:e} with {parameters:?}");
    }
}

#[test]
fn the_test_notices_a_slightly_wrong_distribution() {
    let parameters =
        SamplingParameters { count: 3, near_distance: 0.0, lambda: 1.0, ..SamplingParameters::default() };
    let counts = draw(&DEPTHS, &parameters, DRAWS);
    let nearly = SamplingParameters { lambda: 1.03, ..parameters };
    let wrong = set_probabilities(&weights(&DEPTHS, &nearly), 3);
    assert!(p_value(&counts, &wrong, DRAWS) < 1e-6);
}
