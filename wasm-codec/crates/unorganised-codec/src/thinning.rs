//! Which points to leave out so that a frame fits a number of bytes: evenly along the order, more of the far ones.

use crate::quantise::GridPoint;

/// Points nearer than this weigh the same, metres.
const NEAR_M: f32 = 4.0;

/// Weights by octave quarters: enough to foresee how many points a scale keeps.
const BINS: usize = 128;

/// What the points weigh.
#[derive(Default)]
pub struct Weights {
    /// 0 to 1, one a point.
    pub each: Vec<f32>,
    /// Count and sum of the weights in each bin.
    bins: Vec<(f32, f32)>,
}

impl Weights {
    /// The share of each point before scaling: (range / 4 m)^−lambda, at most 1.
    pub fn fill(&mut self, points: &[GridPoint], step_mm: u8, lambda: f32) {
        let step = f32::from(step_mm) / 1000.0;
        self.each.clear();
        self.bins.clear();
        self.bins.resize(BINS, (0.0, 0.0));
        for point in points {
            let [x, y, z] = point.at.map(|coordinate| coordinate as f32 * step);
            let range = (x * x + y * y + z * z).sqrt();
            let weight = if lambda == 0.0 || range <= NEAR_M { 1.0 } else { (range / NEAR_M).powf(-lambda) };
            self.each.push(weight);
            let bin = &mut self.bins[((-weight.log2() * 4.0) as usize).min(BINS - 1)];
            *bin = (bin.0 + 1.0, bin.1 + weight);
        }
    }

    /// The scale that keeps about `count` points.
    pub fn scale_for(&self, count: f32) -> f32 {
        let kept =
            |scale: f32| -> f32 { self.bins.iter().map(|(count, sum)| (sum * scale).min(*count)).sum() };
        let (mut low, mut high) = (0.0, 1.0);
        while kept(high) < count && high < 1e20 {
            low = high;
            high *= 4.0;
        }
        for _ in 0..24 {
            let middle = (low + high) / 2.0;
            if kept(middle) < count { low = middle } else { high = middle }
        }
        low
    }
}

/// Keeps each point with probability min(1, scale × weight), its remainder carried on to the next: no clumps, no gaps.
pub fn thin(order: &[u32], weights: &[f32], scale: f32, kept: &mut Vec<u32>) {
    kept.clear();
    let mut carry = 0.5;
    for index in order {
        carry += (weights[*index as usize] * scale).min(1.0);
        if carry >= 1.0 {
            carry -= 1.0;
            kept.push(*index);
        }
    }
}
