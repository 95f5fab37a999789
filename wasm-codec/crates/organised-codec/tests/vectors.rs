//! The conformance vectors: stream headers and packets as they go over the wire, and the points they must give.
//! `FARPOINT_WRITE_VECTORS=1 cargo test -p farpoint-organised-codec --test vectors` writes them anew.

mod common;

use common::{frame, header};
use farpoint_organised_codec::{
    ColourMode, Decoder, Encoder, Settings, Source, StreamHeader, Validity, with_palette,
};
use serde::{Deserialize, Serialize};

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
struct Vector {
    name: String,
    stream_header: String,
    packets: Vec<VectorPacket>,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
struct VectorPacket {
    data: String,
    /// x, y, z in millimetres and the 6-6-4 colour of each point, in order.
    points: Vec<[i32; 4]>,
}

const PATH: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../vectors/organised.json");

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

fn unhex(text: &str) -> Vec<u8> {
    (0..text.len())
        .step_by(2)
        .map(|at| u8::from_str_radix(&text[at..at + 2], 16).expect("hexadecimal"))
        .collect()
}

fn points(decoder: &Decoder, start: usize) -> Vec<[i32; 4]> {
    let number = |bits: u64| {
        let part = |i: u32| i32::from((bits >> (16 * i)) as u16 as i16);
        [part(0), part(1), part(2), (bits >> 48) as i32]
    };
    decoder.points()[start..].iter().map(|bits| number(*bits)).collect()
}

fn made() -> Vec<Vector> {
    let cases = [
        ("subsampled", ColourMode::Subsampled, 18, 3, 0.0),
        ("full chroma", ColourMode::Full, 8, 1, 0.0),
        ("palette", ColourMode::Palette, 0, 3, 0.0),
        ("latency test", ColourMode::None, 0, 5, 0.0),
        ("thinned", ColourMode::Subsampled, 12, 4, 0.3),
        ("thinned palette", ColourMode::Palette, 0, 2, 0.3),
        ("thinned latency test", ColourMode::None, 0, 6, 0.1),
        ("full and empty tiles", ColourMode::Subsampled, 2, 3, 0.0),
        ("full and empty tiles, thinned", ColourMode::Full, 6, 4, 0.15),
    ];
    let vector = |(name, mode, quality, depth_level, density): (&str, ColourMode, u8, u8, f32)| {
        let mut header = header(53, 41);
        let has_full_tiles = name.starts_with("full and empty");
        let holes = if has_full_tiles { 0.0 } else { 0.15 };
        let mut points_in = frame(&header, 11, holes, 0.004, mode == ColourMode::Palette);
        if has_full_tiles {
            let width = usize::from(header.width);
            let is_left_out = |i: usize| i % width >= width / 3 && i / width < 20;
            for (_, point) in points_in.iter_mut().enumerate().filter(|(i, _)| is_left_out(*i)) {
                point[2] = 0.0;
            }
        }
        let source = Source::Points(&points_in);
        if mode == ColourMode::Palette {
            header = with_palette(header, source).expect("few colours");
        }
        let mut encoder = Encoder::new(header.clone()).expect("a stream");
        if density > 0.0 {
            encoder.thin_to(source, &Validity { near_distance: 0.5, lambda: 3.0, epsilon: 1e-3 }, density);
        }
        let mut settings = Settings { mode, quality, depth_level, ..Settings::default() };
        encoder.choose_tables(source, &mut settings);
        encoder.encode(source, &settings).expect("a frame");
        let mut decoder = Decoder::new(header.clone(), false).expect("a stream");
        let packets = (0..encoder.packets().len())
            .map(|index| {
                let put = decoder.put(encoder.packet(index)).expect("a packet");
                VectorPacket { data: hex(encoder.packet(index)), points: points(&decoder, put.start) }
            })
            .collect();
        Vector { name: name.to_owned(), stream_header: hex(&header.to_bytes()), packets }
    };
    cases.into_iter().map(vector).collect()
}

#[test]
fn the_vectors_give_their_points() {
    if std::env::var_os("FARPOINT_WRITE_VECTORS").is_some() {
        let text = serde_json::to_string(&made()).expect("JSON").replace("},{\"", "},\n{\"");
        std::fs::write(PATH, text + "\n").expect("a file");
    }
    let vectors: Vec<Vector> =
        serde_json::from_str(&std::fs::read_to_string(PATH).expect("the vectors")).expect("vectors");
    assert_eq!(vectors.len(), 9);
    for vector in vectors {
        let header = StreamHeader::parse(&unhex(&vector.stream_header)).expect("a header");
        let mut decoder = Decoder::new(header, false).expect("a stream");
        assert!(!vector.packets.is_empty());
        for packet in &vector.packets {
            let put = decoder.put(&unhex(&packet.data)).expect("a packet");
            assert_eq!(points(&decoder, put.start), packet.points, "{}", vector.name);
        }
    }
}
