//! Four-lane vectors with the vector instructions of WASM.

use core::arch::wasm32::*;
use core::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Sub};

#[derive(Clone, Copy)]
pub struct F32x4(v128);
/// Four 32-bit integers, also used as lane masks (all ones or all zeros).
#[derive(Clone, Copy)]
pub struct I32x4(v128);

macro_rules! binary {
    ($type:ty, $trait:ident, $name:ident, $op:ident) => {
        impl $trait for $type {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                Self($op(self.0, other.0))
            }
        }
    };
}
binary!(F32x4, Add, add, f32x4_add);
binary!(F32x4, Sub, sub, f32x4_sub);
binary!(F32x4, Mul, mul, f32x4_mul);
binary!(F32x4, Div, div, f32x4_div);
binary!(I32x4, Add, add, i32x4_add);
binary!(I32x4, Sub, sub, i32x4_sub);
binary!(I32x4, Mul, mul, i32x4_mul);
binary!(I32x4, BitAnd, bitand, v128_and);
binary!(I32x4, BitOr, bitor, v128_or);
binary!(I32x4, BitXor, bitxor, v128_xor);

impl F32x4 {
    #[inline(always)]
    pub fn splat(value: f32) -> Self {
        Self(f32x4_splat(value))
    }
    #[inline(always)]
    pub fn new(a: f32, b: f32, c: f32, d: f32) -> Self {
        Self(f32x4(a, b, c, d))
    }
    /// Reads the first four elements; panics when there are fewer.
    #[inline(always)]
    pub fn load(from: &[f32]) -> Self {
        assert!(from.len() >= 4);
        // SAFETY: four floats are there, and v128.load has no alignment requirement.
        Self(unsafe { v128_load(from.as_ptr().cast()) })
    }
    /// Writes the first four elements; panics when there are fewer.
    #[inline(always)]
    pub fn store(self, to: &mut [f32]) {
        assert!(to.len() >= 4);
        // SAFETY: as for `load`.
        unsafe { v128_store(to.as_mut_ptr().cast(), self.0) }
    }
    #[inline(always)]
    pub fn min(self, other: Self) -> Self {
        Self(f32x4_pmin(self.0, other.0))
    }
    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        Self(f32x4_pmax(self.0, other.0))
    }
    #[inline(always)]
    pub fn abs(self) -> Self {
        Self(f32x4_abs(self.0))
    }
    #[inline(always)]
    pub fn floor(self) -> Self {
        Self(f32x4_floor(self.0))
    }
    /// Nearest integer, ties to even.
    #[inline(always)]
    pub fn nearest(self) -> Self {
        Self(f32x4_nearest(self.0))
    }
    #[inline(always)]
    pub fn lt(self, other: Self) -> I32x4 {
        I32x4(f32x4_lt(self.0, other.0))
    }
    #[inline(always)]
    pub fn gt(self, other: Self) -> I32x4 {
        I32x4(f32x4_gt(self.0, other.0))
    }
    /// Lanes 1, 2, 3 of `self`, then lane 0 of `next`.
    #[inline(always)]
    pub fn shift_in(self, next: Self) -> Self {
        Self(i32x4_shuffle::<1, 2, 3, 4>(self.0, next.0))
    }
    /// Lanes 2, 3 of `self`, then lanes 0, 1 of `next`.
    #[inline(always)]
    pub fn shift_in_two(self, next: Self) -> Self {
        Self(i32x4_shuffle::<2, 3, 4, 5>(self.0, next.0))
    }
    #[inline(always)]
    pub fn first(self) -> f32 {
        f32x4_extract_lane::<0>(self.0)
    }
    /// `self` where the mask is set, `other` elsewhere.
    #[inline(always)]
    pub fn select(self, other: Self, mask: I32x4) -> Self {
        Self(v128_bitselect(self.0, other.0, mask.0))
    }
    #[inline(always)]
    pub fn bits(self) -> I32x4 {
        I32x4(self.0)
    }
}

impl I32x4 {
    #[inline(always)]
    pub fn splat(value: i32) -> Self {
        Self(i32x4_splat(value))
    }
    #[inline(always)]
    pub fn new(a: i32, b: i32, c: i32, d: i32) -> Self {
        Self(i32x4(a, b, c, d))
    }
    /// Reads the first four elements; panics when there are fewer.
    #[inline(always)]
    pub fn load(from: &[u32]) -> Self {
        assert!(from.len() >= 4);
        // SAFETY: four words are there, and v128.load has no alignment requirement.
        Self(unsafe { v128_load(from.as_ptr().cast()) })
    }
    /// Writes the first four elements; panics when there are fewer.
    #[inline(always)]
    pub fn store(self, to: &mut [u32]) {
        assert!(to.len() >= 4);
        // SAFETY: as for `load`.
        unsafe { v128_store(to.as_mut_ptr().cast(), self.0) }
    }
    #[inline(always)]
    pub fn shl<const N: u32>(self) -> Self {
        Self(i32x4_shl(self.0, N))
    }
    /// Logical shift: zeros come in from the left.
    #[inline(always)]
    pub fn shr<const N: u32>(self) -> Self {
        Self(u32x4_shr(self.0, N))
    }
    #[inline(always)]
    pub fn to_f32(self) -> F32x4 {
        F32x4(f32x4_convert_i32x4(self.0))
    }
    #[inline(always)]
    pub fn lt(self, other: Self) -> Self {
        Self(i32x4_lt(self.0, other.0))
    }
    #[inline(always)]
    pub fn select(self, other: Self, mask: Self) -> Self {
        Self(v128_bitselect(self.0, other.0, mask.0))
    }
    #[inline(always)]
    pub fn any(self) -> bool {
        v128_any_true(self.0)
    }
    /// Byte-wise `self + more - less`, saturating at each step.
    #[inline(always)]
    pub fn dither_bytes(self, more: Self, less: Self) -> Self {
        Self(u8x16_sub_sat(u8x16_add_sat(self.0, more.0), less.0))
    }
}

/// Writes a0 b0 c0 d0 a1 b1 … d3; panics when there is no room for 16 words.
#[inline(always)]
pub fn store_interleaved(a: I32x4, b: I32x4, c: I32x4, d: I32x4, to: &mut [u32]) {
    let (a, b, c, d) = (a.0, b.0, c.0, d.0);
    let ab_low = i32x4_shuffle::<0, 4, 1, 5>(a, b);
    let ab_high = i32x4_shuffle::<2, 6, 3, 7>(a, b);
    let cd_low = i32x4_shuffle::<0, 4, 1, 5>(c, d);
    let cd_high = i32x4_shuffle::<2, 6, 3, 7>(c, d);
    assert!(to.len() >= 16);
    I32x4(i64x2_shuffle::<0, 2>(ab_low, cd_low)).store(&mut to[0..4]);
    I32x4(i64x2_shuffle::<1, 3>(ab_low, cd_low)).store(&mut to[4..8]);
    I32x4(i64x2_shuffle::<0, 2>(ab_high, cd_high)).store(&mut to[8..12]);
    I32x4(i64x2_shuffle::<1, 3>(ab_high, cd_high)).store(&mut to[12..16]);
}
