//! A frame in so many bytes: the mix of depth step, colour quality and thinning.

use crate::encoder::{Encoder, Frame, Settings};
use crate::load::Source;
use crate::stream::MAX_PACKET_BYTES;
use crate::thinning::{Validity, halvings, pattern};
use crate::tile::{ColourMode, Pattern};

/// What a budget buys, the dearest first: depth level, quality, chroma as fine as luma.
const LADDER: [(u8, u8, bool); 14] = [
    (2, 6, true),
    (3, 8, true),
    (3, 9, true),
    (3, 11, true),
    (3, 12, false),
    (3, 14, false),
    (3, 15, false),
    (3, 17, false),
    (3, 18, false),
    (4, 18, false),
    (4, 19, false),
    (4, 20, false),
    (5, 21, false),
    (5, 22, false),
];

/// Bits of a thinned tile by pattern, as a share of the full one's: a first guess, corrected by what frames cost.
const SHARES: [f32; Pattern::COUNT as usize] = [1.0, 0.66, 0.4, 0.25, 0.14, 0.08, 0.045, 0.025];
/// Passes over a frame at most.
const PASSES: usize = 4;

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
    rung: usize,
    /// What frames cost of what the model said.
    correction: f32,
    halvings: Vec<f32>,
}

impl RateState {
    pub fn halvings_buffer(&mut self) -> &mut Vec<f32> {
        &mut self.halvings
    }
}

/// What a budget was spent on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spent {
    /// The frame.
    pub frame: Frame,
    /// How it was coded.
    pub settings: Settings,
    /// Points in packets that were dropped because the budget was exceeded all the same.
    pub dropped: usize,
    /// Passes over the frame.
    pub passes: usize,
}

impl Encoder {
    /// Codes a frame in at most the budget's bytes and, where the frame has enough to tell, at least 95 % of them. `None` where the
    /// frame has not the header's number of pixels.
    pub fn encode_within(&mut self, source: Source<'_>, budget: &Budget) -> Option<Spent> {
        if source.len() != self.header().grid().width * self.header().grid().height {
            return None;
        }
        let grid = self.header().grid();
        let mut rate = core::mem::take(self.rate());
        if rate.correction == 0.0 {
            rate.correction = 1.0;
        }
        halvings(source, grid, &budget.validity, &mut rate.halvings);
        let last = LADDER.len() - 1;
        // The coarsest rung that would still spend the budget; what it is over is thinned away.
        self.patterns().fill(Pattern(0));
        let wanted = budget.bytes as f32 * 0.985;
        let mut rung = rate.rung;
        let mut settings = settings_of(rung, budget);
        let mut full = self.estimate(source, &mut settings) * rate.correction;
        let mut tried = 0;
        while tried < LADDER.len() {
            tried += 1;
            if full < wanted && rung > 0 {
                rung -= 1;
                settings = settings_of(rung, budget);
                full = self.estimate(source, &mut settings) * rate.correction;
                if full >= wanted {
                    break;
                }
            } else if full > wanted * 1.12 && rung < last {
                let mut coarser = settings_of(rung + 1, budget);
                let less = self.estimate(source, &mut coarser) * rate.correction;
                if less < wanted {
                    break;
                }
                (rung, settings, full) = (rung + 1, coarser, less);
            } else {
                break;
            }
        }
        let mut frame;
        let mut passes = 0;
        let mut wanted_by_model = wanted;
        loop {
            let shift = self.thin(&rate.halvings, full, wanted_by_model);
            frame = self.encode(source, &settings)?;
            passes += 1;
            let spent = frame.bytes as f32;
            if passes == 1 && shift.is_none() {
                rate.correction = (rate.correction * spent / full.max(1.0)).clamp(0.5, 2.0);
            }
            let fits = frame.bytes <= budget.bytes;
            if passes == PASSES || (fits && spent >= 0.955 * budget.bytes as f32) {
                break;
            }
            if fits && shift.is_none() {
                // Nothing was thinned: only a dearer rung spends more.
                if rung == 0 {
                    break;
                }
                rung -= 1;
                settings = settings_of(rung, budget);
                full = self.estimate(source, &mut settings) * rate.correction;
                wanted_by_model = wanted;
            } else if shift.is_some() {
                wanted_by_model *= (wanted / spent.max(1.0)).clamp(0.3, 3.0);
            } else {
                full = spent;
            }
        }
        rate.rung = rung;
        let dropped = self.drop_far(budget.bytes + MAX_PACKET_BYTES / 2, &mut frame);
        *self.rate() = rate;
        Some(Spent { frame, settings, dropped, passes })
    }

    /// Thins far tiles until the model says `wanted` bytes; the shift, or `None` where nothing had to be thinned.
    fn thin(&mut self, halvings: &[f32], full: f32, wanted: f32) -> Option<f32> {
        let tiles = halvings.len() as f32;
        let cost = |shift: f32| -> f32 {
            let sum: f32 = halvings
                .iter()
                .enumerate()
                .map(|(tile, halvings)| SHARES[usize::from(pattern(tile, *halvings, shift).0)])
                .sum();
            full * sum / tiles
        };
        if full <= wanted {
            self.patterns().fill(Pattern(0));
            return None;
        }
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
        Some(high)
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
