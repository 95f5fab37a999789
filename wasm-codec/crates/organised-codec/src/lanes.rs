//! What the codec needs of vectors beside plain arithmetic, in a few instructions on every machine.

use bytemuck::must_cast;
use wide::{f32x4, i16x8, i32x4};

/// Lanes of a wavefront.
pub const LANES: usize = 8;

#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
mod shuffle {
    use core::arch::wasm32::{i8x16_swizzle, i16x8_shuffle};
    use wide::{i8x16, i16x8, i32x4};

    use super::Ranks;

    #[inline(always)]
    pub fn follow(before: i16x8, lanes: i16x8) -> i16x8 {
        i16x8_shuffle::<7, 8, 9, 10, 11, 12, 13, 14>(before.into(), lanes.into()).into()
    }

    #[inline(always)]
    pub fn precede(lanes: i16x8, after: i16x8) -> i16x8 {
        i16x8_shuffle::<1, 2, 3, 4, 5, 6, 7, 8>(lanes.into(), after.into()).into()
    }

    /// For each mask of lanes the bytes of those, one after another.
    const GATHER: [[u8; 16]; 256] = {
        let mut gather = [[0; 16]; 256];
        let mut mask = 0;
        while mask < 256 {
            let (mut lane, mut at) = (0, 0);
            while lane < 8 {
                if mask >> lane & 1 == 1 {
                    gather[mask][at] = 2 * lane;
                    gather[mask][at + 1] = 2 * lane + 1;
                    at += 2;
                }
                lane += 1;
            }
            mask += 1;
        }
        gather
    };

    #[inline(always)]
    pub fn gather(lanes: i16x8, mask: u8) -> [u16; 8] {
        let bytes: i8x16 = bytemuck::must_cast(GATHER[usize::from(mask)]);
        bytemuck::must_cast::<i8x16, [u16; 8]>(i8x16_swizzle(lanes.into(), bytes.into()).into())
    }

    /// For each mask of four lanes where their bytes come from; beyond the end there are zeros.
    const EXPAND: [[u8; 16]; 16] = {
        let mut expand = [[u8::MAX; 16]; 16];
        let mut mask = 0;
        while mask < 16 {
            let (mut lane, mut at) = (0, 0);
            while lane < 4 {
                if mask >> lane & 1 == 1 {
                    expand[mask][4 * lane] = 2 * at;
                    expand[mask][4 * lane + 1] = 2 * at + 1;
                    at += 1;
                }
                lane += 1;
            }
            mask += 1;
        }
        expand
    };

    #[inline(always)]
    pub fn expand(words: [u16; 4], mask: u8) -> i32x4 {
        let words: u64 = bytemuck::must_cast(words);
        let words: i8x16 = bytemuck::must_cast([words, 0]);
        let bytes: i8x16 = bytemuck::must_cast(EXPAND[usize::from(mask % 16)]);
        bytemuck::must_cast(i8x16::from(i8x16_swizzle(words.into(), bytes.into())))
    }

    /// A look into the table: the upper bytes of what is looked up are 0, and so is what stands for that.
    #[inline(always)]
    pub fn rank(ranks: &Ranks, values: i16x8) -> i16x8 {
        let table: i8x16 = bytemuck::must_cast(ranks.table);
        i16x8::from(i8x16_swizzle(table.into(), values.min(i16x8::splat(15)).into()))
    }

    #[inline(always)]
    pub fn interleave(a: i16x8, b: i16x8) -> [i16x8; 2] {
        [
            i16x8_shuffle::<0, 8, 1, 9, 2, 10, 3, 11>(a.into(), b.into()).into(),
            i16x8_shuffle::<4, 12, 5, 13, 6, 14, 7, 15>(a.into(), b.into()).into(),
        ]
    }

    #[inline(always)]
    pub fn deinterleave(a: i16x8, b: i16x8) -> [i16x8; 2] {
        [
            i16x8_shuffle::<0, 2, 4, 6, 8, 10, 12, 14>(a.into(), b.into()).into(),
            i16x8_shuffle::<1, 3, 5, 7, 9, 11, 13, 15>(a.into(), b.into()).into(),
        ]
    }
}

#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
#[allow(unsafe_code, reason = "SSE2 intrinsics, of which every x86-64 processor has all")]
mod shuffle {
    use core::arch::x86_64::{
        _mm_or_si128, _mm_slli_si128, _mm_srli_si128, _mm_unpackhi_epi16, _mm_unpacklo_epi16,
    };
    use wide::i16x8;

    pub(crate) use super::{
        deinterleave_by_halves as deinterleave, expand_one_by_one as expand, gather_one_by_one as gather,
        rank_by_limits as rank,
    };

    #[inline(always)]
    pub fn follow(before: i16x8, lanes: i16x8) -> i16x8 {
        // SAFETY: this module is compiled for SSE2 alone; so below.
        unsafe { _mm_or_si128(_mm_slli_si128::<2>(lanes.into()), _mm_srli_si128::<14>(before.into())) }.into()
    }

    #[inline(always)]
    pub fn precede(lanes: i16x8, after: i16x8) -> i16x8 {
        unsafe { _mm_or_si128(_mm_srli_si128::<2>(lanes.into()), _mm_slli_si128::<14>(after.into())) }.into()
    }

    #[inline(always)]
    pub fn interleave(a: i16x8, b: i16x8) -> [i16x8; 2] {
        let (a, b) = (a.into(), b.into());
        unsafe { [_mm_unpacklo_epi16(a, b).into(), _mm_unpackhi_epi16(a, b).into()] }
    }
}

#[cfg(not(any(
    all(target_arch = "wasm32", target_feature = "simd128"),
    all(target_arch = "x86_64", target_feature = "sse2")
)))]
mod shuffle {
    use wide::i16x8;

    pub(crate) use super::{
        deinterleave_by_halves as deinterleave, expand_one_by_one as expand, gather_one_by_one as gather,
        rank_by_limits as rank,
    };

    #[inline(always)]
    pub fn follow(before: i16x8, lanes: i16x8) -> i16x8 {
        let (before, lanes) = (before.to_array(), lanes.to_array());
        i16x8::new(core::array::from_fn(|lane| if lane == 0 { before[7] } else { lanes[lane - 1] }))
    }

    #[inline(always)]
    pub fn precede(lanes: i16x8, after: i16x8) -> i16x8 {
        let (lanes, after) = (lanes.to_array(), after.to_array());
        i16x8::new(core::array::from_fn(|lane| if lane == 7 { after[0] } else { lanes[lane + 1] }))
    }

    #[inline(always)]
    pub fn interleave(a: i16x8, b: i16x8) -> [i16x8; 2] {
        let (a, b) = (a.to_array(), b.to_array());
        let half = |start: usize| {
            i16x8::new(core::array::from_fn(|i| if i % 2 == 0 { a[start + i / 2] } else { b[start + i / 2] }))
        };
        [half(0), half(4)]
    }
}

#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
#[inline(always)]
pub(crate) fn gather_one_by_one(lanes: i16x8, mask: u8) -> [u16; 8] {
    let lanes = lanes.to_array();
    let mut gathered = [0; 8];
    let mut at = 0;
    for (lane, value) in lanes.into_iter().enumerate() {
        gathered[at % 8] = value as u16;
        at += usize::from(mask >> lane & 1);
    }
    gathered
}

#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
#[inline(always)]
pub(crate) fn expand_one_by_one(words: [u16; 4], mask: u8) -> i32x4 {
    let mut at = 0;
    i32x4::new(core::array::from_fn(|lane| {
        let own = mask >> lane & 1;
        let word = words[at % 4] * u16::from(own);
        at += usize::from(own);
        word.into()
    }))
}

#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
#[inline(always)]
pub(crate) fn deinterleave_by_halves(a: i16x8, b: i16x8) -> [i16x8; 2] {
    let [a, b]: [i32x4; 2] = [must_cast(a), must_cast(b)];
    [narrow((a << 16) >> 16, (b << 16) >> 16), narrow(a >> 16, b >> 16)]
}

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

#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
#[inline(always)]
pub(crate) fn rank_by_limits(ranks: &Ranks, values: i16x8) -> i16x8 {
    ranks.limits.iter().fold(i16x8::ZERO, |rank, limit| rank - values.simd_gt(i16x8::splat(*limit)))
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
