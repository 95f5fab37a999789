//! Pictures of few colours: which they are, and the place of a colour among them.

use crate::contexts::{INDEX, INDEX_CONTEXTS, SYMBOLS};
use crate::encoder::Encoder;
use crate::frame::Settings;
use crate::load::Source;
use crate::sampling::{Histogram, SAMPLE_TILES};
use crate::stream::{MAX_PALETTE, StreamHeader};
use crate::tables::normalise;
use crate::tile::ColourMode;

const SLOTS: usize = 1024;
const NONE: u32 = u32::MAX;

/// From a colour to its place.
pub(crate) struct Palette {
    colours: Vec<[u8; 3]>,
    /// Colour and place, hashed by colour.
    slots: Vec<(u32, i32)>,
}

fn hash(colour: u32) -> usize {
    (colour.wrapping_mul(0x9e37_79b1) >> 22) as usize
}

impl Palette {
    pub fn new(colours: &[[u8; 3]]) -> Self {
        let mut palette = Self { colours: colours.to_vec(), slots: vec![(NONE, 0); SLOTS] };
        for (place, [r, g, b]) in (1..).zip(colours) {
            let colour = u32::from_le_bytes([*r, *g, *b, 0]);
            let mut slot = hash(colour);
            while palette.slots[slot].0 != NONE {
                slot = (slot + 1) % SLOTS;
            }
            palette.slots[slot] = (colour, place);
        }
        palette
    }

    /// The place of a colour, from 1, or of the one most like it.
    #[inline]
    pub fn index(&self, rgba: u32) -> i32 {
        let colour = rgba & 0xff_ffff;
        let mut slot = hash(colour);
        loop {
            match self.slots[slot] {
                (NONE, _) => return self.nearest(colour),
                (own, place) if own == colour => return place,
                _ => slot = (slot + 1) % SLOTS,
            }
        }
    }

    #[cold]
    fn nearest(&self, colour: u32) -> i32 {
        let [r, g, b, _] = colour.to_le_bytes();
        let distance = |own: &[u8; 3]| -> u32 {
            [r, g, b].iter().zip(own).map(|(a, b)| u32::from(a.abs_diff(*b)).pow(2)).sum()
        };
        let nearest = (1..).zip(&self.colours).min_by_key(|(_, own)| distance(own));
        nearest.map_or(1, |(place, _)| place)
    }
}

/// The colours of a frame's pixels with a finite positive depth, dark to bright, where there are no more than 256.
pub(crate) fn find_palette(source: Source<'_>) -> Option<Vec<[u8; 3]>> {
    let mut slots = [NONE; SLOTS];
    let mut colours = Vec::new();
    for pixel in 0..source.len() {
        let (depth, rgba) = source.one(pixel);
        if !(depth > 0.0 && depth.is_finite()) {
            continue;
        }
        let colour = rgba & 0xff_ffff;
        let mut slot = hash(colour);
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
        StreamHeader { palette, index_frequencies: vec![[256; SYMBOLS]; INDEX_CONTEXTS], ..header.clone() };
    let mut encoder = Encoder::new(header.clone())?;
    if source.len() != encoder.grid.width * encoder.grid.height {
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
    let cost = Encoder::new(header.clone())?.estimate(source, &mut settings);
    Some((header, cost))
}
