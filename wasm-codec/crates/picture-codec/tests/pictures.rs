//! What is written can be read; what is broken is refused.

use farpoint_picture_codec::{decode_jpeg, decode_png, encode_jpeg};
use proptest::prelude::*;

/// Soft shades: JPEG keeps them to a few levels.
fn shades(width: usize, height: usize) -> Vec<u8> {
    (0..width * height)
        .flat_map(|i| {
            let (x, y) = (i % width, i / width);
            [(40 + x * 3 % 160) as u8, (60 + y * 2 % 120) as u8, 90, 255]
        })
        .collect()
}

fn png_of(width: u32, height: u32, colour: png::ColorType, samples: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(colour);
    encoder.write_header().unwrap().write_image_data(samples).unwrap();
    bytes
}

#[test]
fn a_jpeg_shows_what_it_was_made_of() {
    let rgba = shades(48, 32);
    let jpeg = encode_jpeg(&rgba, 48, 32, 90).unwrap();
    assert!(jpeg.len() < rgba.len() / 4);
    let mut read = decode_jpeg(&jpeg, 48 * 32).unwrap();
    assert_eq!((read.width(), read.height()), (48, 32));
    let off: u32 = rgba.iter().zip(read.take()).map(|(a, b)| u32::from(a.abs_diff(b))).sum();
    assert!(off / (rgba.len() as u32) < 3, "mean difference {off} of {}", rgba.len());
}

#[test]
fn sizes_that_do_not_agree_are_refused() {
    assert!(encode_jpeg(&[0; 15], 2, 2, 70).is_err());
    assert!(encode_jpeg(&[], 0, 2, 70).is_err());
    let jpeg = encode_jpeg(&shades(20, 20), 20, 20, 70).unwrap();
    assert!(decode_jpeg(&jpeg, 399).unwrap_err().contains("20 × 20 pixels"));
    let png = png_of(20, 20, png::ColorType::Rgba, &shades(20, 20));
    assert!(decode_png(&png, 399).is_err());
    assert!(decode_png(&jpeg, 400).is_err());
    assert!(decode_jpeg(&png, 400).is_err());
}

#[test]
fn pngs_of_grey_and_colour() {
    let mut grey = decode_png(&png_of(2, 1, png::ColorType::Grayscale, &[7, 200]), 2).unwrap();
    assert_eq!(grey.take(), [7, 7, 7, 255, 200, 200, 200, 255]);
    let mut colour = decode_png(&png_of(1, 2, png::ColorType::Rgb, &[1, 2, 3, 4, 5, 6]), 2).unwrap();
    assert_eq!(colour.take(), [1, 2, 3, 255, 4, 5, 6, 255]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn any_bytes_are_read_or_refused(bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        let _ = decode_jpeg(&bytes, 4096);
        let _ = decode_png(&bytes, 4096);
    }

    #[test]
    fn a_picture_that_was_damaged_is_read_or_refused(
        changes in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
        end in any::<prop::sample::Index>(),
    ) {
        let rgba = shades(32, 24);
        let whole = [encode_jpeg(&rgba, 32, 24, 60).unwrap(), png_of(32, 24, png::ColorType::Rgba, &rgba)];
        for mut bytes in whole {
            for (at, value) in &changes {
                let at = at.index(bytes.len());
                bytes[at] = *value;
            }
            bytes.truncate(end.index(bytes.len()) + 1);
            for read in [decode_jpeg(&bytes, 4096), decode_png(&bytes, 4096)].into_iter().flatten() {
                prop_assert!(read.width() * read.height() <= 4096);
            }
        }
    }
}
