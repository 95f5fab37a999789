//! Pixels to levels.

use wide::i16x8;

use super::{UNZIGZAG, ZIGZAG};
use crate::lanes::transpose;
use crate::tile::Block;

/// A share of 1 as [`i16x8::mul_scale_round`] takes it.
const fn share(part: f32) -> i16 {
    (part * 32_768.0 + 0.5) as i16
}

/// The 8-point DCT-II of eight rows, lane by lane, of which coefficient k is [`GAIN`]`[k]` times the orthonormal one: the
/// factorisation of Arai, Agui and Nakajima (Trans. IEICE E71, 1988), five multiplications.
#[inline(always)]
fn forward8(p: &[i16x8; 8]) -> [i16x8; 8] {
    let part = |of: i16x8, part: f32| of.mul_scale_round(i16x8::splat(share(part)));
    let sum = [p[0] + p[7], p[1] + p[6], p[2] + p[5], p[3] + p[4]];
    let diff = [p[0] - p[7], p[1] - p[6], p[2] - p[5], p[3] - p[4]];
    let (a, b) = (sum[0] + sum[3], sum[1] + sum[2]);
    let (d, e) = (sum[0] - sum[3], sum[1] - sum[2]);
    let half = part(d + e, FRAC_1_SQRT_2);
    // cos(π/8) and sin(π/8) turn the outer sums of neighbours.
    let (low, mid, high) = (diff[3] + diff[2], diff[2] + diff[1], diff[1] + diff[0]);
    let common = part(low - high, SIN_8);
    let low = part(low, COS_8 - SIN_8) + common;
    let high = high + part(high, COS_8 + SIN_8 - 1.0) + common;
    let mid = part(mid, FRAC_1_SQRT_2);
    let (plus, minus) = (diff[0] + mid, diff[0] - mid);
    [a + b, plus + high, d + half, minus - low, a - b, minus + low, d - half, plus - high]
}

const FRAC_1_SQRT_2: f32 = core::f32::consts::FRAC_1_SQRT_2;
const COS_8: f32 = 0.923_879_5;
const SIN_8: f32 = 0.382_683_43;

/// What [`forward8`] is more than orthonormal: √8 for k = 0, else 4 cos(kπ/16).
const GAIN: [f32; 8] =
    [2.828_427, 3.923_141, 3.695_518, 3.325_878_5, 2.828_427, 2.222_281, 1.530_733_8, 0.780_361_3];

/// What [`forward`] takes: pixels times 4 come to it times 4 once more, within ±2048.
pub const PIXEL_SCALE: i16 = 4;

/// What of the first pass's coefficient k the second one is given: so much that neither ever leaves 16 bits. No pixels of at
/// most 1 make the orthonormal coefficient larger than [`LARGEST`].
const BETWEEN: [f32; 8] = {
    let mut between = [0.0; 8];
    let mut k = 0;
    while k < 8 {
        // The second pass makes the largest times 10.06 at most: 4 cos(π/16) · 2.563.
        let share = 32_000.0 / 10.06 / (2048.0 * GAIN[k] * LARGEST[k]);
        between[k] = if share < 0.99 { share } else { 0.99 };
        k += 1;
    }
    between
};
const LARGEST: [f32; 8] =
    [2.828_427, 2.562_916, 2.613_126, 2.562_916, 2.828_427, 2.562_916, 2.613_126, 2.562_916];

/// The coefficients of a block of 8 rows of 8 pixels within ±2048, in units of [`Quantisers`]; row = horizontal frequency.
#[inline(always)]
#[must_use]
pub fn forward(rows: &[i16x8; 8]) -> [i16x8; 8] {
    let mut once = forward8(rows);
    for (row, between) in once.iter_mut().zip(BETWEEN) {
        *row = row.mul_scale_round(i16x8::splat(share(between)));
    }
    forward8(&transpose(once))
}

/// What makes levels of what [`forward`] gives, for each coefficient.
#[derive(Clone)]
pub struct Quantisers {
    step: i32,
    rows: [QuantiserRow; 8],
}

/// Coefficients are first brought to 2^k for a step, of which the dead zone is taken off; then that is divided by 2^k.
#[derive(Clone, Copy)]
struct QuantiserRow {
    scale: i16x8,
    dead: i16x8,
    rest: i16x8,
}

impl Quantisers {
    /// For a step in 1/16 of a level of 255.
    #[must_use]
    pub fn new(step: i32) -> Self {
        let rows = core::array::from_fn(|k| {
            let [mut scale, mut dead, mut rest] = [[0_i16; 8]; 3];
            for i in 0..8 {
                // Of `forward`'s units, as many as a step has.
                let units = f32::from(4 * PIXEL_SCALE) / 16.0 * step as f32 * GAIN[k] * GAIN[i] * BETWEEN[i];
                let octave = (units.log2().floor() as i32).clamp(1, 15);
                let whole = (1 << octave) as f32;
                scale[i] = (whole / units * 32_768.0 + 0.5).min(32_767.0) as i16;
                dead[i] = (dead_zone(k, i) * whole + 0.5) as i16;
                rest[i] = 1 << (15 - octave);
            }
            QuantiserRow { scale: scale.into(), dead: dead.into(), rest: rest.into() }
        });
        Self { step, rows }
    }

    /// The step that they are for.
    #[must_use]
    pub fn step(&self) -> i32 {
        self.step
    }

    /// The levels of a block's coefficients.
    #[inline(always)]
    pub fn quantise(&self, coefficients: &[i16x8; 8], block: &mut Block) {
        let mut levels = [[0_i16; 8]; 8];
        let mut last = 0;
        for (k, row) in coefficients.iter().enumerate() {
            let QuantiserRow { scale, dead, rest } = self.rows[k];
            let scaled = row.mul_scale_round(scale);
            // Towards 0, or a little beyond it: that is rounded to 0.
            let sign: i16x8 = scaled >> 15;
            let less = scaled - ((dead ^ sign) - sign);
            let row = less.mul_scale_round(rest);
            levels[k] = row.to_array();
            let some = (!row.simd_eq(i16x8::ZERO)).to_bitmask() & 0xff;
            last = last.max(LAST_OF_ROW[k][some as usize % 256]);
        }
        block.dc = levels[0][0].into();
        block.count = last.into();
        let levels = levels.as_flattened();
        for (level, place) in block.levels.iter_mut().zip(&UNZIGZAG[1..]).take(block.count) {
            *level = levels[usize::from(place & 63)];
        }
    }
}

/// Coefficients are rounded to the nearest of what is by so much less, the more the higher their frequencies: fewer bits for
/// what is mostly noise. The mean is worth its bits.
fn dead_zone(k: usize, i: usize) -> f32 {
    if k + i == 0 { 0.0 } else { 0.1 + 0.018 * (k + i) as f32 }
}

/// Of each row the last zigzag position that is in a mask of its columns.
const LAST_OF_ROW: [[u8; 256]; 8] = {
    let mut last = [[0; 256]; 8];
    let mut at = 0;
    while at < 8 * 256 {
        let (row, mask) = (at / 256, at % 256);
        let mut i = 0;
        while i < 8 {
            let position = ZIGZAG[row * 8 + i];
            if mask >> i & 1 == 1 && position > last[row][mask] {
                last[row][mask] = position;
            }
            i += 1;
        }
        at += 1;
    }
    last
};
