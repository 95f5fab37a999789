//! Packets that are damaged, cut, foreign or forged.

mod common;

use common::{Random, frame, header, packets};
use farpoint_organised_codec::{
    ColourMode, Decoder, Encoder, PacketError, Settings, Source, StreamHeader, seal, with_palette,
};

/// Where the check value is in the header, and where the states hold it.
#[test]
fn every_damaged_bit_is_told_or_does_nothing() {
    let header = header(48, 32);
    let points = frame(&header, 1, 0.1, 0.01, true);
    let header = with_palette(header, Source::Points(&points)).expect("few colours");
    let mut harmless = 0;
    for mode in [ColourMode::None, ColourMode::Subsampled, ColourMode::Full, ColourMode::Palette] {
        let mut encoder = Encoder::new(header.clone()).expect("a stream");
        encoder.encode(Source::Points(&points), &Settings { mode, ..Settings::default() }).expect("a frame");
        let mut decoder = Decoder::new(header.clone(), false).expect("a stream");
        for packet in packets(&encoder) {
            decoder.begin();
            decoder.put(&packet).expect("a packet");
            let points = decoder.points().to_vec();
            for bit in 0..packet.len() * 8 {
                let mut damaged = packet.clone();
                damaged[bit / 8] ^= 1 << (bit % 8);
                decoder.begin();
                let told = decoder.put(&damaged).is_err();
                // What is beyond its range is limited: now and then that makes the damage good.
                assert!(told || decoder.points() == points, "{mode:?}, bit {bit}");
                harmless += u32::from(!told);
            }
        }
    }
    assert!(harmless < 10, "{harmless}");
}

#[test]
fn packets_that_are_cut_or_not_of_this_frame_are_told() {
    let header = header(90, 60);
    let points = frame(&header, 1, 0.1, 0.01, false);
    let mut encoder = Encoder::new(header.clone()).expect("a stream");
    encoder.encode(Source::Points(&points), &Settings::default()).expect("a frame");
    let packet = encoder.packet(0).to_vec();
    let mut decoder = Decoder::new(header.clone(), false).expect("a stream");
    for length in 0..packet.len() {
        assert!(decoder.put(&packet[..length]).is_err());
    }
    assert_eq!(decoder.put(&[0; 1201]), Err(PacketError::TooLong));
    assert_eq!(decoder.points().len(), 0);
    assert!(decoder.put(&packet).is_ok());
    assert_eq!(decoder.put(&packet), Err(PacketError::Duplicate));
    let mut other = Decoder::new(StreamHeader { id: 8, ..header }, false).expect("a stream");
    assert_eq!(other.put(&packet), Err(PacketError::UnknownStream));
}

/// Packets that pass the check value and are wrong all the same: points or an error, and never more points than pixels.
#[test]
fn forged_packets_do_no_harm() {
    let mut random = Random(7);
    let header = with_palette(header(90, 60), Source::Points(&frame(&header(90, 60), 1, 0.1, 0.01, true)));
    let header = header.expect("few colours");
    let points = frame(&header, 1, 0.1, 0.01, true);
    let mut encoder = Encoder::new(header.clone()).expect("a stream");
    let mut decoder = Decoder::new(header, true).expect("a stream");
    let mut accepted = 0;
    for round in 0..3000_u32 {
        if round % 100 == 0 {
            let mode =
                [ColourMode::Subsampled, ColourMode::Full, ColourMode::Palette][round as usize / 100 % 3];
            encoder
                .encode(Source::Points(&points), &Settings { mode, ..Settings::default() })
                .expect("a frame");
        }
        let mut packet = if round % 3 == 0 {
            let length = 17 + random.next() as usize % 1184;
            let mut bytes: Vec<u8> = (0..length).map(|_| random.next() as u8).collect();
            bytes[0] = 9;
            bytes[1] &= 0x7f;
            // The first tile: raw bits begin at the end.
            bytes[length - 1] &= 0x0f;
            bytes
        } else {
            let mut packet = encoder.packet(random.next() as usize % encoder.packets().len()).to_vec();
            for _ in 0..1 + random.next() % 3 {
                let at = random.next() as usize % packet.len();
                packet[at] = random.next() as u8;
            }
            packet
        };
        seal(&mut packet);
        decoder.begin();
        accepted += u32::from(decoder.put(&packet).is_ok());
        assert!(decoder.points().len() <= 90 * 60);
    }
    // The states' end tells nearly all that the check value was made to fit.
    assert!(accepted < 300, "{accepted}");
}
