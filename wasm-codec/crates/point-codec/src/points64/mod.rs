//! `points64`: the mandatory point layout, 64 bits a point.
//!
//! A data block of n ≤ 150 points is n × (x, y, z as little-endian int16 millimetres) and then n × u16 of 6-6-4 colour. A
//! frame's blocks lie in *slots*: one every `stride` bytes, each beginning `data_offset` bytes into its slot, which leaves
//! room for a packet's header and trailer. The last block may be partial; it is packed by its own n.

mod blocks;
mod quantise;
mod slot_layout;

pub use blocks::{InvalidCount, Packed, pack, unpack, unpack_block};
pub use quantise::{colour_664, quantise, saturates};
pub use slot_layout::SlotLayout;

/// The points of a full packet.
pub const POINTS_PER_PACKET: usize = 150;
/// Three int16 coordinates and 16 bits of colour.
pub const BYTES_PER_POINT: usize = 8;
/// The bytes of a full data block.
pub const MAX_BLOCK_BYTES: usize = POINTS_PER_PACKET * BYTES_PER_POINT;
/// The colour of every point of a latency-test frame: pure green.
pub const LATENCY_TEST_COLOUR: u16 = 0x03f0;
