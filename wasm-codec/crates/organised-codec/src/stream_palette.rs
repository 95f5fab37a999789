//! A stream's palette, and frequencies that suit it, by a frame of few colours.

use crate::contexts::{INDEX, INDEX_CONTEXTS, SYMBOLS};
use crate::frame::Settings;
use crate::histogram::{Histogram, SAMPLE_TILES};
use crate::load::Source;
use crate::palette::{COLOUR, GOLDEN, SLOTS, hash};
use crate::sampling::SamplingEncoder;
use crate::stream::{MAX_PALETTE, StreamHeader};
use crate::tables::{EVEN, normalise};
use crate::tile::ColourMode;

/// No colour: those have 24 bits.
const NONE: u32 = u32::MAX;

/// The colours of a frame's pixels with a finite positive depth, dark to bright, where there are no more than 256.
fn find_palette(source: Source<'_>) -> Option<Vec<[u8; 3]>> {
    let mut slots = vec![NONE; SLOTS];
    let mut colours = Vec::new();
    for pixel in 0..source.len() {
        let (depth, rgba) = source.one(pixel);
        if !(depth > 0.0 && depth.is_finite()) {
            continue;
        }
        let colour = rgba & COLOUR;
        let mut slot = hash(colour, GOLDEN);
        while slots[slot] != NONE && slots[slot] != colour {
            slot = (slot + 1) % SLOTS;
        }
        if slots[slot] == NONE {
            if colours.len() == MAX_PALETTE {
                return None;
            }
            slots[slot] = colour;
            let [r, g, b, _] = colour.to_le_bytes();
            colours.push([r, g, b]);
        }
    }
    colours.sort_by_key(|[r, g, b]| (u32::from(*r) + 2 * u32::from(*g), *b));
    Some(colours)
}

/// A header with the palette of a frame of few colours, and with frequencies that suit it. `None` where there are more than
/// 256, or none.
#[must_use]
pub fn with_palette(header: StreamHeader, source: Source<'_>) -> Option<StreamHeader> {
    let palette = find_palette(source).filter(|palette| !palette.is_empty())?;
    // Some cameras' brightest pixels come out black: there the darkest colour is best put after the brightest.
    let mut wrapped = palette.clone();
    wrapped.rotate_left(1);
    let plain = trained(&header, palette, source)?;
    let wrapped = trained(&header, wrapped, source)?;
    Some(if plain.1 <= wrapped.1 { plain.0 } else { wrapped.0 })
}

/// With frequencies for a palette, and what the frame then costs.
fn trained(header: &StreamHeader, palette: Vec<[u8; 3]>, source: Source<'_>) -> Option<(StreamHeader, f32)> {
    let mut header =
        StreamHeader { palette, index_frequencies: vec![EVEN; INDEX_CONTEXTS], ..header.clone() };
    let mut encoder = SamplingEncoder::new(&header)?;
    if !encoder.takes(source) {
        return None;
    }
    let mut histogram = Histogram::default();
    let mut settings = Settings { mode: ColourMode::Palette, ..Settings::default() };
    encoder.count(source, &settings, SAMPLE_TILES, 1, &mut histogram);
    let (contexts, _) = histogram.counts[INDEX * SYMBOLS..].as_chunks::<SYMBOLS>();
    for (own, counts) in header.index_frequencies.iter_mut().zip(contexts) {
        // What did not occur may yet, in the next frames.
        *own = normalise(&counts.map(|count| f64::from(count) + 0.5));
    }
    let cost = SamplingEncoder::new(&header)?.estimate(source, &mut settings);
    Some((header, cost))
}
