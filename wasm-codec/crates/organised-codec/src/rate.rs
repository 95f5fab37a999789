//! A frame in so many bytes: the mix of depth step, colour quality and thinning.
//!
//! Between two rungs of a ladder the nearer tiles get the finer one, so that the budget is met without leaving a point out;
//! only below the last rung far tiles are thinned. What frames cost is learnt from frame to frame, so that a steady stream
//! takes one pass a frame.

use crate::budget::{Budget, BudgetColour, Spent};
use crate::frame::{Frame, Mix, Settings};
use crate::ladder::{first_rung, rungs, settings_of};
use crate::load::Source;
use crate::packet::MAX_PACKET_BYTES;
use crate::packet_cost::overhead_bits;
use crate::place_search::PlaceSearch;
use crate::rung_costs::{RungCosts, Rungs};
use crate::sampling::SamplingEncoder;

/// Passes over a frame at most, and those that go by what tiles cost; the rest go by what the frame did.
const PASSES: usize = 12;
const GUIDED_PASSES: usize = 3;
/// After so many guided passes with the same result another one would be no different.
const MOST_ALIKE: usize = 2;
/// What is aimed at, and what is taken without another pass: shares of the budget.
const AIM: f32 = 0.985;
const LEAST: f32 = 0.955;
const MOST: f32 = 1.045;
/// Over by so little no frame is coded again.
const SLACK_BYTES: usize = 24;

/// What is remembered from frame to frame.
#[derive(Default)]
pub(crate) struct RateState {
    coloured: RungCosts,
    /// Of frames with coarse colours.
    coarse: RungCosts,
    /// Of frames without colour: latency tests.
    plain: RungCosts,
}

impl RateState {
    /// See [`crate::Encoder::encode_within`].
    pub fn encode(
        &mut self,
        encoder: &mut SamplingEncoder,
        source: Source<'_>,
        budget: &Budget,
    ) -> Option<Spent> {
        if !encoder.takes(source) {
            return None;
        }
        let costs = match budget.colour {
            _ if budget.latency_test => &mut self.plain,
            BudgetColour::Coarse => &mut self.coarse,
            BudgetColour::Suited | BudgetColour::Palette => &mut self.coloured,
        };
        costs.begin(encoder, source, budget);
        let wanted = wanted_bits(budget);
        let search = RateSearch {
            encoder,
            costs,
            source,
            budget,
            wanted,
            passes: 0,
            alike: 0,
            bytes_before: usize::MAX,
            places: PlaceSearch::new((wanted / 8.0) as usize, (rungs(budget) - 1) as f32),
            place: None,
        };
        search.run()
    }
}

/// Bits to aim at. The last packet is rarely full, which wastes half a packet's header and states on average.
fn wanted_bits(budget: &Budget) -> f32 {
    let overhead = overhead_bits(settings_of(first_rung(budget), budget).mode);
    ((budget.bytes as f32 * 8.0 - overhead / 2.0) * AIM).max(1.0)
}

/// Passes over one frame until it fits its budget.
struct RateSearch<'a> {
    encoder: &'a mut SamplingEncoder,
    costs: &'a mut RungCosts,
    source: Source<'a>,
    budget: &'a Budget,
    /// Bits to aim at.
    wanted: f32,
    passes: usize,
    /// Guided passes in a row that gave as many bytes as the one before.
    alike: usize,
    bytes_before: usize,
    /// The search by trial, for frames that the learnt costs do not lead to their budget.
    places: PlaceSearch,
    /// Where on the ladder the last guided pass was. `None` before the first one, and where it thinned tiles.
    place: Option<f32>,
}

impl RateSearch<'_> {
    fn run(mut self) -> Option<Spent> {
        loop {
            let tried = self.next_place();
            let rungs = match tried {
                Some(place) => self.costs.rungs_at(place),
                None => self.costs.find_rungs(self.encoder, self.source, self.budget, self.wanted),
            };
            let mix = self.mix(&rungs, tried.is_some());
            self.costs.plan.begin(self.wanted, rungs.means);
            let mut frame = self.encoder.encode(self.source, &mix, Some(&mut self.costs.plan))?;
            self.passes += 1;
            self.costs.learn(&rungs);
            // The dearest rung for the whole frame: it has no more to tell.
            let is_best = rungs.coarser == 0 || tried == Some(0.0);
            let is_good = self.is_good(&frame, is_best);
            self.note(&frame, &rungs, tried);
            if is_good || self.alike == MOST_ALIKE || self.passes == PASSES {
                let settings = self.mostly(&mix);
                let limit = self.budget.bytes + MAX_PACKET_BYTES / 2;
                let dropped = self.encoder.frames.writer.drop_last(limit, &mut frame);
                return Some(Spent { frame, settings, dropped, passes: self.passes });
            }
        }
    }

    /// Where on the ladder to try next; `None` for a pass guided by the learnt costs.
    fn next_place(&mut self) -> Option<f32> {
        let searches = self.passes >= GUIDED_PASSES || self.alike > 0;
        let from = self.place.filter(|_| searches)?;
        self.places.next(from)
    }

    /// The settings of two rungs. Both get the same tables, for they differ little. A place that is tried can be far from the
    /// last pass, whose tables may not suit it: there a sample chooses them.
    fn mix(&mut self, rungs: &Rungs, searched: bool) -> Mix {
        let mut coarser = settings_of(rungs.coarser, self.budget);
        if searched {
            self.encoder.estimate(self.source, &mut coarser);
        } else {
            self.encoder.choose_tables(self.source, &mut coarser);
        }
        let Settings { geometry_set, colour_set, .. } = coarser;
        let finer = Settings { geometry_set, colour_set, ..settings_of(rungs.finer, self.budget) };
        Mix { finer, coarser }
    }

    /// True where no further pass is needed.
    fn is_good(&self, frame: &Frame, is_best: bool) -> bool {
        let spent = frame.bytes as f32 / self.budget.bytes.max(1) as f32;
        let over = frame.bytes.saturating_sub(self.budget.bytes);
        let fits = over <= SLACK_BYTES || (spent <= MOST && over <= MAX_PACKET_BYTES / 2);
        // Where the costs were far off, what was coded last got too much or too little.
        let is_even = self.passes > 1 || (0.75..1.35).contains(&self.costs.plan.dearer);
        fits && is_even && (spent >= LEAST || is_best)
    }

    /// Notes what a pass gave.
    fn note(&mut self, frame: &Frame, rungs: &Rungs, tried: Option<f32>) {
        let is_alike = frame.bytes == self.bytes_before && tried.is_none();
        self.alike = if is_alike { self.alike + 1 } else { 0 };
        self.bytes_before = frame.bytes;
        match tried {
            Some(place) => self.places.note(place, frame.bytes),
            None => self.place = self.costs.plan.finer_share().map(|share| rungs.coarser as f32 - share),
        }
    }

    /// The settings of most of the frame's tiles.
    fn mostly(&self, mix: &Mix) -> Settings {
        let tiles = self.encoder.frames.tiles.grid().tiles();
        if 2 * self.costs.plan.finer_tiles >= tiles { mix.finer } else { mix.coarser }
    }
}
