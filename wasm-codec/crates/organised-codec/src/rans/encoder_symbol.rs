//! A symbol as the encoder needs it.

use super::{LOW_BITS, PROBABILITY_BITS, TOTAL};

/// What coding a symbol takes: a reciprocal in place of the division.
#[derive(Clone, Copy, Debug, Default)]
pub struct EncoderSymbol {
    /// 2⁴⁰ / frequency, rounded up: exact for states below frequency · 2²².
    pub(super) reciprocal: u64,
    /// The state from which on a word must go first.
    pub(super) limit: u32,
    pub(super) start: u16,
    /// [`TOTAL`] − frequency.
    pub(super) rest: u16,
}

pub(super) const RECIPROCAL_BITS: u32 = 40;

impl EncoderSymbol {
    /// For a symbol whose share of [`TOTAL`] begins at `start`.
    #[must_use]
    pub fn new(start: u32, frequency: u32) -> Self {
        Self {
            reciprocal: (1u64 << RECIPROCAL_BITS).div_ceil(u64::from(frequency)),
            limit: frequency << (16 + LOW_BITS - PROBABILITY_BITS),
            start: start as u16,
            rest: TOTAL - frequency as u16,
        }
    }
}
