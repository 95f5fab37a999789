//! Which table sets suit a frame, by a sample of it, and what it would cost.

use crate::frame::{Frame, Mix, Settings};
use crate::frame_encoder::FrameEncoder;
use crate::histogram::{Histogram, SAMPLE_STEP, SAMPLE_TILES, is_sampled};
use crate::load::Source;
use crate::packet_cost::{overhead, overhead_bits};
use crate::plan::Plan;
use crate::stream::StreamHeader;
use crate::syntax::Neighbours;
use crate::tables::Sets;
use crate::tile::ColourMode;

/// What the last frame told of table sets.
struct Learnt {
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

/// Codes frames, and finds table sets for them.
pub(crate) struct SamplingEncoder {
    pub frames: FrameEncoder,
    sample: Histogram,
    learnt: Option<Learnt>,
}

impl SamplingEncoder {
    /// `None` where a value of the header is outside its range.
    pub fn new(header: &StreamHeader) -> Option<Self> {
        header.is_valid().then(|| Self {
            frames: FrameEncoder::new(header),
            sample: Histogram::default(),
            learnt: None,
        })
    }

    /// True for frames with the stream's number of pixels.
    pub fn takes(&self, source: Source<'_>) -> bool {
        let grid = self.frames.tiles.grid();
        source.len() == grid.width * grid.height
    }

    /// As [`FrameEncoder::encode`], and notes which sets would have suited the frame best. `None` for frames that
    /// [`SamplingEncoder::takes`] refuses.
    pub fn encode(&mut self, source: Source<'_>, mix: &Mix, plan: Option<&mut Plan>) -> Option<Frame> {
        if !self.takes(source) {
            return None;
        }
        let frame = self.frames.encode(source, mix, plan);
        let (sets, _) = self.frames.histogram.best_sets(self.frames.tables.all_costs());
        self.learnt = Some(Learnt { sets, settings: mix.coarser });
        Some(frame)
    }

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
        count(&mut self.frames, source, settings, (per_packet, step), histogram)
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

    /// What a frame would cost with the best table sets, bytes, by a sample of it; the sets are put into `settings`.
    pub fn estimate(&mut self, source: Source<'_>, settings: &mut Settings) -> f32 {
        self.sample.clear();
        let share = count(&mut self.frames, source, settings, (SAMPLE_TILES, SAMPLE_STEP), &mut self.sample);
        let (sets, bits) = self.sample.best_sets(self.frames.tables.all_costs());
        (settings.geometry_set, settings.colour_set) = sets;
        // Headers and what the states waste.
        bits / 8.0 * share * (1.0 + overhead(settings.mode))
    }

    /// What the frame would take in one packet of any length, bits: what packets that need no other are measured against.
    /// The settings' tables are used, and the present patterns.
    pub fn bits_in_one_packet(&mut self, source: Source<'_>, settings: &Settings) -> f64 {
        let mut histogram = Histogram::default();
        self.count(source, settings, usize::MAX, 1, &mut histogram);
        let tables = &mut self.frames.tables;
        tables.choose((settings.geometry_set, settings.colour_set));
        let symbols: f64 = histogram
            .counts
            .iter()
            .zip(tables.costs())
            .map(|(n, cost)| f64::from(*n) * f64::from(*cost) / 256.0)
            .sum();
        // One header, one span, four states.
        symbols + histogram.raw_bits as f64 + f64::from(overhead_bits(settings.mode))
    }
}

/// See [`SamplingEncoder::count`].
fn count(
    FrameEncoder { tiles: encoder, patterns, .. }: &mut FrameEncoder,
    source: Source<'_>,
    settings: &Settings,
    (per_packet, step): (usize, usize),
    histogram: &mut Histogram,
) -> f32 {
    let mut near = Neighbours::new();
    let mut seen = 0;
    for (tile, pattern) in patterns.iter().enumerate() {
        if !is_sampled(tile, per_packet, step) {
            continue;
        }
        if tile % per_packet == 0 {
            near = Neighbours::new();
        }
        seen += 1;
        let place = encoder.grid().place(tile);
        encoder.load(source, place.row, place.column..place.column + 1, settings.depth_level);
        encoder.prepare(place.column, *pattern, settings);
        encoder.code(&mut near, place, settings.mode);
        histogram.add(encoder.tokens());
    }
    if seen == 0 { 0.0 } else { patterns.len() as f32 / seen as f32 }
}
