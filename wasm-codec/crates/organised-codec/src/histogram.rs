//! How often a frame uses each symbol, and the table sets that suit it.

use crate::contexts::{COLOUR_CONTEXTS, CONTEXTS, GEOMETRY_CONTEXTS, SYMBOLS};
use crate::rans::TileTokens;
use crate::tables::{COLOUR_SETS, GEOMETRY_SETS, Sets, colour_base, geometry_base};

/// How often each symbol occurs.
#[derive(Clone, Debug)]
pub struct Histogram {
    /// By context and symbol.
    pub counts: Vec<u32>,
    /// Raw bits.
    pub raw_bits: u64,
}

impl Default for Histogram {
    fn default() -> Self {
        Self { counts: vec![0; CONTEXTS * SYMBOLS], raw_bits: 0 }
    }
}

impl Histogram {
    /// Nothing.
    pub fn clear(&mut self) {
        self.counts.fill(0);
        self.raw_bits = 0;
    }

    pub(crate) fn add(&mut self, tile: &TileTokens) {
        for symbol in tile.symbols() {
            self.counts[symbol] += 1;
        }
        self.raw_bits += u64::from(tile.raw_bits());
    }

    /// The sets that code these symbols in the fewest bits, and in how many, raw ones included.
    #[must_use]
    pub fn best_sets(&self, all_costs: &[u16]) -> (Sets, f32) {
        let (geometry, colour) = self.counts.split_at(GEOMETRY_CONTEXTS * SYMBOLS);
        let cost = |counts: &[u32], base: usize| -> u64 {
            let costs = &all_costs[base..base + counts.len()];
            counts.iter().zip(costs).map(|(count, cost)| u64::from(*count) * u64::from(*cost)).sum()
        };
        let best = |sets: usize, counts: &[u32], base: &dyn Fn(usize) -> usize| {
            (0..sets).map(|set| (cost(counts, base(set)), set)).min().unwrap_or((0, 0))
        };
        let (geometry_cost, geometry_set) = best(GEOMETRY_SETS, geometry, &geometry_base);
        let (colour_cost, colour_set) = best(COLOUR_SETS, &colour[..COLOUR_CONTEXTS * SYMBOLS], &colour_base);
        let bits = (geometry_cost + colour_cost) as f32 / 256.0 + self.raw_bits as f32;
        ((geometry_set as u8, colour_set as u8), bits)
    }
}

/// True for the tiles of a sample: one run in so many, so that every column of the image has its turn.
pub(crate) fn is_sampled(tile: usize, run_tiles: usize, step: usize) -> bool {
    let run = tile / run_tiles;
    (run + run / step).is_multiple_of(step)
}

/// Tiles in a row of which one run in so many is counted.
pub(crate) const SAMPLE_TILES: usize = 12;
pub(crate) const SAMPLE_STEP: usize = 8;
