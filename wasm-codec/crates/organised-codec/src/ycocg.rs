//! The colour space of the transform: luma and two chromas, without loss.

use bytemuck::must_cast;
use wide::i16x8;

use crate::lanes::deinterleave;

/// Luma and chroma of a pixel, times 4: Y, Co, Cg of R, G, B less 128.
#[inline(always)]
#[must_use]
pub fn to_ycocg(rgba: u32) -> [i32; 3] {
    let (r, g, b) = ((rgba & 255) as i32, (rgba >> 8 & 255) as i32, (rgba >> 16 & 255) as i32);
    [r + 2 * g + b - 512, 2 * (r - b), 2 * g - r - b]
}

/// [`to_ycocg`] of eight pixels.
#[inline(always)]
#[must_use]
pub fn to_ycocg8(rgba: [u32; 8]) -> [i16x8; 3] {
    let [low, high]: [i16x8; 2] = must_cast(rgba);
    let [red_green, blue] = deinterleave(low, high);
    let byte = i16x8::splat(255);
    let (r, g, b) = (red_green & byte, (red_green >> 8) & byte, blue & byte);
    let (sum, difference) = (r + b, r - b);
    let green = g + g;
    [green + sum - i16x8::splat(512), difference + difference, green - sum]
}

/// R, G and B of eight pixels, each 0 to 255. Sums are limited to 16 bits.
#[inline(always)]
#[must_use]
pub fn to_rgb(y: i16x8, co: i16x8, cg: i16x8) -> [i16x8; 3] {
    let y = y.saturating_add(i16x8::splat(514));
    let rest = y.saturating_sub(cg);
    [rest.saturating_add(co), y.saturating_add(cg), rest.saturating_sub(co)]
        .map(|channel: i16x8| -> i16x8 { channel >> 2 })
        .map(|channel| channel.max(i16x8::ZERO).min(i16x8::splat(255)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grey_and_primaries_survive_the_colour_space() {
        for rgba in [0xff00_0000_u32, 0xffff_ffff, 0xff00_00ff, 0xff00_ff00, 0xffff_0000, 0xff12_3456] {
            let [y, co, cg] = to_ycocg(rgba);
            let lanes = |value: i32| i16x8::splat(value as i16);
            let rgb = to_rgb(lanes(y), lanes(co), lanes(cg)).map(|channel| channel.to_array()[0] as u8);
            assert_eq!(rgb, [rgba as u8, (rgba >> 8) as u8, (rgba >> 16) as u8]);
            let eight = to_ycocg8([rgba; 8]).map(|plane| i32::from(plane.to_array()[3]));
            assert_eq!(eight, [y, co, cg]);
        }
    }
}
