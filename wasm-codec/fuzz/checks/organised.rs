//! What must hold for any bytes that reach the organised decoder. The fuzz targets and the replay of their corpus share it.

use farpoint_organised_codec::contexts::INDEX_CONTEXTS;
use farpoint_organised_codec::crc16::crc16;
use farpoint_organised_codec::tables::EVEN;
use farpoint_organised_codec::{Decoder, Intrinsics, PacketError, StreamHeader, seal, stream};

const ID: u8 = 9;
const SIDES: (u16, u16) = (90, 60);

fn header(colours: u8) -> StreamHeader {
    let frequencies = if colours > 0 { vec![EVEN; INDEX_CONTEXTS] } else { Vec::new() };
    StreamHeader {
        id: ID,
        width: SIDES.0,
        height: SIDES.1,
        intrinsics: Intrinsics { fx: 62.0, fy: 62.0, cx: 44.5, cy: 29.5 },
        depth_unit: stream::DEPTH_UNIT,
        palette: (0..colours).map(|level| [level; 3]).collect(),
        index_frequencies: frequencies,
    }
}

/// A packet gives points or an error; an error leaves no point; images make no difference; nothing is kept between frames.
fn decode(packet: &[u8], colours: u8) -> Result<usize, PacketError> {
    let pixels = usize::from(SIDES.0) * usize::from(SIDES.1);
    let mut decoder = Decoder::new(header(colours), false).expect("a stream");
    let first = decoder.put(packet).map(|put| put.points);
    assert_eq!(decoder.points().len(), first.unwrap_or(0));
    assert!(decoder.points().len() <= pixels);
    let points = decoder.points().to_vec();
    if first.is_ok() {
        assert_eq!(decoder.put(packet), Err(PacketError::Duplicate));
    }
    decoder.begin();
    assert_eq!(decoder.put(packet).map(|put| put.points), first);
    assert_eq!(decoder.points(), points);
    let mut with_images = Decoder::new(header(colours), true).expect("a stream");
    assert_eq!(with_images.put(packet).map(|put| put.points), first);
    if first.is_ok() {
        let seen = with_images.depth().iter().filter(|depth| **depth > 0.0).count();
        assert_eq!(seen, points.len());
    }
    first
}

/// Two packets at once are as one after the other.
fn decode_two(packets: [&[u8]; 2], colours: u8) {
    let [mut one_by_one, mut at_once] =
        [(); 2].map(|()| Decoder::new(header(colours), false).expect("a stream"));
    let expected = packets.map(|packet| one_by_one.put(packet));
    assert_eq!(at_once.put_two(packets), expected);
    assert_eq!(at_once.points(), one_by_one.points());
}

/// With the id and the check value put right.
fn forge(data: &[u8]) -> Vec<u8> {
    let mut forged = data.to_vec();
    if let Some(id) = forged.first_mut() {
        *id = ID;
    }
    seal(&mut forged);
    forged
}

/// Any bytes as a packet: as they are, then with the id and the check value put right; and as two.
pub fn packet(data: &[u8]) {
    let _ = decode(data, 0);
    let (first, second) = data.split_at(data.len() / 2);
    for colours in [0, 40] {
        decode_two([&forge(first), &forge(second)], colours);
        decode_two([&forge(data), &forge(second)], colours);
    }
    if data.len() >= 5 {
        let forged = forge(data);
        for colours in [0, 40] {
            let told = decode(&forged, colours);
            // In packets without signs the check value is coded with the rest.
            let is_sealed = matches!(forged[1] >> 6, 1 | 2);
            assert!(!is_sealed || told != Err(PacketError::Check));
        }
    }
}

/// Any bytes as a stream header: as they are, then with the check value put right.
pub fn stream_header(data: &[u8]) {
    let mut forged = data.to_vec();
    for _ in 0..2 {
        if let Ok(header) = StreamHeader::parse(&forged) {
            assert_eq!(header.to_bytes(), forged);
            if usize::from(header.width) * usize::from(header.height) <= 1 << 16 {
                let mut decoder = Decoder::new(header, false).expect("a valid header");
                let _ = decoder.put(data);
            }
        }
        if let Some((rest, check)) = forged.split_last_chunk_mut::<2>() {
            *check = crc16(&[rest]).to_le_bytes();
        }
    }
}
