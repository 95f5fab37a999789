//! Where the coding of a packet starts.

use crate::predictor::Mode;
use crate::quantise::GridPoint;

/// What is sent with each point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AttributeKind {
    /// Nothing.
    None,
    /// A level of intensity.
    Intensity,
    /// 5-6-5 bits of colour.
    Colour,
}

/// What a packet's first point and header fix.
#[derive(Clone, Copy)]
pub struct Start {
    /// The predictor.
    pub mode: Mode,
    /// What the attribute is.
    pub kind: AttributeKind,
    /// Highest intensity level.
    pub top: u8,
    /// The packet's first point.
    pub first: GridPoint,
}
