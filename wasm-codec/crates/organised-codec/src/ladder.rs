//! The ladder of settings, from the dearest to the cheapest.

use crate::budget::{Budget, BudgetColour};
use crate::frame::Settings;
use crate::tile::ColourMode;

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

/// Quality of coarse colours. What is coarser saves hardly a twentieth of a frame, and shows its blocks.
const COARSE: u8 = 28;

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
/// A rung for each depth level, down to a level at which depth would be too coarse without better colours beside it.
const COARSE_LADDER: [Rung; 8] = [
    rung(0, COARSE, false, 2.36),
    rung(1, COARSE, false, 1.75),
    rung(2, COARSE, false, 1.25),
    rung(3, COARSE, false, 1.0),
    rung(4, COARSE, false, 0.83),
    rung(5, COARSE, false, 0.6),
    rung(6, COARSE, false, 0.4),
    rung(7, COARSE, false, 0.28),
];
/// How many rungs a ladder has at most.
pub(crate) const MOST_RUNGS: usize = 26;
const RUNGS: usize = MOST_RUNGS;
/// What geometry costs by depth level, as a first guess.
const LEVELS: [f32; 7] = [2.36, 1.75, 1.25, 1.0, 0.83, 0.6, 0.395];

fn ladder(budget: &Budget) -> &'static [Rung] {
    match budget.colour {
        BudgetColour::Coarse if !budget.latency_test => &COARSE_LADDER,
        _ => &LADDER,
    }
}

/// How many rungs there are.
pub(crate) fn rungs(budget: &Budget) -> usize {
    ladder(budget).len()
}

/// The rung that a stream's first estimate is for: depth level 3.
pub(crate) fn first_rung(budget: &Budget) -> usize {
    match ladder(budget).len() {
        RUNGS => 16,
        _ => 3,
    }
}

/// Of every rung: what it costs as a share of the rung that the ladder is counted in, as a first guess.
pub(crate) fn first_shares(budget: &Budget) -> [f32; MOST_RUNGS] {
    let ladder = ladder(budget);
    core::array::from_fn(|rung| {
        let Some(Rung { depth_level, share, .. }) = ladder.get(rung) else { return 0.0 };
        let level = || LEVELS[usize::from(*depth_level)];
        match (budget.latency_test, budget.colour) {
            (true, _) => level(),
            // Indices cost about as much as depth at level 3, at any rung.
            (false, BudgetColour::Palette) => (1.0 + level()) / 2.0,
            (false, _) => *share,
        }
    })
}

/// The settings of a rung.
pub(crate) fn settings_of(rung: usize, budget: &Budget) -> Settings {
    let Rung { depth_level, quality, full, .. } = ladder(budget)[rung];
    let mode = match full {
        _ if budget.latency_test => ColourMode::None,
        _ if budget.colour == BudgetColour::Palette => ColourMode::Palette,
        true => ColourMode::Full,
        false => ColourMode::Subsampled,
    };
    Settings { depth_level, quality, mode, ..Settings::default() }
}
