//! Four-lane vectors: WebAssembly SIMD in the browser and in Node, plain arrays elsewhere.
//!
//! Both versions give the same bits: every operation here is exactly rounded IEEE 754 or integer
//! arithmetic, and nothing is fused. The native tests therefore speak for the WASM build too.

#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
mod lanes {
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
}

#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
mod lanes {
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
}

pub use lanes::{F32x4, I32x4, store_interleaved};

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
