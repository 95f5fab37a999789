//! Bindings of the organised decoder.

use farpoint_organised_codec::packet::MAX_PACKET_BYTES;
use farpoint_organised_codec::{Decoder, HeaderError, PacketError, StreamHeader};
use wasm_bindgen::prelude::*;

/// Packets of one stream into points.
#[wasm_bindgen]
pub struct OrganisedDecoder {
    decoder: Decoder,
    packet: Box<[u8; MAX_PACKET_BYTES + 1]>,
    latency_test: bool,
}

#[wasm_bindgen]
impl OrganisedDecoder {
    /// For the stream of a header; with `images`, depth and colour images too. Check the header before: `undefined` tells
    /// nothing.
    pub fn create(header: &[u8], images: bool) -> Option<OrganisedDecoder> {
        let decoder = Decoder::new(StreamHeader::parse(header).ok()?, images)?;
        Some(Self { decoder, packet: Box::new([0; MAX_PACKET_BYTES + 1]), latency_test: false })
    }

    /// 0, or what is wrong with a header: 1 length, 2 magic, 3 version, 4 check value, 5 a value.
    pub fn fault_of(header: &[u8]) -> u32 {
        match StreamHeader::parse(header) {
            Ok(_) => 0,
            Err(HeaderError::Length) => 1,
            Err(HeaderError::Magic) => 2,
            Err(HeaderError::Version) => 3,
            Err(HeaderError::Check) => 4,
            Err(HeaderError::Value) => 5,
        }
    }

    /// Where to write a packet: 1201 bytes.
    pub fn packet_ptr(&self) -> *const u8 {
        self.packet.as_ptr()
    }

    /// Points of the frame, 8 bytes each.
    pub fn points_ptr(&self) -> *const u64 {
        self.decoder.point_buffer().as_ptr()
    }

    /// Depth in metres, a float a pixel.
    pub fn depth_ptr(&self) -> *const f32 {
        self.decoder.depth().as_ptr()
    }

    /// Colour, 4 bytes a pixel.
    pub fn colour_ptr(&self) -> *const u32 {
        self.decoder.colour().as_ptr()
    }

    /// Image width, pixels.
    pub fn width(&self) -> usize {
        self.decoder.header().width.into()
    }

    /// Image height, pixels.
    pub fn height(&self) -> usize {
        self.decoder.header().height.into()
    }

    /// Begins a frame.
    pub fn begin(&mut self) {
        self.decoder.begin();
        self.latency_test = false;
    }

    /// True where a packet of the frame was one of a latency test.
    pub fn latency_test(&self) -> bool {
        self.latency_test
    }

    /// Points of the frame so far.
    pub fn count(&self) -> usize {
        self.decoder.points().len()
    }

    /// Decodes the first `length` bytes at `packet_ptr`: the number of points, or −1 too short, −2 too long, −3 check value,
    /// −4 reserved, −5 unknown stream, −6 tiles, −7 duplicate, −8 corrupt.
    pub fn put(&mut self, length: usize) -> i32 {
        let packet = &self.packet[..length.min(MAX_PACKET_BYTES + 1)];
        match self.decoder.put(packet) {
            Ok(put) => {
                self.latency_test |= put.latency_test;
                put.points as i32
            }
            Err(PacketError::TooShort) => -1,
            Err(PacketError::TooLong) => -2,
            Err(PacketError::Check) => -3,
            Err(PacketError::Reserved) => -4,
            Err(PacketError::UnknownStream) => -5,
            Err(PacketError::Tiles) => -6,
            Err(PacketError::Duplicate) => -7,
            Err(PacketError::Corrupt) => -8,
        }
    }
}
