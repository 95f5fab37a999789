//! JPEG, written and read, and PNG, read. Pixels are R, G, B, A, row by row.
//!
//! Pictures come from others' cameras: a reader is told how large a picture may be before it looks at more than its
//! header, and refuses what is larger, broken or of another kind.

use jpeg_encoder::{ColorType, Encoder, SamplingFactor};
use wasm_bindgen::prelude::wasm_bindgen;
use zune_core::{bytestream::ZCursor, colorspace::ColorSpace, options::DecoderOptions};

/// A picture's pixels.
#[derive(Debug, PartialEq, Eq)]
#[wasm_bindgen]
pub struct Pixels {
    width: u32,
    height: u32,
    rgba: Vec<u8>,
}

#[wasm_bindgen]
impl Pixels {
    /// Pixels of a row.
    #[wasm_bindgen(getter)]
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    #[wasm_bindgen(getter)]
    pub fn height(&self) -> u32 {
        self.height
    }

    /// R, G, B, A of each; it is given away.
    pub fn take(&mut self) -> Vec<u8> {
        std::mem::take(&mut self.rgba)
    }
}

/// A baseline JPEG with half the colour resolution. Alpha is passed over.
///
/// # Errors
/// Where `rgba` is not `width × height × 4` bytes, or a side is 0.
#[wasm_bindgen]
pub fn encode_jpeg(rgba: &[u8], width: u16, height: u16, quality: u8) -> Result<Vec<u8>, String> {
    let expected = usize::from(width) * usize::from(height) * 4;
    if expected == 0 || rgba.len() != expected {
        return Err(format!("{width} × {height} pixels in {} bytes", rgba.len()));
    }
    let mut jpeg = Vec::with_capacity(expected / 16);
    let mut encoder = Encoder::new(&mut jpeg, quality.clamp(1, 100));
    encoder.set_sampling_factor(SamplingFactor::F_2_2);
    encoder.encode(rgba, width, height, ColorType::Rgba).map_err(|error| error.to_string())?;
    Ok(jpeg)
}

/// # Errors
/// Where it is no JPEG, broken, or has more than `most_pixels`.
#[wasm_bindgen]
pub fn decode_jpeg(bytes: &[u8], most_pixels: u32) -> Result<Pixels, String> {
    let options = DecoderOptions::default().set_strict_mode(false).jpeg_set_out_colorspace(ColorSpace::RGBA);
    let mut decoder = zune_jpeg::JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(|error| error.to_string())?;
    let (width, height) = decoder.dimensions().ok_or("no size")?;
    let pixels = checked(width, height, most_pixels)?;
    let rgba = decoder.decode().map_err(|error| error.to_string())?;
    if rgba.len() != pixels * 4 {
        return Err(format!("{width} × {height} pixels came as {} bytes", rgba.len()));
    }
    Ok(Pixels { width: width as u32, height: height as u32, rgba })
}

/// # Errors
/// Where it is no PNG, broken, or has more than `most_pixels`.
#[wasm_bindgen]
pub fn decode_png(bytes: &[u8], most_pixels: u32) -> Result<Pixels, String> {
    let limits = png::Limits { bytes: most_pixels as usize * 8 };
    let mut decoder = png::Decoder::new_with_limits(std::io::Cursor::new(bytes), limits);
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    decoder.set_ignore_text_chunk(true);
    let mut reader = decoder.read_info().map_err(|error| error.to_string())?;
    let (width, height) = (reader.info().width, reader.info().height);
    let pixels = checked(width as usize, height as usize, most_pixels)?;
    let mut samples = vec![0; reader.output_buffer_size().ok_or("too large")?];
    let info = reader.next_frame(&mut samples).map_err(|error| error.to_string())?;
    let count = info.color_type.samples();
    if samples.len() < pixels * count || info.bit_depth != png::BitDepth::Eight {
        return Err("its pixels are not all there".to_string());
    }
    let rgba = samples
        .chunks_exact(count)
        .take(pixels)
        .flat_map(|sample| match *sample {
            [grey] | [grey, _] => [grey, grey, grey, 255],
            [red, green, blue] | [red, green, blue, _] => [red, green, blue, 255],
            _ => [0, 0, 0, 255],
        })
        .collect();
    Ok(Pixels { width, height, rgba })
}

fn checked(width: usize, height: usize, most_pixels: u32) -> Result<usize, String> {
    match width.checked_mul(height) {
        Some(pixels) if pixels > 0 && pixels <= most_pixels as usize => Ok(pixels),
        _ => Err(format!("{width} × {height} pixels, at most {most_pixels} are taken")),
    }
}
