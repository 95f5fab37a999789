//! The 8 × 8 cosine transform of colour blocks, its quantisation, and the colour space.
//!
//! The decoder's side is whole numbers throughout and gives the same bits everywhere; the encoder's is single precision.

use wide::{f32x8, i32x8};

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

/// Back to bytes R, G, B, 255.
#[inline(always)]
#[must_use]
pub fn to_rgba(y: i32, co: i32, cg: i32) -> u32 {
    let y = y + 512 + 2;
    let clamp = |value: i32| (value >> 2).clamp(0, 255) as u32;
    clamp(y + co - cg) | clamp(y + cg) << 8 | clamp(y - co - cg) << 16 | 0xff00_0000
}

const C: [f32; 7] =
    [0.490_392_64, 0.461_939_77, 0.415_734_8, 0.353_553_38, 0.277_785_12, 0.191_341_71, 0.097_545_16];

/// The orthonormal 8-point DCT-II of eight rows, lane by lane.
#[inline(always)]
fn forward8(p: &[f32x8; 8]) -> [f32x8; 8] {
    let c = C.map(f32x8::splat);
    let sum = [p[0] + p[7], p[1] + p[6], p[2] + p[5], p[3] + p[4]];
    let diff = [p[0] - p[7], p[1] - p[6], p[2] - p[5], p[3] - p[4]];
    let (a, b) = (sum[0] + sum[3], sum[1] + sum[2]);
    let (d, e) = (sum[0] - sum[3], sum[1] - sum[2]);
    [
        (a + b) * c[3],
        diff[0] * c[0] + diff[1] * c[2] + diff[2] * c[4] + diff[3] * c[6],
        d * c[1] + e * c[5],
        diff[0] * c[2] - diff[1] * c[6] - diff[2] * c[0] - diff[3] * c[4],
        (a - b) * c[3],
        diff[0] * c[4] - diff[1] * c[0] + diff[2] * c[6] + diff[3] * c[2],
        d * c[5] - e * c[1],
        diff[0] * c[6] - diff[1] * c[4] + diff[2] * c[2] - diff[3] * c[0],
    ]
}

/// The coefficients of a block of 8 rows of 8 pixels; row = horizontal frequency.
#[inline(always)]
#[must_use]
pub fn forward(rows: &[f32x8; 8]) -> [f32x8; 8] {
    forward8(&f32x8::transpose(forward8(rows)))
}

/// How far above a half a coefficient must lie to be rounded up: fewer bits for what is mostly noise.
const ROUNDING: f32 = 0.38;

/// Quantises coefficients of pixels that were four times as large.
#[inline(always)]
pub fn quantise(coefficients: &[f32x8; 8], step: i32, block: &mut Block) {
    // Pixels are times 4, steps are in 1/16.
    let per_step = 4.0 / step as f32;
    let mut levels = [0_i32; 64];
    let mut nonzero = 0_u64;
    for (k, row) in coefficients.iter().enumerate() {
        let scaled = *row * f32x8::splat(per_step);
        let magnitude = (scaled.abs() + f32x8::splat(ROUNDING)).min(f32x8::splat(4095.0)).fast_trunc_int();
        let sign: i32x8 = bytemuck::must_cast::<f32x8, i32x8>(scaled) >> 31;
        let level = (magnitude ^ sign) - sign;
        levels[k * 8..k * 8 + 8].copy_from_slice(&level.to_array());
        let some = magnitude.simd_gt(i32x8::ZERO);
        nonzero |= u64::from(some.to_bitmask() & 0xff) << (k * 8);
    }
    // The mean is worth its bits.
    let mean = coefficients[0].to_array()[0] * per_step;
    block.dc = (mean + 0.5_f32.copysign(mean)) as i32;
    nonzero &= !1;
    block.levels = [0; 63];
    block.count = 0;
    while nonzero != 0 {
        let place = nonzero.trailing_zeros() as usize;
        nonzero &= nonzero - 1;
        let position = usize::from(ZIGZAG[place]);
        block.levels[position - 1] = levels[place] as i16;
        block.count = block.count.max(position);
    }
}

/// One pass of the inverse transform, lane by lane, before rounding.
#[inline(always)]
fn inverse8(d: &[i32x8; 8]) -> [i32x8; 8] {
    let m = |row: i32x8, factor: i32| row * i32x8::splat(factor);
    let odd = [
        m(d[1], 89) + m(d[3], 75) + m(d[5], 50) + m(d[7], 18),
        m(d[1], 75) - m(d[3], 18) - m(d[5], 89) - m(d[7], 50),
        m(d[1], 50) - m(d[3], 89) + m(d[5], 18) + m(d[7], 75),
        m(d[1], 18) - m(d[3], 50) + m(d[5], 75) - m(d[7], 89),
    ];
    let (a, b) = (m(d[0] + d[4], 64), m(d[0] - d[4], 64));
    let (e, f) = (m(d[2], 83) + m(d[6], 36), m(d[2], 36) - m(d[6], 83));
    let even = [a + e, b + f, b - f, a - e];
    [
        even[0] + odd[0],
        even[1] + odd[1],
        even[2] + odd[2],
        even[3] + odd[3],
        even[3] - odd[3],
        even[2] - odd[2],
        even[1] - odd[1],
        even[0] - odd[0],
    ]
}

/// Coefficients lie within ±this, in 1/16.
const LIMIT: i32 = 32_767;

/// The pixels of a block, times 4, as 8 rows.
#[inline(always)]
#[must_use]
pub fn inverse(block: &Block, step: i32) -> [i32x8; 8] {
    let dc = block.dc.saturating_mul(step).clamp(-LIMIT, LIMIT);
    if block.count == 0 {
        let pixel = (64 * ((64 * dc + 128) >> 8) + 256) >> 9;
        return [i32x8::splat(pixel); 8];
    }
    let mut coefficients = [0_i32; 64];
    coefficients[0] = dc;
    for (i, level) in block.levels[..block.count.min(63)].iter().enumerate() {
        coefficients[usize::from(UNZIGZAG[i + 1])] = (i32::from(*level) * step).clamp(-LIMIT, LIMIT);
    }
    let rows: [i32x8; 8] = bytemuck::must_cast(coefficients);
    let half = inverse8(&rows).map(|row| (row + i32x8::splat(128)) >> 8);
    inverse8(&i32x8::transpose(half)).map(|row| (row + i32x8::splat(256)) >> 9)
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
            quantise(&forward(&rows), step, &mut block);
            let back = inverse(&block, step);
            let mut squares = 0.0;
            for (row, back) in rows.iter().zip(back) {
                for (pixel, back) in row.to_array().iter().zip(back.to_array()) {
                    squares += (pixel / 4.0 - back as f32 / 4.0).powi(2);
                }
            }
            let error = (squares / 64.0).sqrt();
            assert!(error < 0.45 * step as f32 / 16.0 + 0.3, "quality {quality}: {error}");
        }
    }

    #[test]
    fn grey_and_primaries_survive_the_colour_space() {
        for rgba in [0xff00_0000_u32, 0xffff_ffff, 0xff00_00ff, 0xff00_ff00, 0xffff_0000, 0xff12_3456] {
            let [y, co, cg] = to_ycocg(rgba);
            assert_eq!(to_rgba(y, co, cg), rgba);
        }
    }
}
