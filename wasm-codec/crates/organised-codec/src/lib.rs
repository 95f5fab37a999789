//! Point clouds that lie on a camera's pixel grid, coded as depth and colour: a few bits a point, packets of at most 1200
//! bytes, each decodable alone and in any order. The format is specified in `docs/organised-codec.md`.
//!
//! Without I/O; works in buffers made once; packets decode to the same bits natively and in WASM.
#![deny(unsafe_code)]

mod content_check;
pub mod contexts;
pub mod crc16;
mod decoder;
mod emit;
mod encoder;
mod frame;
mod grid;
mod lanes;
pub mod load;
mod open_packet;
pub mod packet;
mod paint;
mod palette;
mod place_search;
mod plan;
mod prepare;
pub mod rans;
mod rate;
mod sampling;
pub mod stream;
pub mod syntax;
pub mod tables;
mod thinning;
pub mod tile;
pub mod transform;
pub mod ycocg;

pub use decoder::{Decoder, Put};
pub use encoder::Encoder;
pub use frame::{Frame, Packet, Settings};
pub use grid::{Intrinsics, Misfit, check_grid, estimate_intrinsics};
pub use load::{Left, Source};
pub use packet::{PacketError, seal};
pub use palette::with_palette;
pub use rate::{Budget, Spent};
pub use sampling::Histogram;
pub use stream::{HeaderError, StreamHeader};
pub use thinning::Validity;
pub use tile::ColourMode;

/// x, y, z in metres and the colour, whose bit pattern is the bytes R, G, B, A (R lowest).
pub type Point = [f32; 4];
