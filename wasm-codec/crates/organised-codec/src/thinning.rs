//! Which pattern each tile gets: the paper's validity of its depth (equations 4 and 5), far tiles thinned first.

use crate::load::Source;
use crate::tile::{Grid, Pattern, TILE};

/// The paper's parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Validity {
    /// λ: how fast validity falls with depth.
    pub lambda: f32,
    /// ε: keeps the nearest from weighing infinitely much.
    pub epsilon: f32,
    /// D: nearer points weigh as much as the nearest, metres.
    pub near_distance: f32,
}

impl Default for Validity {
    fn default() -> Self {
        Self { lambda: 3.0, epsilon: 1e-6, near_distance: 3.85 }
    }
}

impl Validity {
    /// True where the weights are finite and positive.
    #[must_use]
    pub fn is_valid(&self) -> bool {
        (0.0..=64.0).contains(&self.lambda)
            && (1e-12..=1.0).contains(&self.epsilon)
            && self.near_distance >= 0.0
            && self.near_distance.is_finite()
    }
}

/// Of every tile: its mean depth by a sample, metres, or 0 where that saw nothing.
pub(crate) fn tile_depths(source: Source<'_>, grid: Grid, depths: &mut Vec<f32>) {
    depths.clear();
    for tile in 0..grid.tiles() {
        let place = grid.place(tile);
        let (mut sum, mut count) = (0.0, 0.0);
        for y in (1..TILE).step_by(4) {
            let v = place.row * TILE + y;
            if v >= grid.height {
                break;
            }
            for x in (1..TILE).step_by(4) {
                let u = place.column * TILE + x;
                if u < grid.width {
                    let depth = source.depth(v * grid.width + u);
                    if depth > 0.0 && depth < f32::INFINITY {
                        sum += depth;
                        count += 1.0;
                    }
                }
            }
        }
        depths.push(if count > 0.0 { sum / count } else { 0.0 });
    }
}

/// Turns tiles' depths into −log2 of their validity's share of the largest. A tile of which the sample saw nothing is
/// thinned with the nearest.
pub(crate) fn halvings(validity: &Validity, depths: &mut [f32]) {
    let (mut nearest, mut deepest) = (f32::INFINITY, 0.0_f32);
    for depth in depths.iter().filter(|depth| **depth > 0.0) {
        nearest = nearest.min(*depth);
        deepest = deepest.max(*depth);
    }
    let cost = |depth: f32| (depth / deepest.max(1e-6)).powf(validity.lambda) + validity.epsilon;
    let least = cost(nearest.min(deepest));
    for depth in depths {
        *depth = if *depth < validity.near_distance { 0.0 } else { (cost(*depth) / least).log2() };
    }
}

/// The pattern of a tile whose validity is 2^−`halvings` of the largest, where the largest has 2^−`shift` of its points
/// kept. Between two patterns a fixed mixture of both.
pub(crate) fn pattern(tile: usize, halvings: f32, shift: f32) -> Pattern {
    let wanted = (halvings + shift + dither(tile)).max(0.0);
    Pattern((wanted as u8).min(Pattern::COUNT - 1))
}

/// 0 to 1 of each tile, low-discrepancy, so that any run of tiles holds its share of either of two patterns.
pub(crate) fn dither(tile: usize) -> f32 {
    let hash = (tile as u32).wrapping_mul(0x9e37_79b9);
    (hash as f32 / 4_294_967_296.0).min(0.999)
}

/// Thins by validity alone: the nearest tiles keep `density` of their points, farther ones less.
pub(crate) fn thin(
    source: Source<'_>,
    grid: Grid,
    validity: &Validity,
    density: f32,
    patterns: &mut [Pattern],
) {
    let mut depths = Vec::new();
    tile_depths(source, grid, &mut depths);
    halvings(validity, &mut depths);
    let shift = -density.clamp(1e-3, 1e6).log2();
    for (tile, (own, halvings)) in patterns.iter_mut().zip(&depths).enumerate() {
        *own = pattern(tile, *halvings, shift);
    }
}
