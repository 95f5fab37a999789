//! The 8 × 8 cosine transform of colour blocks, its quantisation, and the colour space.
//!
//! The decoder's side is whole numbers throughout and gives the same bits everywhere; the encoder's is single precision.

use core::f32::consts::FRAC_1_SQRT_2;

use bytemuck::must_cast;
use wide::{f32x4, f32x8, i16x8, i32x4};

use crate::lanes::{LANES, interleave, narrow, round, transpose, transpose_floats};
use crate::tile::Block;

/// Qualities: the higher the coarser.
pub const QUALITIES: usize = 32;

/// Quantiser steps in 1/16 of a level of 255 (of the orthonormal transform): 32 · 2^(i/5).
pub const STEPS: [i32; QUALITIES] = [
    32, 37, 42, 49, 56, 64, 74, 84, 97, 111, 128, 147, 169, 194, 223, 256, 294, 338, 388, 446, 512, 588, 676,
    776, 891, 1024, 1176, 1351, 1552, 1783, 2048, 2353,
];

/// Step of a plane's coefficients, in 1/16: chroma has its own.
#[must_use]
pub const fn plane_step(quality: usize, plane: usize, subsampled: bool) -> i32 {
    let step = STEPS[quality];
    match (plane, subsampled) {
        (0, _) => step,
        (1, true) => step * 13 / 16,
        (_, true) => step * 11 / 16,
        (1, false) => step * 20 / 16,
        (_, false) => step,
    }
}

/// Step of single points' colours, in 1/16.
#[must_use]
pub const fn point_step(quality: usize) -> i32 {
    let step = STEPS[quality] * 3 / 4;
    if step < 16 { 16 } else { step }
}

/// Zigzag position of each coefficient; row = horizontal frequency, column = vertical frequency.
pub const ZIGZAG: [u8; 64] = {
    let mut zigzag = [0; 64];
    let mut at = 0;
    let mut sum = 0;
    while sum < 15 {
        let mut i = 0;
        while i <= sum {
            // Odd diagonals run downwards (the vertical frequency grows), even ones upwards, as in JPEG.
            let (horizontal, vertical) = if sum % 2 == 1 { (sum - i, i) } else { (i, sum - i) };
            if horizontal < 8 && vertical < 8 {
                zigzag[horizontal * 8 + vertical] = at;
                at += 1;
            }
            i += 1;
        }
        sum += 1;
    }
    zigzag
};

/// Where each zigzag position lies.
pub const UNZIGZAG: [u8; 64] = {
    let mut places = [0; 64];
    let mut i = 0;
    while i < 64 {
        places[ZIGZAG[i] as usize] = i as u8;
        i += 1;
    }
    places
};

/// Luma and chroma of a pixel, times 4: Y, Co, Cg of R, G, B less 128.
#[inline(always)]
#[must_use]
pub fn to_ycocg(rgba: u32) -> [i32; 3] {
    let (r, g, b) = ((rgba & 255) as i32, (rgba >> 8 & 255) as i32, (rgba >> 16 & 255) as i32);
    [r + 2 * g + b - 512, 2 * (r - b), 2 * g - r - b]
}

/// [`to_ycocg`] of four pixels.
#[inline(always)]
#[must_use]
pub fn to_ycocg4(rgba: i32x4) -> [i32x4; 3] {
    let bytes = i32x4::splat(0xff_00ff);
    let red_blue: i16x8 = must_cast(rgba & bytes);
    let green: i16x8 = must_cast((rgba >> 8) & bytes);
    let green2 = green.dot(i16x8::new([2, 0, 2, 0, 2, 0, 2, 0]));
    let sum = red_blue.dot(i16x8::ONE);
    let difference = red_blue.dot(i16x8::new([2, -2, 2, -2, 2, -2, 2, -2]));
    [green2 + sum - i32x4::splat(512), difference, green2 - sum]
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

/// The 8-point DCT-II of eight rows, lane by lane, of which coefficient k is [`GAIN`]`[k]` times the orthonormal one: the
/// factorisation of Arai, Agui and Nakajima (Trans. IEICE E71, 1988), five multiplications.
#[inline(always)]
fn forward8(p: &[f32x8; 8]) -> [f32x8; 8] {
    let turn = |factor: f32| f32x8::splat(factor);
    let sum = [p[0] + p[7], p[1] + p[6], p[2] + p[5], p[3] + p[4]];
    let diff = [p[0] - p[7], p[1] - p[6], p[2] - p[5], p[3] - p[4]];
    let (a, b) = (sum[0] + sum[3], sum[1] + sum[2]);
    let (d, e) = (sum[0] - sum[3], sum[1] - sum[2]);
    let half = (d + e) * turn(FRAC_1_SQRT_2);
    // cos(π/8) and sin(π/8) turn the outer sums of neighbours.
    let (low, mid, high) = (diff[3] + diff[2], diff[2] + diff[1], diff[1] + diff[0]);
    let common = (low - high) * turn(SIN_8);
    let low = low * turn(COS_8 - SIN_8) + common;
    let high = high * turn(COS_8 + SIN_8) + common;
    let mid = mid * turn(FRAC_1_SQRT_2);
    let (plus, minus) = (diff[0] + mid, diff[0] - mid);
    [a + b, plus + high, d + half, minus - low, a - b, minus + low, d - half, plus - high]
}

const COS_8: f32 = 0.923_879_5;
const SIN_8: f32 = 0.382_683_43;

/// What [`forward8`] is more than orthonormal: √8 for k = 0, else 4 cos(kπ/16).
const GAIN: [f32; 8] =
    [2.828_427, 3.923_141, 3.695_518, 3.325_878_5, 2.828_427, 2.222_281, 1.530_733_8, 0.780_361_3];

/// The coefficients of a block of 8 rows of 8 pixels, times the product of both [`GAIN`]s; row = horizontal frequency.
#[inline(always)]
#[must_use]
pub fn forward(rows: &[f32x8; 8]) -> [f32x8; 8] {
    forward8(&transpose_floats(forward8(rows)))
}

/// What makes levels of what [`forward`] gives: for each coefficient 1 / (gain · step).
#[derive(Clone)]
pub struct Quantisers {
    step: i32,
    per_step: [f32x8; 8],
}

impl Quantisers {
    /// For a step in 1/16 of pixels that are times 4.
    #[must_use]
    pub fn new(step: i32) -> Self {
        let per_step = core::array::from_fn(|k| {
            f32x8::new(core::array::from_fn(|i| 4.0 / (step as f32 * GAIN[k] * GAIN[i])))
        });
        Self { step, per_step }
    }

    /// The step that they are for.
    #[must_use]
    pub fn step(&self) -> i32 {
        self.step
    }

    /// The levels of a block's coefficients.
    #[inline(always)]
    pub fn quantise(&self, coefficients: &[f32x8; 8], block: &mut Block) {
        let mut levels = [[0_i16; 8]; 8];
        let mut nonzero = 0_u64;
        for (k, row) in coefficients.iter().enumerate() {
            let scaled = *row * self.per_step[k];
            // Towards 0, or a little beyond it: that is rounded to 0.
            let lower = scaled - (DEAD_ZONE[k] | (scaled & f32x8::splat(-0.0)));
            let [low, high]: [f32x4; 2] = must_cast(lower);
            let limit = i16x8::splat(4095);
            let row = narrow(round(low), round(high)).min(limit).max(-limit);
            levels[k] = row.to_array();
            nonzero |= u64::from(!row.simd_eq(i16x8::ZERO).to_bitmask() & 0xff) << (k * 8);
        }
        // The mean is worth its bits.
        let mean = coefficients[0].to_array()[0] * self.per_step[0].to_array()[0];
        block.dc = (mean + 0.5_f32.copysign(mean)) as i32;
        nonzero &= !1;
        let mut count = 0;
        while nonzero != 0 {
            count = count.max(ZIGZAG[nonzero.trailing_zeros() as usize]);
            nonzero &= nonzero - 1;
        }
        block.count = usize::from(count);
        let levels = levels.as_flattened();
        for (level, place) in block.levels.iter_mut().zip(&UNZIGZAG[1..]).take(block.count) {
            *level = levels[usize::from(place & 63)];
        }
    }
}

/// Coefficients are rounded to the nearest of what is by so much less, the more the higher their frequencies: fewer bits for
/// what is mostly noise.
const DEAD_ZONE: [f32x8; 8] = {
    let mut zones = [f32x8::ZERO; 8];
    let mut k = 0;
    while k < 8 {
        let first = 0.1 + 0.018 * k as f32;
        let mut row = [first; 8];
        let mut i = 0;
        while i < 8 {
            row[i] += 0.018 * i as f32;
            i += 1;
        }
        zones[k] = f32x8::new(row);
        k += 1;
    }
    zones
};

/// One pass of the inverse transform, lane by lane: `shift` bits less, limited to 16 bits.
#[inline(always)]
fn inverse8<const SHIFT: i32>(d: &[i16x8; 8]) -> [i16x8; 8] {
    let pairs = [(0, 4), (2, 6), (1, 3), (5, 7)].map(|(a, b)| interleave(d[a], d[b]));
    let mut halves = [[i32x4::ZERO; 2]; 8];
    for half in 0..2 {
        let dot = |pair: usize, a: i16, b: i16| pairs[pair][half].dot(i16x8::new([a, b, a, b, a, b, a, b]));
        let half_step = i32x4::splat(1 << (SHIFT - 1));
        let (a, b) = (dot(0, 64, 64) + half_step, dot(0, 64, -64) + half_step);
        let (e, f) = (dot(1, 83, 36), dot(1, 36, -83));
        let even = [a + e, b + f, b - f, a - e];
        let odd = [
            dot(2, 89, 75) + dot(3, 50, 18),
            dot(2, 75, -18) + dot(3, -89, -50),
            dot(2, 50, -89) + dot(3, 18, 75),
            dot(2, 18, -50) + dot(3, 75, -89),
        ];
        for i in 0..4 {
            halves[i][half] = (even[i] + odd[i]) >> SHIFT;
            halves[7 - i][half] = (even[i] - odd[i]) >> SHIFT;
        }
    }
    halves.map(|[low, high]| narrow(low, high))
}

/// Coefficients lie within ±this, in 1/16.
const LIMIT: i32 = 32_767;

/// The pixels of a block, times 4, as 8 rows.
#[inline(always)]
#[must_use]
pub fn inverse(block: &Block, step: i32) -> [i16x8; 8] {
    let dc = block.dc.saturating_mul(step).clamp(-LIMIT, LIMIT);
    if block.count == 0 {
        let pixel = (64 * ((64 * dc + 128) >> 8) + 256) >> 9;
        return [i16x8::splat(pixel as i16); 8];
    }
    let mut coefficients = [0_i16; 64];
    coefficients[0] = dc as i16;
    for (i, level) in block.levels[..block.count.min(63)].iter().enumerate() {
        let coefficient = (i32::from(*level) * step).clamp(-LIMIT, LIMIT);
        coefficients[usize::from(UNZIGZAG[i + 1])] = coefficient as i16;
    }
    let rows: [i16x8; LANES] = must_cast(coefficients);
    inverse8::<9>(&transpose(inverse8::<8>(&rows)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_zigzag_is_jpegs() {
        // Horizontal frequency first: 0, (1,0), (0,1), (0,2), (1,1), (2,0).
        assert_eq!(UNZIGZAG[..6], [0, 8, 1, 2, 9, 16]);
        assert_eq!(UNZIGZAG[63], 63);
    }

    #[test]
    fn a_block_comes_back_within_its_step() {
        let mut seed = 1_u32;
        for quality in [0, 5, 12, 20] {
            let rows: [f32x8; 8] = core::array::from_fn(|_| {
                f32x8::from(core::array::from_fn::<f32, 8, _>(|_| {
                    seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                    (seed >> 24) as f32 * 4.0 - 512.0
                }))
            });
            let mut block = Block { dc: 0, count: 0, levels: [0; 63] };
            let step = STEPS[quality];
            Quantisers::new(step).quantise(&forward(&rows), &mut block);
            let back = inverse(&block, step);
            let mut squares = 0.0;
            for (row, back) in rows.iter().zip(back) {
                for (pixel, back) in row.to_array().iter().zip(back.to_array()) {
                    squares += (pixel / 4.0 - back as f32 / 4.0).powi(2);
                }
            }
            let error = (squares / 64.0).sqrt();
            assert!(error < 0.5 * step as f32 / 16.0 + 0.35, "quality {quality}: {error}");
        }
    }

    #[test]
    fn grey_and_primaries_survive_the_colour_space() {
        for rgba in [0xff00_0000_u32, 0xffff_ffff, 0xff00_00ff, 0xff00_ff00, 0xffff_0000, 0xff12_3456] {
            let [y, co, cg] = to_ycocg(rgba);
            let lanes = |value: i32| i16x8::splat(value as i16);
            let rgb = to_rgb(lanes(y), lanes(co), lanes(cg)).map(|channel| channel.to_array()[0] as u8);
            assert_eq!(rgb, [rgba as u8, (rgba >> 8) as u8, (rgba >> 16) as u8]);
            let four = to_ycocg4(i32x4::splat(rgba as i32)).map(|plane| plane.to_array()[3]);
            assert_eq!(four, [y, co, cg]);
        }
    }
}
