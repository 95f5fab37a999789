//! Bindings of the `unorganised` format. As for `points64`, buffers lie in the module's memory and calls pass numbers only.

use farpoint_unorganised_codec::{
    Attribute, Decoder, EncodeReport, Encoder, Fault, InvalidSettings, MAX_PACKET_BYTES, Order, Point,
    Settings,
};
use wasm_bindgen::prelude::*;

/// A frame and the packets it was encoded into.
#[wasm_bindgen]
pub struct UnorganisedEncoder {
    frame: Vec<Point>,
    encoder: Encoder,
    extents: Vec<u32>,
    report: Box<[u32; 6]>,
}

#[wasm_bindgen]
impl UnorganisedEncoder {
    /// Room for frames of `capacity` points.
    pub fn create(capacity: usize) -> UnorganisedEncoder {
        Self {
            frame: vec![[0.0; 4]; capacity],
            encoder: Encoder::new(),
            extents: Vec::new(),
            report: Box::default(),
        }
    }

    /// 4 words a point.
    pub fn frame_ptr(&self) -> *const f32 {
        self.frame.as_ptr().cast()
    }

    /// The memory in which the last frame's packets lie.
    pub fn bytes_ptr(&self) -> *const u8 {
        self.encoder.bytes().as_ptr()
    }

    /// How much of it there is.
    pub fn bytes_length(&self) -> usize {
        self.encoder.bytes().len()
    }

    /// Offset, length and points of each packet, nearest first.
    pub fn extents_ptr(&self) -> *const u32 {
        self.extents.as_ptr()
    }

    /// Kept, thinned, not finite, out of range, packets, bytes.
    pub fn report_ptr(&self) -> *const u32 {
        self.report.as_ptr()
    }

    /// `attribute`: 0 none, 1 colour, 2 intensity of 8 bits, 3 of 16. `order`: 0 auto, 1 as given, 2 sweep, 3 Morton. A
    /// budget of 0 is none. Gives 0, or what was wrong: 1 step, 2 packet bytes, 3 lambda, 4 more points than the capacity.
    #[allow(
        clippy::too_many_arguments,
        reason = "numbers cross this border without an allocation, objects do not"
    )]
    pub fn encode(
        &mut self,
        points: usize,
        step_mm: u32,
        attribute: u32,
        order: u32,
        max_packet_bytes: usize,
        budget_bytes: usize,
        lambda: f32,
    ) -> u32 {
        let Some(frame) = self.frame.get(..points) else { return 4 };
        let settings = Settings {
            step_mm: u8::try_from(step_mm).unwrap_or(0),
            attribute: match attribute {
                1 => Attribute::Colour,
                2 => Attribute::Intensity8,
                3 => Attribute::Intensity16,
                _ => Attribute::None,
            },
            order: match order {
                1 => Order::AsGiven,
                2 => Order::Sweep,
                3 => Order::Morton,
                _ => Order::Auto,
            },
            max_packet_bytes,
            budget_bytes: (budget_bytes > 0).then_some(budget_bytes),
            lambda,
        };
        let report = match self.encoder.encode(frame, &settings) {
            Ok(report) => report,
            Err(InvalidSettings::Step) => return 1,
            Err(InvalidSettings::PacketBytes) => return 2,
            Err(InvalidSettings::Lambda) => return 3,
            Err(InvalidSettings::TooManyPoints) => return 4,
        };
        let EncodeReport { kept, thinned, rejected, packets, bytes } = report;
        let counts = [kept, thinned, rejected.not_finite, rejected.out_of_range, packets, bytes];
        *self.report = counts.map(|count| count as u32);
        self.extents.clear();
        self.extents.extend(self.encoder.extents().flatten().map(|number| number as u32));
        0
    }
}

/// One packet and the points of all that were decoded since the last `clear`.
#[wasm_bindgen]
pub struct UnorganisedDecoder {
    packet: Box<[u8; MAX_PACKET_BYTES]>,
    decoder: Decoder,
    metres: Vec<[f32; 3]>,
    /// Origin and step of each packet, metres.
    places: Vec<[f32; 4]>,
    /// First point, count and attribute of each packet.
    extents: Vec<[u32; 3]>,
}

#[wasm_bindgen]
impl UnorganisedDecoder {
    /// Room for `capacity` points.
    pub fn create(capacity: usize) -> UnorganisedDecoder {
        Self {
            packet: Box::new([0; MAX_PACKET_BYTES]),
            decoder: Decoder::new(capacity),
            metres: Vec::new(),
            places: Vec::new(),
            extents: Vec::new(),
        }
    }

    /// Where the next packet is to be written, 1200 bytes.
    pub fn packet_ptr(&self) -> *const u8 {
        self.packet.as_ptr()
    }

    /// 256 words: what an intensity becomes.
    pub fn palette_ptr(&mut self) -> *const u16 {
        self.decoder.palette_mut().as_ptr()
    }

    /// The decoded points, four int16 each.
    pub fn points_ptr(&self) -> *const i16 {
        self.decoder.points().as_ptr().cast()
    }

    /// How many points there are.
    pub fn points_length(&self) -> usize {
        self.decoder.points().len()
    }

    /// How many packets there are.
    pub fn packets_length(&self) -> usize {
        self.extents.len()
    }

    /// Four floats a packet: origin and step, metres.
    pub fn places_ptr(&self) -> *const f32 {
        self.places.as_ptr().cast()
    }

    /// Three words a packet: first point, count, attribute.
    pub fn extents_ptr(&self) -> *const u32 {
        self.extents.as_ptr().cast()
    }

    /// Colours as 6-6-4 bits from now on, else 5-6-5.
    pub fn set_colour_664(&mut self, colour_664: bool) {
        self.decoder.set_colour_664(colour_664);
    }

    /// Forgets all points.
    pub fn clear(&mut self) {
        self.decoder.clear();
        self.places.clear();
        self.extents.clear();
    }

    /// Decodes the first `length` bytes of the packet's memory: the number of points, or minus what was wrong: 1 too
    /// short, 2 too long, 3 check value, 4 version, 5 header, 6 data, 7 no room.
    pub fn decode(&mut self, length: usize) -> i32 {
        let Some(packet) = self.packet.get(..length) else { return -2 };
        match self.decoder.decode(packet) {
            Ok(decoded) => {
                let [x, y, z] = decoded.origin;
                self.places.push([x, y, z, decoded.step]);
                self.extents.push([decoded.first as u32, decoded.count as u32, u32::from(decoded.attribute)]);
                decoded.count as i32
            }
            Err(Fault::TooShort) => -1,
            Err(Fault::TooLong) => -2,
            Err(Fault::Check) => -3,
            Err(Fault::Version) => -4,
            Err(Fault::Header) => -5,
            Err(Fault::Data) => -6,
            Err(Fault::Full) => -7,
        }
    }

    /// Writes all points as metres, three floats each, and says where.
    pub fn metres_ptr(&mut self) -> *const f32 {
        self.metres.resize(self.decoder.points().len(), [0.0; 3]);
        for packet in self.decoder.packets() {
            self.decoder.write_metres(packet, &mut self.metres[packet.first..][..packet.count]);
        }
        self.metres.as_ptr().cast()
    }
}
