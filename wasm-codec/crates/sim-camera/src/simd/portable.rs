//! Four-lane vectors as plain arrays.

use core::array::from_fn;
use core::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Sub};

#[derive(Clone, Copy)]
pub struct F32x4([f32; 4]);
/// Four 32-bit integers, also used as lane masks (all ones or all zeros).
#[derive(Clone, Copy)]
pub struct I32x4([i32; 4]);

macro_rules! binary {
    ($type:ty, $trait:ident, $name:ident, $op:expr) => {
        impl $trait for $type {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                Self(from_fn(|i| $op(self.0[i], other.0[i])))
            }
        }
    };
}
binary!(F32x4, Add, add, |a: f32, b: f32| a + b);
binary!(F32x4, Sub, sub, |a: f32, b: f32| a - b);
binary!(F32x4, Mul, mul, |a: f32, b: f32| a * b);
binary!(F32x4, Div, div, |a: f32, b: f32| a / b);
binary!(I32x4, Add, add, i32::wrapping_add);
binary!(I32x4, Sub, sub, i32::wrapping_sub);
binary!(I32x4, Mul, mul, i32::wrapping_mul);
binary!(I32x4, BitAnd, bitand, |a: i32, b: i32| a & b);
binary!(I32x4, BitOr, bitor, |a: i32, b: i32| a | b);
binary!(I32x4, BitXor, bitxor, |a: i32, b: i32| a ^ b);

#[inline(always)]
fn mask(yes: bool) -> i32 {
    -i32::from(yes)
}

impl F32x4 {
    #[inline(always)]
    pub fn splat(value: f32) -> Self {
        Self([value; 4])
    }
    #[inline(always)]
    pub fn new(a: f32, b: f32, c: f32, d: f32) -> Self {
        Self([a, b, c, d])
    }
    /// Reads the first four elements; panics when there are fewer.
    #[inline(always)]
    pub fn load(from: &[f32]) -> Self {
        Self([from[0], from[1], from[2], from[3]])
    }
    /// Writes the first four elements; panics when there are fewer.
    #[inline(always)]
    pub fn store(self, to: &mut [f32]) {
        to[..4].copy_from_slice(&self.0);
    }
    #[inline(always)]
    pub fn min(self, other: Self) -> Self {
        Self(from_fn(|i| if other.0[i] < self.0[i] { other.0[i] } else { self.0[i] }))
    }
    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        Self(from_fn(|i| if self.0[i] < other.0[i] { other.0[i] } else { self.0[i] }))
    }
    #[inline(always)]
    pub fn abs(self) -> Self {
        Self(self.0.map(f32::abs))
    }
    #[inline(always)]
    pub fn floor(self) -> Self {
        Self(self.0.map(f32::floor))
    }
    /// Nearest integer, ties to even.
    #[inline(always)]
    pub fn nearest(self) -> Self {
        Self(self.0.map(f32::round_ties_even))
    }
    #[inline(always)]
    pub fn lt(self, other: Self) -> I32x4 {
        I32x4(from_fn(|i| mask(self.0[i] < other.0[i])))
    }
    #[inline(always)]
    pub fn gt(self, other: Self) -> I32x4 {
        I32x4(from_fn(|i| mask(self.0[i] > other.0[i])))
    }
    /// Lanes 1, 2, 3 of `self`, then lane 0 of `next`.
    #[inline(always)]
    pub fn shift_in(self, next: Self) -> Self {
        Self([self.0[1], self.0[2], self.0[3], next.0[0]])
    }
    /// Lanes 2, 3 of `self`, then lanes 0, 1 of `next`.
    #[inline(always)]
    pub fn shift_in_two(self, next: Self) -> Self {
        Self([self.0[2], self.0[3], next.0[0], next.0[1]])
    }
    #[inline(always)]
    pub fn first(self) -> f32 {
        self.0[0]
    }
    /// `self` where the mask is set, `other` elsewhere.
    #[inline(always)]
    pub fn select(self, other: Self, mask: I32x4) -> Self {
        Self(from_fn(|i| if mask.0[i] != 0 { self.0[i] } else { other.0[i] }))
    }
    #[inline(always)]
    pub fn bits(self) -> I32x4 {
        I32x4(self.0.map(|value| value.to_bits() as i32))
    }
}

impl I32x4 {
    #[inline(always)]
    pub fn splat(value: i32) -> Self {
        Self([value; 4])
    }
    #[inline(always)]
    pub fn new(a: i32, b: i32, c: i32, d: i32) -> Self {
        Self([a, b, c, d])
    }
    /// Reads the first four elements; panics when there are fewer.
    #[inline(always)]
    pub fn load(from: &[u32]) -> Self {
        Self([from[0] as i32, from[1] as i32, from[2] as i32, from[3] as i32])
    }
    /// Writes the first four elements; panics when there are fewer.
    #[inline(always)]
    pub fn store(self, to: &mut [u32]) {
        to[..4].copy_from_slice(&self.0.map(|value| value as u32));
    }
    #[inline(always)]
    pub fn shl<const N: u32>(self) -> Self {
        Self(self.0.map(|value| value << N))
    }
    /// Logical shift: zeros come in from the left.
    #[inline(always)]
    pub fn shr<const N: u32>(self) -> Self {
        Self(self.0.map(|value| ((value as u32) >> N) as i32))
    }
    #[inline(always)]
    pub fn to_f32(self) -> F32x4 {
        F32x4(self.0.map(|value| value as f32))
    }
    #[inline(always)]
    pub fn lt(self, other: Self) -> Self {
        Self(from_fn(|i| mask(self.0[i] < other.0[i])))
    }
    #[inline(always)]
    pub fn select(self, other: Self, mask: Self) -> Self {
        Self(from_fn(|i| if mask.0[i] != 0 { self.0[i] } else { other.0[i] }))
    }
    #[inline(always)]
    pub fn any(self) -> bool {
        self.0.iter().any(|&value| value != 0)
    }
    /// Byte-wise `self + more - less`, saturating at each step.
    #[inline(always)]
    pub fn dither_bytes(self, more: Self, less: Self) -> Self {
        Self(from_fn(|i| {
            let (value, more, less) =
                (self.0[i].to_le_bytes(), more.0[i].to_le_bytes(), less.0[i].to_le_bytes());
            i32::from_le_bytes(from_fn(|b| value[b].saturating_add(more[b]).saturating_sub(less[b])))
        }))
    }
}

/// Writes a0 b0 c0 d0 a1 b1 … d3; panics when there is no room for 16 words.
#[inline(always)]
pub fn store_interleaved(a: I32x4, b: I32x4, c: I32x4, d: I32x4, to: &mut [u32]) {
    for lane in 0..4 {
        let point = [a.0[lane], b.0[lane], c.0[lane], d.0[lane]];
        to[4 * lane..4 * lane + 4].copy_from_slice(&point.map(|value| value as u32));
    }
}
