//! `unorganised`: a point format for clouds without a grid (LiDAR sweeps, merged clouds), some 13 bits a point.
//!
//! Points are rounded to a grid, put into an order in which each lies near the one before it, predicted from that one and
//! coded with static tables. Every packet is decodable alone. `docs/unorganised-codec.md` describes the bytes.

#![forbid(unsafe_code)]

mod contexts;
mod crc32;
mod decoder;
mod encoder;
mod fault;
mod model;
mod order;
mod packet;
mod packing;
mod ports;
mod predictor;
mod quantise;
mod rans;
mod settings;
mod start;
mod tables;
mod tables_data;
mod thinning;

pub use contexts::{SYMBOLS, TABLE_COUNT};
pub use decoder::{DecodedPacket, Decoder};
pub use encoder::Encoder;
pub use fault::Fault;
pub use order::Order;
pub use packet::{MAX_PACKET_BYTES, MAX_POINTS_PER_PACKET, MIN_PACKET_BYTES, seal};
pub use quantise::{Attribute, MAX_RANGE_M, Rejected};
pub use settings::{EncodeReport, InvalidSettings, Settings};
pub use tables::normalise;

/// x, y, z in metres and the word that holds the colour (R, G, B, A from the lowest byte) or the intensity.
pub type Point = [f32; 4];
