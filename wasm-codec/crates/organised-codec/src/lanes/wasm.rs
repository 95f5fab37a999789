//! Shuffles of lanes with the vector instructions of WASM.

use core::arch::wasm32::{i8x16_swizzle, i16x8_shuffle};
use wide::{i8x16, i16x8, i32x4};

use super::ranks::Ranks;

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
