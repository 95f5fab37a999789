//! What a frame may take, and what became of that.

use crate::frame::{Frame, Settings};
use crate::thinning::Validity;

/// A limit for a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Budget {
    /// Bytes of all packets.
    pub bytes: usize,
    /// Which tiles are thinned first.
    pub validity: Validity,
    /// All points pure green.
    pub latency_test: bool,
    /// How colours are coded.
    pub colour: BudgetColour,
}

/// How a frame within a budget is coloured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BudgetColour {
    /// As fine as suits the depth level that the budget pays for.
    #[default]
    Suited,
    /// Coarse at every depth level: for receivers that have better colours from elsewhere, e.g. a video. The depth gets the
    /// rest.
    Coarse,
    /// By the stream's palette.
    Palette,
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
