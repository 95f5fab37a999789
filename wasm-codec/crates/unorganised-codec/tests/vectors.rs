//! The conformance vectors: packets and the points that every decoder must make of them. `WRITE_VECTORS=1` writes them anew.

use std::path::Path;

use farpoint_unorganised_codec::{Attribute, Decoder, Encoder, Order, Point, Settings};
use serde::{Deserialize, Serialize};

#[derive(Serialize, Deserialize)]
struct Vector {
    description: String,
    /// Hexadecimal.
    packet: String,
    #[serde(rename = "stepMm")]
    step_mm: u8,
    /// Of the first point, in grid steps.
    origin: [i32; 3],
    /// x, y, z in grid steps from the origin, and the attribute (5-6-5 colour, intensity 0…255, or 0).
    points: Vec<[i32; 4]>,
}

fn file() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("vectors/packets.json")
}

fn frames() -> Vec<(&'static str, Vec<Point>, Settings)> {
    let ring = |turn: fn([f64; 3]) -> [f64; 3]| -> Vec<Point> {
        (0_u32..60)
            .map(|i| {
                let angle = f64::from(i) * 0.013 + 0.5;
                let range = if (20..35).contains(&i) { 31.25 } else { 8.0 + f64::from(i * 37 % 11) * 0.015 };
                let at = turn([range * angle.cos(), range * angle.sin(), range * -0.1]);
                [
                    at[0] as f32,
                    at[1] as f32,
                    at[2] as f32,
                    f32::from_bits(0xff00_0000 | (i * 0x0005_0309 + i * i)),
                ]
            })
            .collect()
    };
    let settings =
        |attribute, step_mm| Settings { attribute, step_mm, order: Order::AsGiven, ..Settings::default() };
    let scattered: Vec<Point> = (0_u32..40)
        .map(|i| {
            let at = |k: u32| ((i * k % 97) as f32 - 48.0) * if i % 13 == 0 { 5.0 } else { 0.02 };
            [at(31), at(57), at(11), f32::from_bits(i * 0x0001_0101)]
        })
        .collect();
    vec![
        ("one point, nothing with it", vec![[-1.234, 0.0, 499.996, 0.0]], settings(Attribute::None, 10)),
        ("a ring about z with intensities of 8 bits", ring(|at| at), settings(Attribute::Intensity8, 10)),
        (
            "a ring about y, optical axes, with colours",
            ring(|[x, y, z]| [-y, -z, x]),
            settings(Attribute::Colour, 5),
        ),
        ("a ring about x, no attribute", ring(|[x, y, z]| [z, x, y]), settings(Attribute::None, 20)),
        ("scattered points with intensities of 16 bits", scattered, settings(Attribute::Intensity16, 1)),
    ]
}

fn bytes(hexadecimal: &str) -> Vec<u8> {
    (0..hexadecimal.len())
        .step_by(2)
        .map(|i| u8::from_str_radix(&hexadecimal[i..i + 2], 16).expect("hexadecimal"))
        .collect()
}

fn write() {
    let mut vectors = Vec::new();
    for (description, frame, settings) in frames() {
        let mut encoder = Encoder::new();
        encoder.encode(&frame, &settings).expect("the settings are in range");
        for packet in encoder.packets() {
            let mut decoder = Decoder::new(4096);
            decoder.decode(packet).expect("a whole packet");
            let coordinate =
                |at: usize| i32::from_le_bytes([0, packet[at], packet[at + 1], packet[at + 2]]) >> 8;
            vectors.push(Vector {
                description: description.into(),
                packet: packet.iter().map(|byte| format!("{byte:02x}")).collect(),
                step_mm: settings.step_mm,
                origin: [4, 7, 10].map(coordinate),
                points: decoder
                    .points()
                    .iter()
                    .map(|[x, y, z, word]| {
                        [i32::from(*x), i32::from(*y), i32::from(*z), i32::from(word.cast_unsigned())]
                    })
                    .collect(),
            });
        }
    }
    std::fs::write(file(), serde_json::to_string(&vectors).expect("numbers and strings") + "\n")
        .expect("a file");
}

#[test]
fn packets_give_the_points_of_the_vectors() {
    if std::env::var_os("WRITE_VECTORS").is_some() {
        write();
    }
    let text = std::fs::read_to_string(file()).expect("the vectors");
    let vectors: Vec<Vector> = serde_json::from_str(&text).expect("vectors");
    assert!(vectors.len() >= 5);
    for vector in vectors {
        let mut decoder = Decoder::new(4096);
        let packet = decoder.decode(&bytes(&vector.packet)).expect(&vector.description);
        for (axis, origin) in vector.origin.iter().enumerate() {
            let metres = f64::from(*origin) * f64::from(vector.step_mm) / 1000.0;
            assert!((f64::from(packet.origin[axis]) - metres).abs() < 1e-4);
        }
        let points: Vec<[i32; 4]> = decoder
            .points()
            .iter()
            .map(|[x, y, z, word]| {
                [i32::from(*x), i32::from(*y), i32::from(*z), i32::from(word.cast_unsigned())]
            })
            .collect();
        assert_eq!(points, vector.points, "{}", vector.description);
    }
}
