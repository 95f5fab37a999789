//! Shuffles of lanes in plain Rust.

use bytemuck::must_cast;
use wide::{i16x8, i32x4};

use super::numbers::narrow;
use super::ranks::Ranks;

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

#[inline(always)]
pub fn gather(lanes: i16x8, mask: u8) -> [u16; 8] {
    let lanes = lanes.to_array();
    let mut gathered = [0; 8];
    let mut at = 0;
    for (lane, value) in lanes.into_iter().enumerate() {
        gathered[at % 8] = value as u16;
        at += usize::from(mask >> lane & 1);
    }
    gathered
}

#[inline(always)]
pub fn expand(words: [u16; 4], mask: u8) -> i32x4 {
    let mut at = 0;
    i32x4::new(core::array::from_fn(|lane| {
        let own = mask >> lane & 1;
        let word = words[at % 4] * u16::from(own);
        at += usize::from(own);
        word.into()
    }))
}

#[inline(always)]
pub fn deinterleave(a: i16x8, b: i16x8) -> [i16x8; 2] {
    let [a, b]: [i32x4; 2] = [must_cast(a), must_cast(b)];
    [narrow((a << 16) >> 16, (b << 16) >> 16), narrow(a >> 16, b >> 16)]
}

#[inline(always)]
pub fn rank(ranks: &Ranks, values: i16x8) -> i16x8 {
    ranks.limits.iter().fold(i16x8::ZERO, |rank, limit| rank - values.simd_gt(i16x8::splat(*limit)))
}
