//! What a packet takes beside its symbols and raw bits, and what that leaves for them.

use crate::packet::{MAX_PACKET_BYTES, header_bytes};
use crate::tile::ColourMode;

/// What a packet's header, span (18 bits, mostly) and states cost, less what the states hold.
pub(crate) const fn overhead_bits(mode: ColourMode) -> f32 {
    (8 * header_bytes(mode) + 18) as f32 + STATES_BITS as f32
}

/// As a share of the rest of a full packet.
pub(crate) const fn overhead(mode: ColourMode) -> f32 {
    overhead_bits(mode) / (MAX_PACKET_BYTES as f32 * 8.0 - overhead_bits(mode))
}

/// What the states cost more than they hold.
const STATES_BITS: u32 = 76;

/// What the symbols and raw bits of a packet may cost, in 1/256 bit: all but its header, its span (35 bits), the states, and
/// the rest of a byte.
pub(crate) const fn cost_limit(mode: ColourMode) -> u32 {
    (8 * (MAX_PACKET_BYTES - header_bytes(mode)) as u32 - 35 - STATES_BITS - 8) * 256
}
