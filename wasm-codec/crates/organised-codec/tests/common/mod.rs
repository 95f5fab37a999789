//! What the tests share: frames (a floor, a ball and noise, seen by a camera), and their packets.
#![allow(dead_code, reason = "each test uses a part of it")]

use farpoint_organised_codec::{Decoder, Encoder, Intrinsics, Point, StreamHeader, stream};

pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as u32
    }

    pub fn uniform(&mut self) -> f32 {
        self.next() as f32 / (1u32 << 31) as f32
    }
}

pub fn header(width: u16, height: u16) -> StreamHeader {
    let focal = f32::from(width.max(height)) * 0.6 + 8.0;
    StreamHeader {
        id: 9,
        width,
        height,
        intrinsics: Intrinsics {
            fx: focal,
            fy: focal * 1.01,
            cx: f32::from(width) / 2.0 - 0.5,
            cy: f32::from(height) / 2.0 - 0.25,
        },
        depth_unit: stream::DEPTH_UNIT,
        palette: Vec::new(),
        index_frequencies: Vec::new(),
    }
}

/// `holes`: share of pixels without depth; `noise`: of inverse depth, 1/m; `grey`: colours from 64 greys.
pub fn frame(header: &StreamHeader, seed: u64, holes: f32, noise: f32, grey: bool) -> Vec<Point> {
    let mut random = Random(seed);
    let (width, height) = (usize::from(header.width), usize::from(header.height));
    let columns: Vec<f32> = header.intrinsics.columns(width).collect();
    let rows: Vec<f32> = header.intrinsics.rows(height).collect();
    let invalid = [f32::NAN, f32::INFINITY, 0.0, -1.0];
    (0..width * height)
        .map(|i| {
            let (x, y) = (columns[i % width], rows[i / width]);
            let ball = x * x + y * y < 0.06;
            let inverse = if ball { 0.9 - x * x } else { 0.25 + 0.3 * (y + 0.9).max(0.0) };
            let mut z = 1.0 / (inverse + noise * (random.uniform() - 0.5));
            if random.uniform() < holes {
                z = invalid[random.next() as usize % 4];
            }
            let level = ((x * 9.0).sin() * 60.0 + 120.0 + random.uniform() * 12.0) as u32;
            let rgba = if grey {
                ((level & 0xfc) * 0x01_0101) | 0xff00_0000
            } else {
                level | (level / 2 + 40) << 8 | (200 - level / 2) << 16 | 0xff00_0000
            };
            [x * z, y * z, z, f32::from_bits(rgba)]
        })
        .collect()
}

/// Whether a point can be sent.
pub fn valid(point: &Point) -> bool {
    let [x, y, z, _] = *point;
    z > 0.0 && z.is_finite() && x.abs() <= 32.767 && y.abs() <= 32.767 && z <= 32.767
}

/// The packets of the last frame.
pub fn packets(encoder: &Encoder) -> Vec<Vec<u8>> {
    (0..encoder.packets().len()).map(|index| encoder.packet(index).to_vec()).collect()
}

/// A decoder that has taken all packets.
pub fn decode(header: &StreamHeader, packets: &[Vec<u8>]) -> Decoder {
    let mut decoder = Decoder::new(header.clone(), true).expect("a stream");
    for packet in packets {
        decoder.put(packet).expect("a packet");
    }
    decoder
}
