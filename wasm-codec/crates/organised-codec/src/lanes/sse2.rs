//! Shuffles of lanes with SSE2, which every x86-64 processor has.
#![allow(
    unsafe_code,
    reason = "SSE2 intrinsics: this module is compiled for processors alone that have them"
)]

use core::arch::x86_64::{
    _mm_or_si128, _mm_slli_si128, _mm_srli_si128, _mm_unpackhi_epi16, _mm_unpacklo_epi16,
};
use wide::i16x8;

pub use super::portable::{deinterleave, expand, gather, rank};

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
