//! A frame in so many bytes: the mix of depth step, colour quality and thinning.
//!
//! What a frame costs at each rung of a ladder is estimated from an eighth of its tiles, and corrected by what the frames
//! before cost. Between two rungs the nearer tiles get the finer one, so that the budget is met without leaving a point out;
//! only below the last rung far tiles are thinned. A steady stream takes one pass a frame.

use crate::encoder::{Encoder, Frame, Mix, Settings};
use crate::load::Source;
use crate::stream::MAX_PACKET_BYTES;
use crate::thinning::{Validity, halvings, pattern, tile_depths};
use crate::tile::{ColourMode, Pattern};

/// What a budget buys, the dearest first: depth level, quality, chroma as fine as luma.
const LADDER: [(u8, u8, bool); 26] = [
    (0, 2, true),
    (1, 4, true),
    (2, 6, true),
    (2, 7, true),
    (3, 7, true),
    (3, 8, true),
    (3, 9, true),
    (3, 10, true),
    (3, 11, true),
    (3, 11, false),
    (3, 12, false),
    (3, 13, false),
    (3, 14, false),
    (3, 15, false),
    (3, 16, false),
    (3, 17, false),
    (3, 18, false),
    (4, 18, false),
    (4, 19, false),
    (4, 20, false),
    (5, 20, false),
    (5, 21, false),
    (5, 22, false),
    (5, 24, false),
    (6, 25, false),
    (6, 26, false),
];
/// The rung that a stream begins with.
const FIRST_RUNG: usize = 16;

/// Bits of a thinned tile by pattern, as a share of the full one's: a first guess, corrected by what frames cost.
const SHARES: [f32; Pattern::COUNT as usize] = [1.0, 0.66, 0.4, 0.25, 0.14, 0.08, 0.045, 0.025];
/// Passes over a frame at most.
const PASSES: usize = 4;
/// What is aimed at, and what is accepted, as shares of the budget.
const AIM: f32 = 0.985;
const LEAST: f32 = 0.955;
/// After so many frames a rung's cost is estimated anew.
const KEEP_FRAMES: u32 = 60;

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
    depths: Vec<f32>,
    sorted: Vec<f32>,
    halvings: Vec<f32>,
    frame: u32,
}

/// What frames of one kind cost at each rung.
#[derive(Default)]
struct Costs {
    rungs: [Option<Rung>; LADDER.len()],
    rung: Option<usize>,
    /// What frames cost of what the estimates said, whole and thinned.
    whole: f32,
    thinned: f32,
}

#[derive(Clone, Copy)]
struct Rung {
    settings: Settings,
    bytes: f32,
    /// When it was estimated.
    frame: u32,
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

/// How a pass is coded, and what it should cost uncorrected.
struct Plan {
    mix: Mix,
    /// Share of the tiles that the finer settings are for.
    finer: f32,
    thinned: bool,
    bytes: f32,
}

impl Encoder {
    /// Codes a frame in at most a packet more than the budget's bytes and, where the frame has enough to tell, in at least
    /// 95 % of them. `None` where the frame has not the header's number of pixels.
    pub fn encode_within(&mut self, source: Source<'_>, budget: &Budget) -> Option<Spent> {
        let grid = self.header().grid();
        if source.len() != grid.width * grid.height {
            return None;
        }
        let mut rate = core::mem::take(self.rate());
        rate.frame = rate.frame.wrapping_add(1);
        tile_depths(source, grid, &mut rate.depths);
        rate.sorted.clone_from(&rate.depths);
        rate.sorted.sort_unstable_by(f32::total_cmp);
        rate.halvings.clone_from(&rate.depths);
        halvings(&budget.validity, &mut rate.halvings);
        let mut costs =
            core::mem::take(if budget.latency_test { &mut rate.plain } else { &mut rate.coloured });
        if costs.rung.is_none() {
            (costs.whole, costs.thinned) = (1.0, 1.0);
        }
        let wanted = budget.bytes as f32 * AIM;
        let mut passes = 0;
        let (frame, plan) = loop {
            let plan = self.plan(source, budget, wanted, &mut costs, &rate);
            let Some(frame) = self.encode_mixed(source, &plan.mix) else { break (Frame::default(), plan) };
            passes += 1;
            let spent = frame.bytes as f32;
            let correction = if plan.thinned { &mut costs.thinned } else { &mut costs.whole };
            *correction = (*correction * spent / plan.bytes.max(1.0)).clamp(0.2, 5.0);
            // The dearest rung for the whole frame: it has no more to tell.
            let all = costs.rung == Some(0) && plan.finer >= 1.0 && !plan.thinned;
            let fits = frame.bytes <= budget.bytes + MAX_PACKET_BYTES / 2;
            if passes == PASSES || (fits && (all || spent >= LEAST * budget.bytes as f32)) {
                break (frame, plan);
            }
        };
        let mut frame = frame;
        *(if budget.latency_test { &mut rate.plain } else { &mut rate.coloured }) = costs;
        *self.rate() = rate;
        let dropped = self.drop_far(budget.bytes + MAX_PACKET_BYTES / 2, &mut frame);
        let settings = if plan.finer >= 0.5 { plan.mix.finer } else { plan.mix.coarser };
        Some(Spent { frame, settings, dropped, passes })
    }

    /// Finds the rungs between which `wanted` bytes lie, and tells the tiles their patterns and rungs.
    fn plan(
        &mut self,
        source: Source<'_>,
        budget: &Budget,
        wanted: f32,
        costs: &mut Costs,
        rate: &RateState,
    ) -> Plan {
        self.patterns().fill(Pattern(0));
        self.finer_tiles().clear();
        let mut rung = costs.rung.unwrap_or(FIRST_RUNG);
        let mut upper = self.cost(source, budget, rung, costs, rate.frame);
        // Up to the first that is too dear for the whole frame, down to the last that is not: `upper` over `wanted`.
        while rung > 0 && upper.bytes * costs.whole < wanted {
            rung -= 1;
            upper = self.cost(source, budget, rung, costs, rate.frame);
        }
        let mut lower = upper;
        while upper.bytes * costs.whole >= wanted && rung + 1 < LADDER.len() {
            lower = self.cost(source, budget, rung + 1, costs, rate.frame);
            if lower.bytes * costs.whole < wanted {
                break;
            }
            (rung, upper) = (rung + 1, lower);
        }
        costs.rung = Some(rung);
        let (finer_bytes, coarser_bytes) = (upper.bytes * costs.whole, lower.bytes * costs.whole);
        let mix = Mix { finer: upper.settings, coarser: lower.settings };
        if finer_bytes <= wanted {
            return Plan { mix, finer: 1.0, thinned: false, bytes: finer_bytes };
        }
        if coarser_bytes < wanted {
            let finer = (wanted - coarser_bytes) / (finer_bytes - coarser_bytes).max(1.0);
            let nearest = ((rate.sorted.len() as f32 * finer) as usize).min(rate.sorted.len() - 1);
            let limit = rate.sorted[nearest];
            self.finer_tiles().extend(rate.depths.iter().map(|depth| *depth < limit));
            return Plan { mix, finer, thinned: false, bytes: wanted };
        }
        let modelled = self.thin(&rate.halvings, finer_bytes * costs.thinned, wanted);
        Plan { mix, finer: 1.0, thinned: true, bytes: modelled }
    }

    /// What the frame costs whole at a rung, uncorrected.
    fn cost(
        &mut self,
        source: Source<'_>,
        budget: &Budget,
        rung: usize,
        costs: &mut Costs,
        frame: u32,
    ) -> Rung {
        if let Some(known) = costs.rungs[rung]
            && frame.wrapping_sub(known.frame) < KEEP_FRAMES
        {
            return known;
        }
        let mut settings = settings_of(rung, budget);
        let bytes = self.estimate(source, &mut settings);
        let known = Rung { settings, bytes, frame };
        costs.rungs[rung] = Some(known);
        known
    }

    /// Thins far tiles until the model says `wanted` of `full` bytes; what it says then.
    fn thin(&mut self, halvings: &[f32], full: f32, wanted: f32) -> f32 {
        let tiles = halvings.len() as f32;
        let cost = |shift: f32| -> f32 {
            let sum: f32 = halvings
                .iter()
                .enumerate()
                .map(|(tile, halvings)| SHARES[usize::from(pattern(tile, *halvings, shift).0)])
                .sum();
            full * sum / tiles
        };
        // From nothing thinned to nothing but corners left.
        let deepest = halvings.iter().fold(0.0_f32, |most, halvings| most.max(*halvings));
        let (mut low, mut high) = (-deepest - 1.0, 8.0);
        for _ in 0..18 {
            let middle = (low + high) / 2.0;
            if cost(middle) > wanted {
                low = middle;
            } else {
                high = middle;
            }
        }
        for (tile, (own, halvings)) in self.patterns().iter_mut().zip(halvings).enumerate() {
            *own = pattern(tile, *halvings, high);
        }
        cost(high)
    }
}

fn settings_of(rung: usize, budget: &Budget) -> Settings {
    let (depth_level, quality, full) = LADDER[rung];
    let mode = match full {
        _ if budget.latency_test => ColourMode::None,
        _ if budget.palette => ColourMode::Palette,
        true => ColourMode::Full,
        false => ColourMode::Subsampled,
    };
    Settings { depth_level, quality, mode, ..Settings::default() }
}
