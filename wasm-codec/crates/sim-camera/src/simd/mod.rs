//! Four-lane vectors: WebAssembly SIMD in the browser and in Node, plain arrays elsewhere.
//!
//! Both versions give the same bits: every operation here is exactly rounded IEEE 754 or integer
//! arithmetic, and nothing is fused. The native tests therefore speak for the WASM build too.

#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
mod portable;
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
mod wasm;

#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
pub use portable::{F32x4, I32x4, store_interleaved};
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
pub use wasm::{F32x4, I32x4, store_interleaved};

/// `first`, `first + 1`, `first + 2`, `first + 3` as floats.
#[inline(always)]
pub fn ramp(first: f32) -> F32x4 {
    F32x4::splat(first) + F32x4::new(0.0, 1.0, 2.0, 3.0)
}

/// A well-mixed 32-bit integer hash (two multiplications, three xor-shifts), lane by lane.
#[inline(always)]
pub fn hash(value: I32x4) -> I32x4 {
    let value = (value ^ value.shr::<16>()) * I32x4::splat(0x7feb_352d);
    let value = (value ^ value.shr::<15>()) * I32x4::splat(0x846c_a68b_u32 as i32);
    value ^ value.shr::<16>()
}

/// The same hash of one number.
pub fn hash_one(value: u32) -> u32 {
    let value = (value ^ (value >> 16)).wrapping_mul(0x7feb_352d);
    let value = (value ^ (value >> 15)).wrapping_mul(0x846c_a68b);
    value ^ (value >> 16)
}

/// The bits of a whole number below 2²² in size, as an integer plus a constant: as good as the integer for
/// hashing, and for its parity, at a third of the cost of a conversion.
#[inline(always)]
pub fn biased_bits(whole: F32x4) -> I32x4 {
    (whole + F32x4::splat(12_582_912.0)).bits()
}

/// The nearest integer to a number in 0 to 255, in the low byte; what stands above is for shifting out.
#[inline(always)]
pub fn byte_bits(value: F32x4) -> I32x4 {
    (value.min(F32x4::splat(255.0)) + F32x4::splat(8_388_608.0)).bits()
}

/// A hash of two cell indices, for textures: half as costly as `hash`, and good enough to look at.
#[inline(always)]
pub fn hash_cell(u: I32x4, v: I32x4, seed: i32) -> I32x4 {
    let mixed = u * I32x4::splat(0x1656_67b1) + v * I32x4::splat(0x27d4_eb2f) + I32x4::splat(seed);
    let mixed = (mixed ^ mixed.shr::<15>()) * I32x4::splat(0x2c1b_3c6d);
    mixed ^ mixed.shr::<13>()
}

/// Uniform in [0, 1) from the top 24 bits of a hash.
#[inline(always)]
pub fn unit(hash: I32x4) -> F32x4 {
    hash.shr::<8>().to_f32() * F32x4::splat(1.0 / 16_777_216.0)
}
