//! The `points64` vectors that every implementation of the protocol is held to (packages/protocol/vectors).

use farpoint_point_codec::Point;
use farpoint_point_codec::points64::{
    BYTES_PER_POINT, MAX_BLOCK_BYTES, SlotLayout, colour_664, pack, quantise, saturates, unpack_block,
};
use serde::Deserialize;
use serde::de::DeserializeOwned;

#[derive(Deserialize)]
struct Points64 {
    quantise: Vec<Quantised>,
    blocks: Vec<Block>,
}

#[derive(Deserialize)]
struct Quantised {
    metres: f64,
    millimetres: i16,
    saturated: bool,
}

#[derive(Deserialize)]
struct Block {
    name: String,
    metres: Vec<[f64; 3]>,
    colours: Vec<u16>,
    saturated: usize,
    hex: String,
}

#[derive(Deserialize)]
struct Colours {
    pack: Vec<Packed>,
}

#[derive(Deserialize)]
struct Packed {
    rgb: [u8; 3],
    colour: u16,
}

fn vectors<T: DeserializeOwned>(name: &str) -> T {
    let path = format!("{}/../../../packages/protocol/vectors/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{path}: {error}"))
}

fn from_hex(hex: &str) -> Vec<u8> {
    (0..hex.len()).step_by(2).map(|at| u8::from_str_radix(&hex[at..at + 2], 16).unwrap()).collect()
}

/// The bytes R, G, B, A whose 6-6-4 colour is `colour`.
fn rgba_of(colour: u16) -> u32 {
    let [r, g, b] = [colour >> 10 << 2, (colour >> 4 & 63) << 2, (colour & 15) << 4];
    u32::from_le_bytes([r as u8, g as u8, b as u8, 255])
}

#[test]
fn coordinates_are_quantised_as_the_vectors_say() {
    let Points64 { quantise: cases, .. } = vectors("points64");
    assert!(!cases.is_empty());
    for Quantised { metres, millimetres, saturated } in cases {
        assert_eq!(quantise(metres as f32), millimetres, "{metres}");
        assert_eq!(saturates(metres as f32), saturated, "{metres}");
    }
}

#[test]
fn colours_are_packed_as_the_vectors_say() {
    let Colours { pack: cases } = vectors("colour664");
    assert!(!cases.is_empty());
    for Packed { rgb: [r, g, b], colour } in cases {
        assert_eq!(colour_664(u32::from_le_bytes([r, g, b, 255])), colour, "{r} {g} {b}");
    }
}

#[test]
fn blocks_are_packed_and_unpacked_as_the_vectors_say() {
    let Points64 { blocks, .. } = vectors("points64");
    assert!(!blocks.is_empty());
    let layout = SlotLayout::new(MAX_BLOCK_BYTES, 0).unwrap();
    for Block { name, metres, colours, saturated, hex } in blocks {
        let expected = from_hex(&hex);
        let colour = |i: usize| f32::from_bits(rgba_of(colours[i]));
        let frame: Vec<Point> = metres
            .iter()
            .enumerate()
            .map(|(i, p)| [p[0] as f32, p[1] as f32, p[2] as f32, colour(i)])
            .collect();
        let chosen: Vec<u32> = (0..frame.len() as u32).collect();
        let mut slot = vec![0; MAX_BLOCK_BYTES];
        let packed = pack(&frame, &chosen, layout, name.starts_with("latency test"), &mut slot);
        assert_eq!(packed.saturated, saturated, "{name}");
        assert_eq!(slot[..frame.len() * BYTES_PER_POINT], expected, "{name}");

        let mut points = vec![0; frame.len()];
        unpack_block(&expected, &mut points);
        for (i, point) in points.into_iter().enumerate() {
            let [x, y, z] =
                frame[i][..3].try_into().map(|c: [f32; 3]| c.map(|m| quantise(m) as u16)).unwrap();
            let got = [point as u16, (point >> 16) as u16, (point >> 32) as u16, (point >> 48) as u16];
            assert_eq!(got, [x, y, z, colours[i]], "{name}: point {i}");
        }
    }
}
