//! Conversions between floats, 32-bit and 16-bit integers.

use bytemuck::must_cast;
use wide::{f32x4, i16x8, i32x4};

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
