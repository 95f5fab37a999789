//! A frame in so many bytes: the mix of depth step, colour quality and thinning.
//!
//! Between two rungs of a ladder the nearer tiles get the finer one, so that the budget is met without leaving a point out;
//! only below the last rung far tiles are thinned. What frames cost is learnt from frame to frame, so that a steady stream
//! takes one pass a frame.

use crate::encoder::{Encoder, overhead_bits};
use crate::frame::{Frame, Mix, Settings};
use crate::load::Source;
use crate::packet::MAX_PACKET_BYTES;
use crate::place_search::PlaceSearch;
use crate::plan::{Means, Plan};
use crate::thinning::{Validity, halvings, tile_depths};
use crate::tile::{ColourMode, Pattern};

/// What a budget buys.
struct Rung {
    depth_level: u8,
    quality: u8,
    /// Chroma as fine as luma.
    full: bool,
    /// Of the bits at other rungs, as a first guess; what frames cost corrects it.
    share: f32,
}

const fn rung(depth_level: u8, quality: u8, full: bool, share: f32) -> Rung {
    Rung { depth_level, quality, full, share }
}

/// The dearest first.
const LADDER: [Rung; RUNGS] = [
    rung(0, 2, true, 3.18),
    rung(1, 4, true, 2.43),
    rung(2, 6, true, 1.83),
    rung(2, 7, true, 1.76),
    rung(3, 7, true, 1.53),
    rung(3, 8, true, 1.46),
    rung(3, 9, true, 1.4),
    rung(3, 10, true, 1.33),
    rung(3, 11, true, 1.28),
    rung(3, 11, false, 1.19),
    rung(3, 12, false, 1.15),
    rung(3, 13, false, 1.12),
    rung(3, 14, false, 1.09),
    rung(3, 15, false, 1.06),
    rung(3, 16, false, 1.04),
    rung(3, 17, false, 1.02),
    rung(3, 18, false, 1.0),
    rung(4, 18, false, 0.853),
    rung(4, 19, false, 0.836),
    rung(4, 20, false, 0.82),
    rung(5, 20, false, 0.619),
    rung(5, 21, false, 0.607),
    rung(5, 22, false, 0.595),
    rung(5, 24, false, 0.578),
    rung(6, 25, false, 0.39),
    rung(6, 26, false, 0.384),
];
const RUNGS: usize = 26;
/// What geometry costs by depth level, as a first guess.
const LEVELS: [f32; 7] = [2.36, 1.75, 1.25, 1.0, 0.83, 0.6, 0.395];
/// The rung that a stream's first estimate is for.
const FIRST_RUNG: usize = 16;

/// Passes over a frame at most, and those that go by what tiles cost; the rest go by what the frame did.
const PASSES: usize = 12;
const GUIDED_PASSES: usize = 3;
/// What is aimed at, and what is taken without another pass: shares of the budget.
const AIM: f32 = 0.985;
const LEAST: f32 = 0.955;
const MOST: f32 = 1.045;
/// Over by so little no frame is coded again.
const SLACK_BYTES: usize = 24;

/// A limit for a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Budget {
    /// Bytes of all packets.
    pub bytes: usize,
    /// Which tiles are thinned first.
    pub validity: Validity,
    /// All points pure green.
    pub latency_test: bool,
    /// Colours by the stream's palette.
    pub palette: bool,
}

/// What is remembered from frame to frame.
#[derive(Default)]
pub(crate) struct RateState {
    coloured: Costs,
    /// Of frames without colour: latency tests.
    plain: Costs,
}

/// What frames of one kind cost.
#[derive(Default)]
struct Costs {
    /// At every rung, as shares of the plan's costs.
    shares: [f32; RUNGS],
    /// Rungs whose share was found with a frame, not guessed.
    found: [bool; RUNGS],
    /// The coarser rung of the last frame.
    rung: usize,
    plan: Plan,
}

/// What a budget was spent on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spent {
    /// The frame.
    pub frame: Frame,
    /// How most of it was coded.
    pub settings: Settings,
    /// Points in packets that were dropped because the budget was exceeded all the same.
    pub dropped: usize,
    /// Passes over the frame.
    pub passes: usize,
}

impl Encoder {
    /// Codes a frame within 5 % of the budget, or as far below it as the frame is smaller in the best quality. It is not over
    /// by more than a packet. `None` where the frame has not the header's number of pixels.
    pub fn encode_within(&mut self, source: Source<'_>, budget: &Budget) -> Option<Spent> {
        let grid = self.header().grid();
        if source.len() != grid.width * grid.height {
            return None;
        }
        let mut costs = core::mem::take(self.rate.of(budget));
        tile_depths(source, grid, &mut costs.plan.depths);
        costs.plan.halvings.clone_from(&costs.plan.depths);
        halvings(&budget.validity, &mut costs.plan.halvings);
        if !costs.plan.is_known() {
            let mut settings = settings_of(FIRST_RUNG, budget);
            self.patterns.fill(Pattern(0));
            let bytes = self.estimate(source, &mut settings);
            costs.shares = first_shares(budget);
            costs.found = core::array::from_fn(|rung| rung == FIRST_RUNG);
            costs.rung = FIRST_RUNG;
            costs.plan.guess(bytes * 8.0 / costs.shares[FIRST_RUNG]);
        }
        // The last packet is rarely full: half a packet's header and states come on top.
        let overhead = overhead_bits(settings_of(FIRST_RUNG, budget).mode);
        let wanted = ((budget.bytes as f32 * 8.0 - overhead / 2.0) * AIM).max(1.0);
        let (mut passes, mut before, mut alike) = (0, usize::MAX, 0);
        let (mut frame, mut settings): (Frame, Settings);
        let mut search = PlaceSearch::new((wanted / 8.0) as usize, (RUNGS - 1) as f32);
        let mut place = None;
        loop {
            let searches = passes >= GUIDED_PASSES || alike > 0;
            let next = place.filter(|_| searches).and_then(|place| search.next(place));
            let (finer, coarser, means) = match next {
                Some(place) => costs.rungs_at(place),
                None => self.find_rungs(source, budget, wanted, &mut costs),
            };
            let mut mix = Mix { finer: settings_of(finer, budget), coarser: settings_of(coarser, budget) };
            // The same tables for both: they differ little. Those that the last pass taught may suit a far place badly.
            if next.is_some() {
                self.estimate(source, &mut mix.coarser);
            } else {
                self.choose_tables(source, &mut mix.coarser);
            }
            mix.finer.geometry_set = mix.coarser.geometry_set;
            mix.finer.colour_set = mix.coarser.colour_set;
            costs.plan.begin(wanted, means);
            frame = self.encode_mixed(source, &mix, Some(&mut costs.plan))?;
            passes += 1;
            costs.learn(finer, coarser);
            let mostly_finer = 2 * costs.plan.finer_tiles >= grid.tiles();
            settings = if mostly_finer { mix.finer } else { mix.coarser };
            let spent = frame.bytes as f32 / budget.bytes.max(1) as f32;
            let over = frame.bytes.saturating_sub(budget.bytes);
            // The dearest rung for the whole frame: it has no more to tell.
            let all = coarser == 0 || next == Some(0.0);
            let fits = over <= SLACK_BYTES || (spent <= MOST && over <= MAX_PACKET_BYTES / 2);
            // Where the costs were far off, what was coded last got too much or too little.
            let even = passes > 1 || (0.75..1.35).contains(&costs.plan.dearer);
            let good = fits && even && (spent >= LEAST || all);
            alike = if frame.bytes == before && next.is_none() { alike + 1 } else { 0 };
            before = frame.bytes;
            match next {
                Some(place) => search.note(place, frame.bytes),
                None => place = costs.plan.finer_share().map(|share| coarser as f32 - share),
            }
            if good || alike == 2 || passes == PASSES {
                break;
            }
        }
        let dropped = self.drop_far(budget.bytes + MAX_PACKET_BYTES / 2, &mut frame);
        *self.rate.of(budget) = costs;
        Some(Spent { frame, settings, dropped, passes })
    }

    /// The rungs between which so many bits lie. Where a rung's cost has only been guessed, a sample of the frame tells it.
    fn find_rungs(
        &mut self,
        source: Source<'_>,
        budget: &Budget,
        wanted: f32,
        costs: &mut Costs,
    ) -> (usize, usize, Means) {
        let mut known = None;
        loop {
            let (finer, coarser, means) = costs.rungs(wanted);
            let Some(rung) = [coarser, finer].into_iter().find(|rung| !costs.found[*rung]) else {
                costs.rung = coarser;
                return (finer, coarser, means);
            };
            self.patterns.fill(Pattern(0));
            let mut bytes = |rung: usize| self.estimate(source, &mut settings_of(rung, budget)).max(1.0);
            let known = *known.get_or_insert_with(|| bytes(costs.rung));
            costs.find(rung, bytes(rung) / known);
        }
    }
}

impl RateState {
    fn of(&mut self, budget: &Budget) -> &mut Costs {
        if budget.latency_test { &mut self.plain } else { &mut self.coloured }
    }
}

impl Costs {
    /// The rungs between which so many bits lie, and how to meet them.
    fn rungs(&self, wanted: f32) -> (usize, usize, Means) {
        let full = self.plan.full();
        // The first that is not too dear for the whole frame.
        match (0..RUNGS).find(|rung| full * self.shares[*rung] <= wanted) {
            Some(rung) => self.mixed(rung.saturating_sub(1), rung, None),
            None => (RUNGS - 1, RUNGS - 1, Means::Thinned { share: self.shares[RUNGS - 1] }),
        }
    }

    /// The rungs at a place on the ladder: whole numbers are rungs, what is between them a split into both.
    fn rungs_at(&self, place: f32) -> (usize, usize, Means) {
        let rung = (place as usize).min(RUNGS - 2);
        self.mixed(rung, rung + 1, Some(1.0 + rung as f32 - place))
    }

    fn mixed(&self, finer: usize, coarser: usize, split: Option<f32>) -> (usize, usize, Means) {
        (finer, coarser, Means::Mixed { finer: self.shares[finer], coarser: self.shares[coarser], split })
    }

    /// A rung costs so many times what the last frame's coarser one does. Rungs beyond it that have not been found are dearer or
    /// cheaper in the same measure.
    fn find(&mut self, rung: usize, times: f32) {
        let share = self.shares[self.rung] * times;
        let ratio = share / self.shares[rung];
        let beyond = if rung < self.rung { 0..=rung } else { rung..=RUNGS - 1 };
        for other in beyond {
            if !self.found[other] {
                self.shares[other] *= ratio;
            }
        }
        (self.shares[rung], self.found[rung]) = (share, true);
    }

    /// Corrects what the rungs cost beside one another, by the tiles that changed theirs.
    fn learn(&mut self, finer: usize, coarser: usize) {
        let [to_finer, to_coarser] = self.plan.learn_shares();
        self.shares[finer] *= to_finer;
        self.shares[coarser] *= to_coarser;
    }
}

/// Of every rung.
fn first_shares(budget: &Budget) -> [f32; RUNGS] {
    core::array::from_fn(|rung| {
        let Rung { depth_level, share, .. } = LADDER[rung];
        let level = LEVELS[usize::from(depth_level)];
        match (budget.latency_test, budget.palette) {
            (true, _) => level,
            // Indices cost about as much as depth at level 3, at any rung.
            (false, true) => (1.0 + level) / 2.0,
            (false, false) => share,
        }
    })
}

fn settings_of(rung: usize, budget: &Budget) -> Settings {
    let Rung { depth_level, quality, full, .. } = LADDER[rung];
    let mode = match full {
        _ if budget.latency_test => ColourMode::None,
        _ if budget.palette => ColourMode::Palette,
        true => ColourMode::Full,
        false => ColourMode::Subsampled,
    };
    Settings { depth_level, quality, mode, ..Settings::default() }
}
