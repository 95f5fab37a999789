//! What goes in comes out, whole or in part, in any order.

mod common;

use common::{Random, decode, frame, header, packets, valid};
use farpoint_organised_codec::{
    ColourMode, Decoder, Encoder, Settings, Source, Validity, seal, with_palette,
};
use proptest::prelude::*;

fn settings() -> impl Strategy<Value = Settings> {
    (0_u8..8, 0_u8..4, 0_u8..32, 0_u8..8, 0_u8..4).prop_map(
        |(depth_level, mode, quality, geometry_set, colour_set)| {
            let mode = [ColourMode::None, ColourMode::Subsampled, ColourMode::Full, ColourMode::Palette]
                [usize::from(mode)];
            Settings { depth_level, mode, quality, geometry_set, colour_set }
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn every_valid_point_comes_back_within_its_error(
        (width, height) in (1_u16..70, 1_u16..70),
        seed: u64,
        holes in prop_oneof![Just(0.0_f32), 0.0_f32..1.0],
        noise in prop_oneof![Just(0.0_f32), 0.0_f32..0.2],
        settings in settings(),
    ) {
        let mut header = header(width, height);
        let palette = settings.mode == ColourMode::Palette;
        let points = frame(&header, seed, holes, noise, palette);
        if palette {
            let Some(with) = with_palette(header.clone(), Source::Points(&points)) else { return Ok(()) };
            header = with;
        }
        let mut encoder = Encoder::new(header.clone()).expect("a stream");
        let report = encoder.encode(Source::Points(&points), &settings).expect("a frame");
        let packets = packets(&encoder);
        prop_assert!(packets.iter().all(|packet| packet.len() <= 1200));
        let decoder = decode(&header, &packets);
        prop_assert_eq!(decoder.points().len(), report.points);
        let there = points.iter().filter(|point| valid(point)).count();
        prop_assert_eq!(report.points + report.thinned, there);
        prop_assert_eq!(report.thinned, report.too_dense);
        let left = report.left.not_finite + report.left.non_positive_depth + report.left.out_of_range;
        prop_assert_eq!(left as usize, points.len() - there);
        let step = f64::from(header.depth_step(settings.depth_level));
        for (point, (depth, colour)) in points.iter().zip(decoder.depth().iter().zip(decoder.colour())) {
            if *depth == 0.0 {
                continue;
            }
            prop_assert!(valid(point));
            let error = (1.0 / f64::from(*depth) - 1.0 / f64::from(point[2])).abs();
            prop_assert!(error <= step * 0.5 + 1e-6, "{} for {}", depth, point[2]);
            match settings.mode {
                ColourMode::None => prop_assert_eq!(*colour, 0xff00_ff00),
                ColourMode::Palette => prop_assert_eq!(*colour, point[3].to_bits()),
                _ => {}
            }
        }
    }

    #[test]
    fn images_and_points_give_the_same_packets(seed: u64, holes in 0.0_f32..0.5) {
        let header = header(50, 37);
        let points = frame(&header, seed, holes, 0.01, false);
        let depth: Vec<f32> = points.iter().map(|point| point[2]).collect();
        let colour: Vec<u32> = points.iter().map(|point| point[3].to_bits()).collect();
        let mut encoder = Encoder::new(header).expect("a stream");
        encoder.encode(Source::Points(&points), &Settings::default());
        let expected = packets(&encoder);
        encoder.encode(Source::Images { depth: &depth, colour: &colour }, &Settings::default());
        prop_assert_eq!(packets(&encoder), expected);
    }

    #[test]
    fn lost_and_shuffled_packets_cost_their_own_points_alone(seed: u64, density in 0.05_f32..2.0) {
        let header = header(200, 150);
        let points = frame(&header, seed, 0.1, 0.02, false);
        let mut encoder = Encoder::new(header.clone()).expect("a stream");
        encoder.thin_to(Source::Points(&points), &Validity { near_distance: 1.0, ..Validity::default() }, density);
        encoder.encode(Source::Points(&points), &Settings::default()).expect("a frame");
        let whole = decode(&header, &packets(&encoder));
        let mut random = Random(seed);
        let mut some: Vec<(usize, Vec<u8>)> = packets(&encoder).into_iter().enumerate().collect();
        some.retain(|_| random.uniform() < 0.7);
        some.sort_by_cached_key(|_| random.next());
        let expected: usize = some.iter().map(|(index, _)| encoder.packets()[*index].points).sum();
        let some: Vec<Vec<u8>> = some.into_iter().map(|(_, packet)| packet).collect();
        let part = decode(&header, &some);
        prop_assert_eq!(part.points().len(), expected);
        let mut all: Vec<u64> = whole.points().to_vec();
        all.sort_unstable();
        prop_assert!(part.points().iter().all(|point| all.binary_search(point).is_ok()));
        for (depth, exact) in part.depth().iter().zip(whole.depth()) {
            prop_assert!(*depth == 0.0 || depth == exact);
        }
        // Near packets first.
        prop_assert!(encoder.packets().is_sorted_by(|a, b| a.nearest >= b.nearest));
    }

    #[test]
    fn two_packets_at_once_are_as_one_after_the_other(
        seed: u64,
        holes in 0.0_f32..0.5,
        settings in settings(),
        damage in prop::option::of(0_usize..100_000),
    ) {
        let mut header = header(180, 130);
        let palette = settings.mode == ColourMode::Palette;
        let points = frame(&header, seed, holes, 0.01, palette);
        if palette {
            header = with_palette(header, Source::Points(&points)).expect("few colours");
        }
        let mut encoder = Encoder::new(header.clone()).expect("a stream");
        encoder.encode(Source::Points(&points), &settings).expect("a frame");
        let mut packets = packets(&encoder);
        // Some come twice, beside another and beside themselves.
        packets.extend_from_within(..packets.len() / 2);
        let mut random = Random(seed);
        packets.sort_by_cached_key(|_| random.next());
        if let Some(place) = damage {
            let index = place % packets.len();
            let bit = place % (8 * packets[index].len());
            packets[index][bit / 8] ^= 1 << (bit % 8);
            seal(&mut packets[index]);
        }
        for images in [false, true] {
            let mut decoders = [(); 2].map(|()| Decoder::new(header.clone(), images).expect("a stream"));
            let [one_by_one, at_once] = &mut decoders;
            for pair in packets.as_chunks::<2>().0 {
                let pair = pair.each_ref().map(Vec::as_slice);
                prop_assert_eq!(at_once.put_two(pair), pair.map(|packet| one_by_one.put(packet)));
            }
            prop_assert_eq!(at_once.points(), one_by_one.points());
            if damage.is_none() {
                prop_assert_eq!(at_once.depth(), one_by_one.depth());
                prop_assert_eq!(at_once.colour(), one_by_one.colour());
            }
        }
    }
}

#[test]
fn the_points_lie_where_the_depth_says() {
    let header = header(64, 48);
    let points = frame(&header, 3, 0.0, 0.0, false);
    let mut encoder = Encoder::new(header.clone()).expect("a stream");
    let settings = Settings { depth_level: 0, mode: ColourMode::Full, quality: 0, ..Settings::default() };
    encoder.encode(Source::Points(&points), &settings).expect("a frame");
    let decoder = decode(&header, &packets(&encoder));
    let mut exact: Vec<[i32; 3]> =
        points.iter().map(|p| core::array::from_fn(|i| (p[i] * 1000.0).round() as i32)).collect();
    let mut got: Vec<[i32; 3]> = decoder
        .points()
        .iter()
        .map(|bits| core::array::from_fn(|i| i32::from((bits >> (16 * i)) as u16 as i16)))
        .collect();
    exact.sort_unstable_by_key(|p| (p[0], p[1], p[2]));
    got.sort_unstable_by_key(|p| (p[0], p[1], p[2]));
    assert_eq!(got.len(), exact.len());
    // Each point has its own within 3 mm: 0.06 mm · z² and the rounding of both.
    for point in &got {
        let near = exact.iter().any(|own| own.iter().zip(point).all(|(a, b)| (a - b).abs() <= 3));
        assert!(near, "{point:?}");
    }
}
