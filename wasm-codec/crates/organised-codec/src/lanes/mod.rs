//! What the codec needs of vectors beside plain arithmetic, in a few instructions on every machine.

use bytemuck::must_cast;
use wide::{f32x4, i16x8, i32x4};

#[cfg_attr(target_arch = "x86_64", allow(dead_code, reason = "in part what SSE2 does better"))]
#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
mod portable;
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
mod sse2;
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
mod wasm;

#[cfg(not(any(
    all(target_arch = "wasm32", target_feature = "simd128"),
    all(target_arch = "x86_64", target_feature = "sse2")
)))]
use portable as shuffle;
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
use sse2 as shuffle;
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
use wasm as shuffle;

/// Lanes of a wavefront.
pub const LANES: usize = 8;

/// The lanes of a mask, one after another; what follows them means nothing.
#[inline(always)]
pub fn gather(lanes: i16x8, mask: u8) -> [u16; 8] {
    if mask == u8::MAX {
        return must_cast(lanes);
    }
    shuffle::gather(lanes, mask)
}

/// The lanes of a mask get the words, one after another; the others get 0.
#[inline(always)]
pub fn expand(words: [u16; 4], mask: u8) -> i32x4 {
    shuffle::expand(words, mask)
}

/// Lane k gets lane k − 1, the first one the last.
#[inline(always)]
pub fn rotate(lanes: i16x8) -> i16x8 {
    follow(lanes, lanes)
}

/// Lane k gets lane k − 1, the first one the last of those before.
#[inline(always)]
pub fn follow(before: i16x8, lanes: i16x8) -> i16x8 {
    shuffle::follow(before, lanes)
}

/// Lane k gets lane k + 1, the last one the first of those after.
#[inline(always)]
pub fn precede(lanes: i16x8, after: i16x8) -> i16x8 {
    shuffle::precede(lanes, after)
}

/// Rows become columns.
#[inline(always)]
pub fn transpose(mut rows: [i16x8; LANES]) -> [i16x8; LANES] {
    // Three perfect shuffles of the eight.
    for _ in 0..3 {
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| shuffle::interleave(rows[i], rows[i + 4]));
        rows = [a[0], a[1], b[0], b[1], c[0], c[1], d[0], d[1]];
    }
    rows
}

/// The first lanes of both in turn, then the last ones.
#[inline(always)]
pub fn interleave(a: i16x8, b: i16x8) -> [i16x8; 2] {
    shuffle::interleave(a, b)
}

/// How many of some limits a number is above. The limits are 0 to 14.
pub struct Ranks {
    #[cfg_attr(not(all(target_arch = "wasm32", target_feature = "simd128")), allow(dead_code))]
    table: [u8; 16],
    #[cfg_attr(all(target_arch = "wasm32", target_feature = "simd128"), allow(dead_code))]
    limits: &'static [i16],
}

impl Ranks {
    /// Of such limits.
    #[must_use]
    pub const fn new(limits: &'static [i16]) -> Self {
        let mut table = [0; 16];
        let mut i = 0;
        while i < 16 * limits.len() {
            let (value, limit) = (i / limits.len(), limits[i % limits.len()]);
            assert!(limit >= 0 && limit < 15);
            table[value] += (value as i16 > limit) as u8;
            i += 1;
        }
        Self { table, limits }
    }

    /// The ranks of numbers that are not negative.
    #[inline(always)]
    #[must_use]
    pub fn of(&self, values: i16x8) -> i16x8 {
        shuffle::rank(self, values)
    }
}

/// Every second lane of both, and the others: back from [`interleave`].
#[inline(always)]
pub fn deinterleave(a: i16x8, b: i16x8) -> [i16x8; 2] {
    shuffle::deinterleave(a, b)
}

/// As 16 bits, limited to what those hold.
#[inline(always)]
pub fn narrow(low: i32x4, high: i32x4) -> i16x8 {
    i16x8::from_i32x8_saturate(must_cast([low, high]))
}

/// 1.5 · 2²³: added to a float of at most 2²², it leaves the nearest whole number (of two, the even one) in the lowest bits.
const MAGIC: f32 = 12_582_912.0;

/// The nearest whole numbers, of two the even one, as 32 bits whose lower 16 are right; the numbers must lie within
/// ±2²².
#[inline(always)]
pub fn round_low(numbers: f32x4) -> i32x4 {
    must_cast(numbers + f32x4::splat(MAGIC))
}

/// The nearest whole numbers, of two the even one; the numbers must lie within ±2²².
#[inline(always)]
pub fn round(numbers: f32x4) -> i32x4 {
    round_low(numbers) - i32x4::splat(MAGIC.to_bits() as i32)
}

/// `yes` where the mask's bits are set, else `no`.
#[inline(always)]
pub fn select(mask: i16x8, yes: i16x8, no: i16x8) -> i16x8 {
    (mask & yes) | (!mask & no)
}

/// Masks of a single lane.
pub const ONLY: [i16x8; LANES] = {
    let mut masks = [i16x8::new([0; LANES]); LANES];
    let mut lane = 0;
    while lane < LANES {
        let mut bits = [0; LANES];
        bits[lane] = -1;
        masks[lane] = i16x8::new(bits);
        lane += 1;
    }
    masks
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_count_the_limits_below() {
        const RANKS: Ranks = Ranks::new(&[0, 1, 4, 14]);
        assert_eq!(
            RANKS.of(i16x8::new([0, 1, 2, 4, 5, 14, 15, i16::MAX])).to_array(),
            [0, 1, 2, 2, 3, 3, 4, 4]
        );
    }

    #[test]
    fn words_go_to_the_lanes_of_a_mask() {
        assert_eq!(expand([1, 2, 3, 0xffff], 0b1111).to_array(), [1, 2, 3, 0xffff]);
        assert_eq!(expand([0xffff, 2, 3, 4], 0b1010).to_array(), [0, 0xffff, 0, 2]);
        assert_eq!(expand([1, 2, 3, 4], 0).to_array(), [0; 4]);
    }

    #[test]
    fn lanes_turn_and_rows_become_columns() {
        let (low, high) = (i16x8::new([0, 1, 2, 3, 4, 5, 6, 7]), i16x8::new([8, 9, 10, 11, 12, 13, 14, 15]));
        assert_eq!(rotate(low).to_array(), [7, 0, 1, 2, 3, 4, 5, 6]);
        assert_eq!(follow(low, high).to_array(), [7, 8, 9, 10, 11, 12, 13, 14]);
        assert_eq!(precede(low, high).to_array(), [1, 2, 3, 4, 5, 6, 7, 8]);
        let [a, b] = interleave(low, high);
        assert_eq!(a.to_array(), [0, 8, 1, 9, 2, 10, 3, 11]);
        assert_eq!(deinterleave(a, b), [low, high]);
        let rows = core::array::from_fn(|y| i16x8::new(core::array::from_fn(|x| (10 * y + x) as i16)));
        for (x, column) in transpose(rows).iter().enumerate() {
            assert_eq!(column.to_array(), core::array::from_fn(|y| (10 * y + x) as i16));
        }
    }
}
