//! What goes in comes out, from any packets in any order; what is damaged is refused.

use farpoint_unorganised_codec::{
    Attribute, Decoder, EncodeReport, Encoder, Fault, MAX_PACKET_BYTES, Order, Point, Settings,
};
use proptest::prelude::*;

fn encode(frame: &[Point], settings: &Settings) -> (Vec<Vec<u8>>, EncodeReport) {
    let mut encoder = Encoder::new();
    let report = encoder.encode(frame, settings).expect("the settings are in range");
    (encoder.packets().map(<[u8]>::to_vec).collect(), report)
}

/// Points in metres, with the attribute's bits.
fn decode(packets: &[Vec<u8>]) -> Vec<([f64; 3], u16)> {
    let mut decoder = Decoder::new(1 << 20);
    let mut points = Vec::new();
    for packet in packets {
        let decoded = decoder.decode(packet).expect("a whole packet");
        for point in &decoder.points()[decoded.first..][..decoded.count] {
            let at = std::array::from_fn(|axis| {
                f64::from(decoded.origin[axis]) + f64::from(point[axis]) * f64::from(decoded.step)
            });
            points.push((at, point[3].cast_unsigned()));
        }
    }
    points
}

fn coordinate() -> impl Strategy<Value = f32> {
    prop_oneof![
        8 => -80.0_f32..80.0,
        4 => -2.0_f32..2.0,
        2 => -510.0_f32..510.0,
        1 => prop_oneof![Just(f32::NAN), Just(f32::INFINITY), Just(f32::NEG_INFINITY), Just(0.0), Just(-0.0), Just(1e-40)],
    ]
}

prop_compose! {
    /// Clusters, as surfaces are, and points anywhere.
    fn cloud()(
        seeds in prop::collection::vec((coordinate(), coordinate(), coordinate(), any::<u32>()), 0..60),
        steps in prop::collection::vec((-0.2_f32..0.2, -0.2_f32..0.2, -0.02_f32..0.02, any::<u32>()), 1..30),
    ) -> Vec<Point> {
        seeds.iter().flat_map(|(x, y, z, word)| steps.iter().map(move |(dx, dy, dz, change)| {
            [x + dx, y + dy, z + dz, f32::from_bits(word ^ (change & 0x0707_0707))]
        })).collect()
    }
}

fn settings() -> impl Strategy<Value = Settings> {
    let attribute = prop_oneof![
        Just(Attribute::None),
        Just(Attribute::Colour),
        Just(Attribute::Intensity8),
        Just(Attribute::Intensity16)
    ];
    let order = prop_oneof![Just(Order::Auto), Just(Order::AsGiven), Just(Order::Sweep), Just(Order::Morton)];
    (1_u8..=100, attribute, order, 128_usize..=1200).prop_map(
        |(step_mm, attribute, order, max_packet_bytes)| Settings {
            step_mm,
            attribute,
            order,
            max_packet_bytes,
            ..Settings::default()
        },
    )
}

fn can_be_sent(point: &Point) -> bool {
    point[..3].iter().all(|coordinate| coordinate.is_finite() && coordinate.abs() <= 500.0)
}

/// Each input's grid place, sorted, to compare two clouds as bags; `per_metre` steps. It is multiplied, as in the encoder:
/// divided, what lies halfway between two places may come to the other one.
fn places(points: impl Iterator<Item = [f64; 3]>, per_metre: f64) -> Vec<[i64; 3]> {
    let mut places: Vec<_> =
        points.map(|point| point.map(|metres| (metres * per_metre + 0.5).floor() as i64)).collect();
    places.sort_unstable();
    places
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(160))]

    #[test]
    fn every_point_that_can_be_sent_arrives_on_its_grid_place(frame in cloud(), settings in settings()) {
        let (packets, report) = encode(&frame, &settings);
        prop_assert!(packets.iter().all(|packet| packet.len() <= settings.max_packet_bytes));
        let sent: Vec<&Point> = frame.iter().filter(|point| can_be_sent(point)).collect();
        prop_assert_eq!(report.kept, sent.len());
        prop_assert_eq!(report.rejected.not_finite + report.rejected.out_of_range, frame.len() - sent.len());
        prop_assert_eq!(report.bytes, packets.iter().map(Vec::len).sum::<usize>());
        let step = f64::from(settings.step_mm) / 1000.0;
        // A coordinate lies on the grid after decoding, but for the rounding of its origin to a float.
        let received = decode(&packets);
        let grid: Vec<[f64; 3]> = received.iter().map(|(at, _)| at.map(|metres| (metres / step).round() * step)).collect();
        for ((at, _), on_grid) in received.iter().zip(&grid) {
            for axis in 0..3 {
                prop_assert!((at[axis] - on_grid[axis]).abs() < 1e-4);
            }
        }
        let sent = sent.iter().map(|point| [point[0], point[1], point[2]].map(f64::from));
        let per_metre = 1000.0 / f64::from(settings.step_mm);
        prop_assert_eq!(places(sent, per_metre), places(grid.into_iter(), per_metre));
    }

    #[test]
    fn in_the_order_given_each_point_has_its_own_attribute(frame in cloud(), colour in any::<bool>()) {
        let attribute = if colour { Attribute::Colour } else { Attribute::Intensity8 };
        let settings = Settings { attribute, order: Order::AsGiven, step_mm: 100, ..Settings::default() };
        let (packets, _) = encode(&frame, &settings);
        let mut expected: Vec<u16> = frame.iter().filter(|point| can_be_sent(point)).map(|point| {
            let [r, g, b, _] = point[3].to_bits().to_le_bytes();
            if !colour { return u16::from(r) }
            let nearest = |byte: u8, top: f64| (f64::from(byte) * top / 255.0).round() as u16;
            nearest(r, 31.0) << 11 | nearest(g, 63.0) << 5 | nearest(b, 31.0)
        }).collect();
        let mut received: Vec<u16> = decode(&packets).into_iter().map(|(_, attribute)| attribute).collect();
        expected.sort_unstable();
        received.sort_unstable();
        prop_assert_eq!(received.len(), expected.len());
        for (received, expected) in received.iter().zip(expected) {
            // Intensities that are a half of a coarser scale come back as the value above.
            prop_assert!(*received == expected || !colour && *received == expected + 1);
        }
    }

    #[test]
    fn packets_are_decoded_alone_and_in_any_order(frame in cloud(), seed in any::<u64>()) {
        let settings = Settings { max_packet_bytes: 200, ..Settings::default() };
        let (packets, _) = encode(&frame, &settings);
        let mut together = decode(&packets);
        let mut apart: Vec<_> = packets.iter().flat_map(|packet| decode(std::slice::from_ref(packet))).collect();
        prop_assert_eq!(&together, &apart);
        let mut shuffled = packets;
        shuffled.sort_by_key(|packet| packet.iter().fold(seed, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3)));
        let mut mixed = decode(&shuffled);
        for points in [&mut together, &mut apart, &mut mixed] {
            points.sort_by(|a, b| a.partial_cmp(b).expect("all finite"));
        }
        prop_assert_eq!(&together, &mixed);
    }

    #[test]
    fn a_damaged_packet_is_refused(frame in cloud(), at in any::<prop::sample::Index>(), flip in 1_u8..) {
        let (packets, _) = encode(&frame, &Settings::default());
        let mut decoder = Decoder::new(100_000);
        for packet in packets {
            let mut damaged = packet.clone();
            damaged[at.index(packet.len())] ^= flip;
            prop_assert_eq!(decoder.decode(&damaged), Err(Fault::Check));
            let cut = at.index(packet.len());
            prop_assert!(decoder.decode(&packet[..cut]).is_err());
            prop_assert!(decoder.points().is_empty());
        }
    }
}

/// CRC-32, written apart from the crate's: what an attacker would put at the end.
fn sign(body: &mut Vec<u8>) {
    let mut crc = u32::MAX;
    for byte in &*body {
        crc ^= u32::from(*byte);
        for _ in 0..8 {
            crc = if crc & 1 == 1 { crc >> 1 ^ 0xedb8_8320 } else { crc >> 1 };
        }
    }
    body.extend((!crc).to_le_bytes());
}

#[test]
fn any_bytes_with_a_right_check_value_give_points_or_a_fault() {
    let mut state = 0x1234_5678_9abc_def0_u64;
    let mut random = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state
    };
    let frame: Vec<Point> = (0..3000)
        .map(|i| {
            let angle = f64::from(i) * 0.003;
            [(9.0 * angle.cos()) as f32, (9.0 * angle.sin()) as f32, 0.1, f32::from_bits(i as u32 * 77)]
        })
        .collect();
    let attributes = [Attribute::None, Attribute::Colour, Attribute::Intensity8];
    let sources: Vec<Vec<u8>> = attributes
        .iter()
        .flat_map(|attribute| encode(&frame, &Settings { attribute: *attribute, ..Settings::default() }).0)
        .collect();
    let mut decoder = Decoder::new(10_000);
    let (mut good, mut bad) = (0, 0);
    for round in 0..60_000 {
        let mut body = if round % 3 == 0 {
            let length = random() as usize % (MAX_PACKET_BYTES - 4);
            let mut body: Vec<u8> = (0..length).map(|_| random() as u8).collect();
            if let Some(version) = body.first_mut() {
                *version = 1 << 4 | *version & 0xf;
            }
            body
        } else {
            let source = &sources[random() as usize % sources.len()];
            let mut body = source[..source.len() - 4].to_vec();
            for _ in 0..=random() % 3 {
                let at = random() as usize % body.len();
                body[if random() % 2 == 0 { at } else { at % 19 }] = random() as u8;
            }
            if random() % 4 == 0 {
                body.truncate(random() as usize % body.len());
            }
            body
        };
        sign(&mut body);
        decoder.clear();
        match decoder.decode(&body) {
            Ok(packet) => {
                assert!(packet.count <= 4096 && packet.origin.iter().all(|metres| metres.abs() < 501.0));
                good += 1;
            }
            Err(_) => {
                assert!(decoder.points().is_empty() && decoder.packets().is_empty());
                bad += 1;
            }
        }
    }
    assert!(good > 0 && bad > 1000, "{good} and {bad}");
}

#[test]
fn a_budget_is_met_within_five_per_cent() {
    // Rings over a plane.
    let frame: Vec<Point> = (0..40_000)
        .map(|i| {
            let (ring, angle) = (f64::from(i / 1000), f64::from(i % 1000) * 0.006_283);
            let range = 1.7 / (0.4 - ring * 0.0098) + (angle * 7.0).sin() * 0.2;
            [(range * angle.cos()) as f32, (range * angle.sin()) as f32, -1.7, f32::from_bits(i as u32 % 97)]
        })
        .collect();
    for lambda in [0.0, 1.0, 3.0] {
        for budget in [6_000, 15_000, 30_000] {
            let settings = Settings {
                attribute: Attribute::Intensity8,
                budget_bytes: Some(budget),
                lambda,
                ..Settings::default()
            };
            let (_, report) = encode(&frame, &settings);
            assert!(
                report.bytes <= budget && report.bytes * 100 >= budget * 95,
                "{lambda} {budget}: {}",
                report.bytes
            );
            assert_eq!(report.kept + report.thinned, frame.len());
        }
    }
}

#[test]
fn near_packets_come_first() {
    let frame: Vec<Point> = (0..20_000)
        .map(|i| {
            let angle = f64::from(i) * 0.01;
            let range = f64::from((i * 7919) % 60 + 1);
            [(range * angle.cos()) as f32, (range * angle.sin()) as f32, 0.0, 0.0]
        })
        .collect();
    let settings = Settings { order: Order::Morton, attribute: Attribute::None, ..Settings::default() };
    let (packets, _) = encode(&frame, &settings);
    assert!(packets.len() > 5);
    let mean = |packet: &Vec<u8>| {
        let points = decode(std::slice::from_ref(packet));
        points.iter().map(|([x, y, _], _)| x * x + y * y).sum::<f64>() / points.len() as f64
    };
    let means: Vec<f64> = packets.iter().map(mean).collect();
    assert!(means.is_sorted_by(|a, b| *a <= *b + 1e-3), "{means:?}");
}

#[test]
fn a_full_decoder_says_so() {
    let frame = vec![[1.0, 2.0, 3.0, 0.0]; 100];
    let (packets, _) = encode(&frame, &Settings::default());
    assert_eq!(packets.len(), 1);
    assert_eq!(Decoder::new(99).decode(&packets[0]), Err(Fault::Full));
    assert!(Decoder::new(100).decode(&packets[0]).is_ok());
}
