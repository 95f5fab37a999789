//! Levels to pixels.

use bytemuck::must_cast;
use wide::{i16x8, i32x4};

use super::UNZIGZAG;
use crate::lanes::{LANES, interleave, narrow, transpose};
use crate::tile::Block;

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
