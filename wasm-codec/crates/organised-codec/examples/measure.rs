//! `measure FRAME.raw… [--level L] [--quality Q] [--mode none|420|444] [--sets G,C]`: bits a valid point, error, PSNR and
//! time for frames kept as u32 width, height, f32 fx, fy, cx, cy and 16 bytes a point.

use std::time::Instant;

use farpoint_organised_codec::{
    ColourMode, Decoder, Encoder, Intrinsics, Settings, Source, StreamHeader, stream, with_palette,
};

fn main() {
    let mut settings = Settings::default();
    let mut files = Vec::new();
    let mut arguments = std::env::args().skip(1);
    let mut psnr_wanted = None;
    let mut rounds = 10;
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next().expect("a value");
        match argument.as_str() {
            "--level" => settings.depth_level = value().parse().expect("a level"),
            "--quality" => settings.quality = value().parse().expect("a quality"),
            "--psnr" => psnr_wanted = Some(value().parse::<f64>().expect("decibels")),
            "--rounds" => rounds = value().parse().expect("a number"),
            "--mode" => {
                settings.mode = match value().as_str() {
                    "none" => ColourMode::None,
                    "palette" => ColourMode::Palette,
                    "420" => ColourMode::Subsampled,
                    _ => ColourMode::Full,
                }
            }
            _ => files.push(argument),
        }
    }
    for file in files {
        let (mut header, points) = read(&file);
        if settings.mode == ColourMode::Palette {
            header = with_palette(header, Source::Points(&points)).expect("few colours");
        }
        let mut encoder = Encoder::new(header.clone()).expect("a camera");
        let mut decoder = Decoder::new(header.clone(), true).expect("a camera");
        let mut fast = Decoder::new(header, false).expect("a camera");
        let qualities = match psnr_wanted {
            Some(_) => (0..32).rev().collect(),
            None => vec![settings.quality],
        };
        for quality in qualities {
            settings.quality = quality;
            encoder.choose_tables(Source::Points(&points), &mut settings);
            let (mut encode_ms, mut decode_ms) = (f64::MAX, f64::MAX);
            let mut frame = None;
            for _ in 0..rounds {
                let start = Instant::now();
                frame = encoder.encode(Source::Points(&points), &settings);
                encode_ms = encode_ms.min(start.elapsed().as_secs_f64() * 1e3);
                let start = Instant::now();
                fast.begin();
                for packet in 0..encoder.packets().len() {
                    fast.put(encoder.packet(packet)).expect("a packet");
                }
                decode_ms = decode_ms.min(start.elapsed().as_secs_f64() * 1e3);
            }
            let frame = frame.expect("a frame");
            decoder.begin();
            for packet in 0..encoder.packets().len() {
                decoder.put(encoder.packet(packet)).expect("a packet");
            }
            let (mut worst, mut squares, mut depth_squares, mut valid) = (0.0_f64, 0.0, 0.0, 0_usize);
            for (i, point) in points.iter().enumerate() {
                let z = f64::from(decoder.depth()[i]);
                if z == 0.0 {
                    continue;
                }
                valid += 1;
                let exact = f64::from(point[2]);
                let error = (z - exact).abs() * 1000.0 / (exact * exact);
                worst = worst.max(error);
                depth_squares += error * error;
                let (a, b) = (point[3].to_bits().to_le_bytes(), decoder.colour()[i].to_le_bytes());
                for c in 0..3 {
                    squares += (f64::from(a[c]) - f64::from(b[c])).powi(2);
                }
            }
            assert_eq!(valid, frame.points);
            let psnr = 10.0 * (255.0 * 255.0 / (squares / (3 * valid) as f64)).log10();
            if psnr_wanted.is_some_and(|wanted| psnr < wanted) {
                continue;
            }
            let whole = encoder.bits_in_one_packet(Source::Points(&points), &settings) / 8.0;
            println!(
                "{:22} q{:2} sets {},{} points {:6} packets {:3} bits/pt {:5.3} max {:.3} rms {:.3} mm·z² PSNR {:.2} enc {:.2} dec {:.2} ms left {:?} thinned {} packets cost {:+.2} %",
                file.rsplit('/').next().unwrap_or(""),
                quality,
                settings.geometry_set,
                settings.colour_set,
                frame.points,
                frame.packets,
                frame.bytes as f64 * 8.0 / frame.points as f64,
                worst,
                (depth_squares / valid as f64).sqrt(),
                psnr,
                encode_ms,
                decode_ms,
                (frame.left.non_positive_depth, frame.left.out_of_range),
                frame.thinned,
                (frame.bytes as f64 / whole - 1.0) * 100.0,
            );
            break;
        }
    }
}

fn read(file: &str) -> (StreamHeader, Vec<[f32; 4]>) {
    let bytes = std::fs::read(file).expect("a frame");
    let word = |i: usize| u32::from_le_bytes(bytes[4 * i..4 * i + 4].try_into().expect("four bytes"));
    let float = |i: usize| f32::from_bits(word(i));
    let intrinsics = Intrinsics { fx: float(2), fy: float(3), cx: float(4), cy: float(5) };
    let header = StreamHeader {
        id: 1,
        width: word(0) as u16,
        height: word(1) as u16,
        intrinsics,
        depth_unit: stream::DEPTH_UNIT,
        palette: Vec::new(),
        index_frequencies: Vec::new(),
    };
    let points = (0..word(0) as usize * word(1) as usize)
        .map(|i| core::array::from_fn(|c| float(6 + 4 * i + c)))
        .collect();
    (header, points)
}
