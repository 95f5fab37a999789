//! Bindings of the organised decoder.

use farpoint_organised_codec::packet::MAX_PACKET_BYTES;
use farpoint_organised_codec::{Decoder, HeaderError, PacketError, Put, StreamHeader};
use wasm_bindgen::prelude::*;

/// Packets of one stream into points.
#[wasm_bindgen]
pub struct OrganisedDecoder {
    decoder: Decoder,
    packets: Box<[[u8; PACKET_ROOM]; 2]>,
    second: i32,
    latency_test: bool,
    /// First tile and number of tiles of each of the packets put last.
    tiles: [u32; 4],
}

/// One more than a packet may have: so one that is too long is told.
const PACKET_ROOM: usize = MAX_PACKET_BYTES + 1;

#[wasm_bindgen]
impl OrganisedDecoder {
    /// For the stream of a header; with `images`, depth and colour images too. Check the header before: `undefined` tells
    /// nothing.
    pub fn create(header: &[u8], images: bool) -> Option<OrganisedDecoder> {
        let decoder = Decoder::new(StreamHeader::parse(header).ok()?, images)?;
        Some(Self {
            decoder,
            packets: Box::new([[0; PACKET_ROOM]; 2]),
            second: 0,
            latency_test: false,
            tiles: [0; 4],
        })
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

    /// Where to write packets: twice 1201 bytes.
    pub fn packets_ptr(&self) -> *const u8 {
        self.packets.as_ptr().cast()
    }

    /// Points of the frame, 8 bytes each.
    pub fn points_ptr(&self) -> *const u64 {
        self.decoder.point_buffer().as_ptr()
    }

    /// Whether frames that begin from now on are surfaces.
    pub fn want_surface(&mut self, wanted: bool) {
        self.decoder.want_surface(wanted);
    }

    /// Samples of a surface, 4 bytes each, 256 for each tile of the image.
    pub fn samples_ptr(&self) -> *const u32 {
        self.decoder.samples().as_ptr()
    }

    /// How many samples there are: 0 where the frame is no surface.
    pub fn sample_count(&self) -> usize {
        self.decoder.samples().len()
    }

    /// Where the first tile and the number of tiles stand, of each of the packets put last.
    pub fn tiles_ptr(&self) -> *const u32 {
        self.tiles.as_ptr()
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

    /// Decodes the first packet: the number of points, or −1 too short, −2 too long, −3 check value, −4 reserved, −5 unknown
    /// stream, −6 tiles, −7 duplicate, −8 corrupt.
    pub fn put(&mut self, length: usize) -> i32 {
        let put = self.decoder.put(&self.packets[0][..length.min(PACKET_ROOM)]);
        self.tell(0, put)
    }

    /// Decodes both packets. As [`OrganisedDecoder::put`] of the first; of the second [`OrganisedDecoder::second`] tells.
    pub fn put_two(&mut self, length: usize, second_length: usize) -> i32 {
        let [packet, second] = self.packets.each_ref();
        let packets = [&packet[..length.min(PACKET_ROOM)], &second[..second_length.min(PACKET_ROOM)]];
        let [put, second] = self.decoder.put_two(packets);
        self.second = self.tell(1, second);
        self.tell(0, put)
    }

    /// See [`OrganisedDecoder::put_two`].
    pub fn second(&self) -> i32 {
        self.second
    }
}

impl OrganisedDecoder {
    fn tell(&mut self, packet: usize, put: Result<Put, PacketError>) -> i32 {
        match put {
            Ok(put) => {
                self.tiles[2 * packet..][..2].copy_from_slice(&[put.first_tile as u32, put.tiles as u32]);
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
