//! The place of a colour among the few of a palette.

use crate::tile::TILE;

/// Of 256 colours, so many slots part all with one factor in eight.
pub(crate) const SLOTS: usize = 1 << 14;
const TRIES: usize = 64;
/// The bits of a colour.
pub(crate) const COLOUR: u32 = 0xff_ffff;

/// From a colour to its place.
pub(crate) struct Palette {
    colours: Vec<[u8; 3]>,
    /// By hash: a colour and, above it, its place from 0.
    slots: Box<[u32; SLOTS]>,
    /// What is in slots without a colour of their own: the first colour, which is found all the same.
    free: u32,
    factor: u32,
    /// Every colour is in the slot of its hash.
    perfect: bool,
}

pub(crate) fn hash(colour: u32, factor: u32) -> usize {
    (colour.wrapping_mul(factor) >> (32 - SLOTS.ilog2())) as usize
}

/// 2³² less its golden section: it spreads what lies evenly.
pub(crate) const GOLDEN: u32 = 0x9e37_79b1;

impl Palette {
    pub fn new(colours: &[[u8; 3]]) -> Self {
        let packed = |(place, [r, g, b]): (u8, &[u8; 3])| u32::from_le_bytes([*r, *g, *b, place]);
        let free = colours.first().map_or(0, |first| packed((0, first)));
        let mut palette = Self {
            colours: colours.to_vec(),
            slots: Box::new([free; SLOTS]),
            free,
            factor: 1,
            perfect: false,
        };
        // For most palettes one of a few factors parts all colours.
        for _ in 0..TRIES {
            palette.factor = palette.factor.wrapping_mul(GOLDEN);
            palette.slots.fill(free);
            palette.perfect = true;
            for own in (0..=u8::MAX).zip(colours).skip(1).map(packed) {
                let mut slot = hash(own & COLOUR, palette.factor);
                while palette.slots[slot] != free {
                    palette.perfect = false;
                    slot = (slot + 1) % SLOTS;
                }
                palette.slots[slot] = own;
            }
            palette.perfect &= palette.slots[hash(free & COLOUR, palette.factor)] == free;
            if palette.perfect {
                break;
            }
        }
        palette
    }

    /// The places of a row's colours, where they are valid.
    #[inline(always)]
    pub fn places(&self, colours: &[u32; TILE], valid: u16, places: &mut [i16; TILE]) {
        if self.perfect && valid == u16::MAX {
            let mut other = 0;
            for (place, rgba) in places.iter_mut().zip(colours) {
                let own = self.slots[hash(rgba & COLOUR, self.factor) % SLOTS];
                other |= own ^ rgba;
                *place = (own >> 24) as i16 + 1;
            }
            if other & COLOUR == 0 {
                return;
            }
        }
        for (x, (place, rgba)) in places.iter_mut().zip(colours).enumerate() {
            if valid >> x & 1 == 1 {
                *place = self.place(*rgba);
            }
        }
    }

    /// The place of a colour, from 1, or of the one most like it.
    #[inline]
    fn place(&self, rgba: u32) -> i16 {
        let colour = rgba & COLOUR;
        let mut slot = hash(colour, self.factor);
        loop {
            let own = self.slots[slot % SLOTS];
            if own & COLOUR == colour {
                return (own >> 24) as i16 + 1;
            }
            if own == self.free {
                return self.nearest(colour);
            }
            slot += 1;
        }
    }

    #[cold]
    fn nearest(&self, colour: u32) -> i16 {
        let [r, g, b, _] = colour.to_le_bytes();
        let distance = |own: &[u8; 3]| -> u32 {
            [r, g, b].iter().zip(own).map(|(a, b)| u32::from(a.abs_diff(*b)).pow(2)).sum()
        };
        let nearest = (1..).zip(&self.colours).min_by_key(|(_, own)| distance(own));
        nearest.map_or(1, |(place, _)| place)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places(palette: &Palette, colours: &[u32; TILE], valid: u16) -> [i16; TILE] {
        let mut places = [0; TILE];
        palette.places(colours, valid, &mut places);
        places
    }

    #[test]
    fn colours_find_their_places() {
        let greys: Vec<[u8; 3]> = (0..=255).map(|v| [v; 3]).collect();
        let mut seed = 1_u32;
        let mut random = || {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (seed >> 24) as u8
        };
        let many: Vec<[u8; 3]> = (0..=255).map(|v| [random(), random(), v]).collect();
        for colours in [greys, many, vec![[7, 8, 9]], vec![[0; 3], [255; 3]]] {
            let palette = Palette::new(&colours);
            assert!(palette.perfect, "{} colours", colours.len());
            for (place, [r, g, b]) in (1..).zip(&colours) {
                let row = [u32::from_le_bytes([*r, *g, *b, 200]); TILE];
                assert_eq!(places(&palette, &row, u16::MAX), [place; TILE]);
                assert_eq!(places(&palette, &row, 5)[..4], [place, 0, place, 0]);
            }
        }
    }

    #[test]
    fn a_colour_that_is_not_there_takes_the_nearest() {
        let palette = Palette::new(&[[10, 10, 10], [100, 100, 100], [250, 0, 0]]);
        let mut row = [u32::from_le_bytes([10, 10, 10, 0]); TILE];
        row[3] = u32::from_le_bytes([90, 95, 100, 0]);
        row[4] = u32::from_le_bytes([255, 9, 1, 0]);
        assert_eq!(places(&palette, &row, u16::MAX)[..6], [1, 1, 1, 2, 3, 1]);
    }

    #[test]
    fn colours_that_share_a_slot_are_found_too() {
        let mut palette = Palette::new(&[[1, 2, 3], [4, 5, 6], [7, 8, 9]]);
        let own: Vec<u32> = palette.slots.iter().copied().filter(|own| *own != palette.free).collect();
        // As if all of them had the same hash.
        palette.slots.fill(palette.free);
        palette.perfect = false;
        let slot = hash(own[0] & COLOUR, palette.factor);
        let other = hash(own[1] & COLOUR, palette.factor);
        palette.slots[other] = own[0];
        palette.slots[(other + 1) % SLOTS] = own[1];
        palette.slots[slot] = own[0];
        assert_eq!(palette.place(own[1] & COLOUR), (own[1] >> 24) as i16 + 1);
    }
}
