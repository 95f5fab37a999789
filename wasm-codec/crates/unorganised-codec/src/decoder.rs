//! Packets, in any order, into points.

use crate::fault::Fault;
use crate::model::{Model, Port};
use crate::packet::Header;
use crate::quantise::{GridPoint, level_value};
use crate::rans::RansReader;
use crate::start::AttributeKind;
use crate::tables::{Table, all, base};

/// One packet's points in the decoder's memory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DecodedPacket {
    /// What is added to each of its points, metres.
    pub origin: [f32; 3],
    /// What its coordinates are multiplied with, metres.
    pub step: f32,
    /// Its first point.
    pub first: usize,
    /// How many points it has.
    pub count: usize,
    /// 0 nothing, 1 intensity, 2 colour.
    pub attribute: u8,
}

/// Decodes packets one after another into one block of memory.
pub struct Decoder {
    tables: Vec<Table>,
    capacity: usize,
    points: Vec<[i16; 4]>,
    packets: Vec<DecodedPacket>,
    colour_664: bool,
    palette: Box<[u16; 256]>,
}

impl Decoder {
    /// Room for `capacity` points.
    #[must_use]
    pub fn new(capacity: usize) -> Self {
        Self {
            tables: all(),
            capacity,
            points: Vec::with_capacity(capacity),
            packets: Vec::new(),
            colour_664: false,
            palette: Box::new(std::array::from_fn(|intensity| intensity as u16)),
        }
    }

    /// Gives colours as 6-6-4 bits from now on, as `points64` has them; else 5-6-5.
    pub fn set_colour_664(&mut self, colour_664: bool) {
        self.colour_664 = colour_664;
    }

    /// What an intensity of 0…255 becomes from now on: itself, or a colour of a scale.
    pub fn palette_mut(&mut self) -> &mut [u16; 256] {
        &mut self.palette
    }

    /// Forgets all points.
    pub fn clear(&mut self) {
        self.points.clear();
        self.packets.clear();
    }

    /// x, y, z in steps from the packet's origin, and the colour's or intensity's bits.
    #[must_use]
    pub fn points(&self) -> &[[i16; 4]] {
        &self.points
    }

    /// The packets decoded since [`Decoder::clear`].
    #[must_use]
    pub fn packets(&self) -> &[DecodedPacket] {
        &self.packets
    }

    /// Appends a packet's points.
    ///
    /// # Errors
    /// A packet that is faulty leaves nothing behind.
    pub fn decode(&mut self, packet: &[u8]) -> Result<DecodedPacket, Fault> {
        let first = self.points.len();
        let result = self.append(packet);
        if result.is_err() {
            self.points.truncate(first);
        }
        result
    }

    /// Writes the points of a decoded packet as metres.
    pub fn write_metres(&self, packet: &DecodedPacket, out: &mut [[f32; 3]]) {
        let [ox, oy, oz] = packet.origin;
        for (point, out) in self.points[packet.first..][..packet.count].iter().zip(out) {
            let [x, y, z] = [point[0], point[1], point[2]].map(|steps| f32::from(steps) * packet.step);
            *out = [ox + x, oy + y, oz + z];
        }
    }

    fn append(&mut self, packet: &[u8]) -> Result<DecodedPacket, Fault> {
        let (Header { start, step_mm, count, state }, words) = Header::read(packet)?;
        let first = self.points.len();
        if count > self.capacity - first {
            return Err(Fault::Full);
        }
        let reader = RansReader::new(state, words).ok_or(Fault::Data)?;
        let mut port = Read { tables: &self.tables, reader };
        let mut model = Model::new(start);
        let origin = start.first.at;
        // One table for the whole packet: what an attribute becomes.
        let intensities: [u16; 256] = match start.kind {
            AttributeKind::Intensity => std::array::from_fn(|level| {
                self.palette[level_value(level as u32, u32::from(start.top)).min(255) as usize]
            }),
            _ => [0; 256],
        };
        let colour_664 = self.colour_664;
        let output = |GridPoint { at, attribute }: GridPoint| {
            let colour = match start.kind {
                AttributeKind::None => 0,
                AttributeKind::Intensity => intensities[usize::from(attribute & 0xff)],
                AttributeKind::Colour if colour_664 => to_664(attribute),
                AttributeKind::Colour => attribute,
            };
            // The model has checked that the differences are of 16 bits.
            let near = |axis: usize| (at[axis] - origin[axis]) as i16;
            [near(0), near(1), near(2), colour.cast_signed()]
        };
        self.points.push(output(start.first));
        for _ in 1..count {
            let point = model.code(&mut port, GridPoint::default())?;
            self.points.push(output(point));
        }
        if !port.reader.is_finished() {
            return Err(Fault::Data);
        }
        let step = f64::from(step_mm) / 1000.0;
        let decoded = DecodedPacket {
            origin: origin.map(|coordinate| (f64::from(coordinate) * step) as f32),
            step: step as f32,
            first,
            count,
            attribute: match start.kind {
                AttributeKind::None => 0,
                AttributeKind::Intensity => 1,
                AttributeKind::Colour => 2,
            },
        };
        self.packets.push(decoded);
        Ok(decoded)
    }
}

/// 5-6-5 to 6-6-4 bits: red's highest bit again as its lowest, blue's lowest dropped.
const fn to_664(colour: u16) -> u16 {
    let red = colour >> 11;
    (red << 1 | red >> 4) << 10 | (colour >> 5 & 63) << 4 | (colour & 31) >> 1
}

struct Read<'a> {
    tables: &'a [Table],
    reader: RansReader<'a>,
}

impl Port for Read<'_> {
    type Error = Fault;

    #[inline]
    fn code(&mut self, table: usize, _: u32) -> Result<u32, Fault> {
        let table = &self.tables[table];
        let symbol = table.find(self.reader.slot());
        let start = table.starts[symbol];
        self.reader.take(start, table.starts[symbol + 1] - start).ok_or(Fault::Data)?;
        let (least, bits) = base(symbol as u32);
        if bits == 0 {
            return Ok(least);
        }
        Ok(least + self.reader.raw(bits).ok_or(Fault::Data)?)
    }

    fn impossible(&self) -> Fault {
        Fault::Data
    }
}
