//! What the codec needs of vectors beside plain arithmetic, in a few instructions on every machine.

use bytemuck::must_cast;
use wide::{i16x8, i32x4};

mod numbers;
#[cfg_attr(target_arch = "x86_64", allow(dead_code, reason = "in part what SSE2 does better"))]
#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
mod portable;
mod ranks;
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

pub use numbers::{narrow, round, round_low};
pub use ranks::Ranks;

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

/// The ranks of numbers that are not negative.
#[inline(always)]
pub fn rank(ranks: &Ranks, values: i16x8) -> i16x8 {
    shuffle::rank(ranks, values)
}

/// Every second lane of both, and the others: back from [`interleave`].
#[inline(always)]
pub fn deinterleave(a: i16x8, b: i16x8) -> [i16x8; 2] {
    shuffle::deinterleave(a, b)
}

/// `yes` where the mask's bits are set, else `no`.
#[inline(always)]
pub fn select(mask: i16x8, yes: i16x8, no: i16x8) -> i16x8 {
    (mask & yes) | (!mask & no)
}

/// Of a row of 16 bits the left (0) or the right half (1): all bits of lane k where the half's bit k is set.
#[inline(always)]
pub fn row_mask(row: u16, half: usize) -> i16x8 {
    const BITS: [i16x8; 2] = [
        i16x8::new([1, 2, 4, 8, 16, 32, 64, 128]),
        i16x8::new([1 << 8, 2 << 8, 4 << 8, 8 << 8, 16 << 8, 32 << 8, 64 << 8, i16::MIN]),
    ];
    (i16x8::splat(row as i16) & BITS[half]).simd_eq(BITS[half])
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
            rank(&RANKS, i16x8::new([0, 1, 2, 4, 5, 14, 15, i16::MAX])).to_array(),
            [0, 1, 2, 2, 3, 3, 4, 4]
        );
    }

    #[test]
    fn a_row_s_bits_become_lanes() {
        let row = 0b1000_0001_0100_0010;
        assert_eq!(row_mask(row, 0).to_array(), [0, -1, 0, 0, 0, 0, -1, 0]);
        assert_eq!(row_mask(row, 1).to_array(), [-1, 0, 0, 0, 0, 0, 0, -1]);
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
