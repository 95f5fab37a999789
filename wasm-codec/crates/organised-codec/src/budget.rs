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
    /// Colours by the stream's palette.
    pub palette: bool,
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
