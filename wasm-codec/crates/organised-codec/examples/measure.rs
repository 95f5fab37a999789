//! `measure FRAME… [--level L] [--quality Q | --psnr DB] [--mode none|palette|420|444] [--budget BYTES] [--rounds N] [--json]`:
//! bits a valid point, errors and median times, for frames kept as u32 width, height, f32 fx, fy, cx, cy and 16 bytes a
//! point. With `--json` the times alone, as one JSON object a frame.

use std::time::Instant;

use farpoint_organised_codec::{
    Budget, BudgetColour, ColourMode, Decoder, Encoder, Frame, Intrinsics, Point, Settings, Source,
    StreamHeader, Validity, stream, with_palette,
};

struct Wanted {
    settings: Settings,
    /// The coarsest quality with colours as good as this, dB.
    psnr: Option<f64>,
    budget: Option<usize>,
    rounds: usize,
    json: bool,
    files: Vec<String>,
}

fn main() {
    let wanted = arguments();
    for file in &wanted.files {
        let (mut header, points) = read(file);
        if wanted.settings.mode == ColourMode::Palette {
            header = with_palette(header, Source::Points(&points)).expect("few colours");
        }
        let qualities = match wanted.psnr {
            Some(_) => (0..32).rev().collect(),
            None => vec![wanted.settings.quality],
        };
        for quality in qualities {
            let settings = Settings { quality, ..wanted.settings };
            if measure(file, &header, &points, settings, &wanted) {
                break;
            }
        }
    }
}

fn arguments() -> Wanted {
    let mut wanted = Wanted {
        settings: Settings { quality: 18, ..Settings::default() },
        psnr: None,
        budget: None,
        rounds: 10,
        json: false,
        files: Vec::new(),
    };
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next().expect("a value");
        match argument.as_str() {
            "--level" => wanted.settings.depth_level = value().parse().expect("a level"),
            "--quality" => wanted.settings.quality = value().parse().expect("a quality"),
            "--psnr" => wanted.psnr = Some(value().parse().expect("decibels")),
            "--budget" => wanted.budget = Some(value().parse().expect("bytes")),
            "--rounds" => wanted.rounds = value().parse().expect("a number"),
            "--json" => wanted.json = true,
            "--mode" => {
                wanted.settings.mode = match value().as_str() {
                    "none" => ColourMode::None,
                    "palette" => ColourMode::Palette,
                    "444" => ColourMode::Full,
                    _ => ColourMode::Subsampled,
                }
            }
            _ => wanted.files.push(argument),
        }
    }
    wanted
}

/// False where the colours are not good enough.
fn measure(
    file: &str,
    header: &StreamHeader,
    points: &[Point],
    mut settings: Settings,
    wanted: &Wanted,
) -> bool {
    let source = Source::Points(points);
    let mut encoder = Encoder::new(header.clone()).expect("a camera");
    let mut decoder = Decoder::new(header.clone(), false).expect("a camera");
    let (mut encode, mut decode) = (Vec::new(), Vec::new());
    let mut frame = Frame::default();
    for _ in 0..wanted.rounds.max(1) {
        let start = Instant::now();
        if let Some(bytes) = wanted.budget {
            let colour = match settings.mode {
                ColourMode::Palette => BudgetColour::Palette,
                _ => BudgetColour::Suited,
            };
            let budget = Budget { bytes, validity: Validity::default(), latency_test: false, colour };
            let spent = encoder.encode_within(source, &budget).expect("a frame");
            (frame, settings) = (spent.frame, spent.settings);
        } else {
            encoder.choose_tables(source, &mut settings);
            frame = encoder.encode(source, &settings).expect("a frame");
        }
        encode.push(start.elapsed().as_secs_f64() * 1e3);
        let start = Instant::now();
        put_all(&encoder, &mut decoder);
        decode.push(start.elapsed().as_secs_f64() * 1e3);
    }
    let (encode_ms, decode_ms) = (median(encode), median(decode));
    if wanted.json {
        println!("{{\"encodeMs\":{encode_ms:.3},\"decodeMs\":{decode_ms:.3}}}");
        return true;
    }
    let mut witness = Decoder::new(header.clone(), true).expect("a camera");
    put_all(&encoder, &mut witness);
    let (mut worst, mut squares, mut valid) = (0.0_f64, 0.0, 0_usize);
    for ((point, depth), colour) in points.iter().zip(witness.depth()).zip(witness.colour()) {
        if *depth == 0.0 {
            continue;
        }
        valid += 1;
        let exact = f64::from(point[2]);
        worst = worst.max((f64::from(*depth) - exact).abs() * 1000.0 / (exact * exact));
        let bytes = point[3].to_bits().to_le_bytes().into_iter().zip(colour.to_le_bytes());
        squares += bytes.take(3).map(|(a, b)| (f64::from(a) - f64::from(b)).powi(2)).sum::<f64>();
    }
    assert_eq!(valid, frame.points);
    let psnr = 10.0 * (255.0 * 255.0 / (squares / (3 * valid) as f64)).log10();
    if wanted.psnr.is_some_and(|least| psnr < least) {
        return false;
    }
    let alone = frame.bytes as f64 * 8.0 / encoder.bits_in_one_packet(source, &settings) - 1.0;
    println!(
        "{:24} quality {:2} sets {},{} points {:6} thinned {} packets {:3} bits/pt {:5.3} worst {:.3} mm·z² PSNR {:.2} encode {:.2} decode {:.2} ms packets cost {:+.2} %",
        file.rsplit('/').next().unwrap_or(""),
        settings.quality,
        settings.geometry_set,
        settings.colour_set,
        frame.points,
        frame.thinned,
        frame.packets,
        frame.bytes as f64 * 8.0 / frame.points as f64,
        worst,
        psnr,
        encode_ms,
        decode_ms,
        alone * 100.0,
    );
    true
}

fn put_all(encoder: &Encoder, decoder: &mut Decoder) {
    decoder.begin();
    for packet in 0..encoder.packets().len() {
        decoder.put(encoder.packet(packet)).expect("a packet");
    }
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
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
