//! Which table sets suit a frame, by a sample of it, and what it would cost.

use crate::contexts::{COLOUR_CONTEXTS, CONTEXTS, GEOMETRY_CONTEXTS, SYMBOLS};
use crate::encoder::{Encoder, overhead, overhead_bits};
use crate::frame::Settings;
use crate::load::Source;
use crate::rans::TileTokens;
use crate::syntax::{Neighbours, code_tile};
use crate::tables::{COLOUR_SETS, GEOMETRY_SETS, Sets, colour_base, geometry_base};
use crate::tile::ColourMode;

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

/// What the last frame told of table sets.
pub(crate) struct Learnt {
    sets: Sets,
    settings: Settings,
}

impl Learnt {
    fn is_like(&self, other: &Settings) -> bool {
        (self.settings.mode == ColourMode::None) == (other.mode == ColourMode::None)
            && (self.settings.mode == ColourMode::Palette) == (other.mode == ColourMode::Palette)
            && self.settings.depth_level.abs_diff(other.depth_level) <= 1
            && self.settings.quality.abs_diff(other.quality) <= 3
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

impl Encoder {
    /// Counts the symbols of one run of `per_packet` tiles in `step`, each as a packet would code it, and returns how many
    /// times as many tiles there are.
    pub fn count(
        &mut self,
        source: Source<'_>,
        settings: &Settings,
        per_packet: usize,
        step: usize,
        histogram: &mut Histogram,
    ) -> f32 {
        self.quantiser.scale = 1.0 / self.header.depth_step(settings.depth_level);
        let mut near = Neighbours::new();
        let tiles = self.grid.tiles();
        let mut seen = 0;
        for index in 0..tiles {
            if !is_sampled(index, per_packet, step) {
                continue;
            }
            if index % per_packet == 0 {
                near = Neighbours::new();
            }
            seen += 1;
            let place = self.grid.place(index);
            let columns = place.column..place.column + 1;
            self.quantiser.load(source, self.grid, place.row, columns, &mut self.row);
            let own = &self.row[place.column];
            self.preparer.prepare(own, &mut self.tile, self.patterns[index], settings, &self.palette);
            self.tokens.clear();
            code_tile(&mut self.tokens, &mut self.tile, &mut near, place, settings.mode);
            histogram.add(&self.tokens);
        }
        if seen == 0 { 0.0 } else { tiles as f32 / seen as f32 }
    }

    /// Sets the table sets that suit the frame: those that would have suited the last one best, where it was coded much
    /// alike, else those that code a sample of this one in the fewest bits.
    pub fn choose_tables(&mut self, source: Source<'_>, settings: &mut Settings) {
        match &self.learnt {
            Some(learnt) if learnt.is_like(settings) => {
                (settings.geometry_set, settings.colour_set) = learnt.sets;
            }
            _ => {
                self.estimate(source, settings);
            }
        }
    }

    /// Notes which sets would have suited the frame best, by the tiles of it that were counted on the way.
    pub(crate) fn learn(&mut self, settings: &Settings) {
        let (sets, _) = self.histogram.best_sets(self.tables.all_costs());
        self.learnt = Some(Learnt { sets, settings: *settings });
    }

    /// What a frame would cost with the best table sets, bytes, by a sample of it; the sets are put into `settings`.
    pub(crate) fn estimate(&mut self, source: Source<'_>, settings: &mut Settings) -> f32 {
        let mut histogram = core::mem::take(&mut self.histogram);
        histogram.clear();
        let share = self.count(source, settings, SAMPLE_TILES, SAMPLE_STEP, &mut histogram);
        let ((geometry, colour), bits) = histogram.best_sets(self.tables.all_costs());
        (settings.geometry_set, settings.colour_set) = (geometry, colour);
        self.histogram = histogram;
        // Headers and what the states waste.
        bits / 8.0 * share * (1.0 + overhead(settings.mode))
    }

    /// What the frame would take in one packet of any length, bits: what packets that need no other are measured against.
    /// The settings' tables are used, and the present patterns.
    pub fn bits_in_one_packet(&mut self, source: Source<'_>, settings: &Settings) -> f64 {
        let mut histogram = Histogram::default();
        self.count(source, settings, usize::MAX, 1, &mut histogram);
        self.tables.choose((settings.geometry_set, settings.colour_set));
        let costs = self.tables.costs();
        let symbols: f64 = histogram
            .counts
            .iter()
            .zip(costs)
            .map(|(n, cost)| f64::from(*n) * f64::from(*cost) / 256.0)
            .sum();
        // One header, one span, four states.
        symbols + histogram.raw_bits as f64 + f64::from(overhead_bits(settings.mode))
    }
}
