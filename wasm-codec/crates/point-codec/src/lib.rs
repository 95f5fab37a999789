//! Depth-weighted point sampling and the `points64` point layout, without I/O.
//!
//! A *frame* is a slice of [`Point`]s in the sensor's optical frame (REP-103: x right, y down, z forward), metres.
//! [`Sampler`] chooses which of them to send, [`points64`] turns the chosen ones into data blocks of packets and
//! back. Everything is deterministic, works in buffers made once, and gives the same bits natively and in WASM.
#![forbid(unsafe_code)]

mod depth_image;
pub mod exponential;
mod measure;
mod order;
pub mod points64;
mod sampler;
mod selection;
mod weight;

pub use depth_image::PixelGrid;
pub use measure::{DepthMeasure, MAX_COORDINATE, MIN_DEPTH, OutOfRange};
pub use order::near_first;
pub use sampler::{InvalidParameter, Rejected, SampleReport, Sampler, SamplingParameters};

/// x, y, z in metres and the colour, whose bit pattern is the bytes R, G, B, A (R lowest). Any of the coordinates may be
/// NaN, infinite, or zero or negative along the view: such points are counted and left out.
pub type Point = [f32; 4];
