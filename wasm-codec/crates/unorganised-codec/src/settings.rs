//! How a frame is encoded, and what became of it.

use crate::Point;
use crate::order::Order;
use crate::packet::{MAX_PACKET_BYTES, MIN_PACKET_BYTES};
use crate::quantise::{Attribute, Rejected};

/// How a frame is encoded.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// Grid step, 1 to 100 mm; a coordinate is wrong by half of it at most.
    pub step_mm: u8,
    /// What the fourth word holds.
    pub attribute: Attribute,
    /// The order of the points.
    pub order: Order,
    /// 128 to 1200.
    pub max_packet_bytes: usize,
    /// Points are left out until all packets together have no more bytes.
    pub budget_bytes: Option<usize>,
    /// How fast the share of kept points falls with range where there is a budget; 0 is even. 0 to 8.
    pub lambda: f32,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            step_mm: 10,
            attribute: Attribute::Colour,
            order: Order::Auto,
            max_packet_bytes: MAX_PACKET_BYTES,
            budget_bytes: None,
            lambda: 0.0,
        }
    }
}

/// A setting outside its range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InvalidSettings {
    /// Not 1 to 100 mm.
    Step,
    /// Not 128 to 1200 bytes.
    PacketBytes,
    /// Not 0 to 8.
    Lambda,
    /// More than 2²⁴ points.
    TooManyPoints,
}

/// What became of a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EncodeReport {
    /// Points in the packets.
    pub kept: usize,
    /// Points left out for the budget.
    pub thinned: usize,
    /// Points that cannot be sent.
    pub rejected: Rejected,
    /// Packets.
    pub packets: usize,
    /// Bytes of all packets together.
    pub bytes: usize,
}

/// Far above any sensor's frame.
const MAX_POINTS: usize = 1 << 24;

pub(crate) fn check(frame: &[Point], settings: &Settings) -> Result<(), InvalidSettings> {
    if !(1..=100).contains(&settings.step_mm) {
        return Err(InvalidSettings::Step);
    }
    if !(MIN_PACKET_BYTES..=MAX_PACKET_BYTES).contains(&settings.max_packet_bytes) {
        return Err(InvalidSettings::PacketBytes);
    }
    if !(0.0..=8.0).contains(&settings.lambda) {
        return Err(InvalidSettings::Lambda);
    }
    if frame.len() > MAX_POINTS {
        return Err(InvalidSettings::TooManyPoints);
    }
    Ok(())
}
