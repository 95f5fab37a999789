//! Point clouds that lie on a camera's pixel grid, coded as depth and colour: a few bits a point, packets of at most 1200
//! bytes, each decodable alone and in any order. The format is specified in `docs/organised-codec.md`.
//!
//! Each module uses only modules below it. The encoder, from below: `tile_encoder` turns a tile's pixels into symbols,
//! `packet_writer` symbols into packets; `frame_encoder` passes over a frame; `sampling` chooses probability tables;
//! `rate` repeats passes until a frame fits its budget; `encoder` is what other crates see.
//!
//! Without I/O; works in buffers made once; packets decode to the same bits natively and in WASM.
#![deny(unsafe_code)]

mod budget;
mod content_check;
pub mod contexts;
pub mod crc16;
mod decoder;
mod emit;
mod encoder;
mod fill;
mod frame;
mod frame_encoder;
mod grid;
mod histogram;
mod ladder;
mod lanes;
pub mod load;
mod mend;
mod open_packet;
pub mod packet;
mod packet_cost;
mod packet_writer;
mod paint;
mod palette;
mod place_search;
mod plan;
mod prepare;
pub mod rans;
mod rate;
mod rung_costs;
mod sampling;
pub mod stream;
mod stream_palette;
mod surface;
mod surface_sample;
pub mod syntax;
pub mod tables;
mod thinning;
pub mod tile;
mod tile_encoder;
pub mod transform;
pub mod ycocg;

pub use budget::{Budget, BudgetColour, Spent};
pub use decoder::{Decoder, Put};
pub use encoder::Encoder;
pub use frame::{Frame, Packet, Settings};
pub use grid::{Intrinsics, Misfit, check_grid, estimate_intrinsics};
pub use histogram::Histogram;
pub use load::{Left, Source};
pub use packet::{PacketError, seal};
pub use stream::{HeaderError, StreamHeader};
pub use stream_palette::with_palette;
pub use surface_sample::TILE_SAMPLES;
pub use thinning::Validity;
pub use tile::ColourMode;

/// x, y, z in metres and the colour, whose bit pattern is the bytes R, G, B, A (R lowest).
pub type Point = [f32; 4];
