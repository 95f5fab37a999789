//! `cargo run --release -p farpoint-unorganised-codec --example measure -- FILE STEP_MM none|colour|intensity8 ROUNDS`: native
//! medians, of a file of points as the encoder takes them (four little-endian 32-bit words each). Prints one JSON object.

use std::time::Instant;

use farpoint_unorganised_codec::{Attribute, Decoder, Encoder, Order, Point, Settings};

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, step_mm, attribute, rounds, rest @ ..] = arguments.as_slice() else {
        eprintln!("usage: measure FILE STEP_MM none|colour|intensity8 ROUNDS [given|sweep|morton]");
        std::process::exit(2);
    };
    let bytes = std::fs::read(file).expect("the file can be read");
    let (words, _) = bytes.as_chunks::<4>();
    let (points, _) = words.as_chunks::<4>();
    let frame: Vec<Point> = points.iter().map(|point| point.map(f32::from_le_bytes)).collect();
    let attribute = match attribute.as_str() {
        "colour" => Attribute::Colour,
        "intensity8" => Attribute::Intensity8,
        _ => Attribute::None,
    };
    let order = match rest.first().map(String::as_str) {
        Some("given") => Order::AsGiven,
        Some("sweep") => Order::Sweep,
        Some("morton") => Order::Morton,
        _ => Order::Auto,
    };
    let step_mm = step_mm.parse().expect("a step in millimetres");
    let settings = Settings { step_mm, attribute, order, ..Settings::default() };
    let (mut encoder, mut decoder) = (Encoder::new(), Decoder::new(frame.len()));
    let (mut encode, mut decode) = (Vec::new(), Vec::new());
    let mut report = None;
    for _ in 0..rounds.parse().expect("a number of rounds") {
        let begin = Instant::now();
        report = Some(encoder.encode(&frame, &settings).expect("settings in range"));
        encode.push(begin.elapsed().as_secs_f64() * 1000.0);
        let begin = Instant::now();
        decoder.clear();
        for packet in encoder.packets() {
            decoder.decode(packet).expect("what was encoded is decoded");
        }
        decode.push(begin.elapsed().as_secs_f64() * 1000.0);
    }
    let median = |times: &mut Vec<f64>| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    };
    let report = report.expect("at least one round");
    let header = encoder.packets().next().map_or(0, |packet| packet[0]);
    println!(
        "{{\"points\":{},\"packets\":{},\"bitsPerPoint\":{:.3},\"encodeMs\":{:.3},\"decodeMs\":{:.3},\"mode\":{}}}",
        report.kept,
        report.packets,
        report.bytes as f64 * 8.0 / report.kept as f64,
        median(&mut encode),
        median(&mut decode),
        header & 3
    );
}
