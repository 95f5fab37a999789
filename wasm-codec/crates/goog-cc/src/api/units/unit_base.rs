// UnitBase is a superclass in C++.
// The closest we can do in Rust is a macro, as traits don't support const.
macro_rules! unit_base {
    ($ty:ident) => {
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
        pub struct $ty(i64);

        impl $ty {
            pub const fn zero() -> Self {
                Self(0)
            }

            pub const fn plus_infinity() -> Self {
                Self(i64::MAX)
            }

            pub const fn minus_infinity() -> Self {
                Self(i64::MIN)
            }

            pub const fn is_zero(&self) -> bool {
                self.0 == 0
            }

            pub const fn is_finite(&self) -> bool {
                !self.is_infinite()
            }

            pub const fn is_infinite(&self) -> bool {
                self.0 == i64::MAX || self.0 == i64::MIN
            }

            pub const fn is_plus_infinity(&self) -> bool {
                self.0 == i64::MAX
            }

            pub const fn is_minus_infinity(&self) -> bool {
                self.0 == i64::MIN
            }

            pub const fn round_to(&self, resolution: Self) -> Self {
                assert!(self.is_finite());
                assert!(resolution.is_finite());
                assert!(resolution.0 > 0);
                Self::from_value(((self.0 + resolution.0 / 2) / resolution.0) * resolution.0)
            }

            pub const fn round_up_to(&self, resolution: Self) -> Self {
                assert!(self.is_finite());
                assert!(resolution.is_finite());
                assert!(resolution.0 > 0);
                Self::from_value(((self.0 + resolution.0 - 1) / resolution.0) * resolution.0)
            }

            pub const fn round_down_to(&self, resolution: Self) -> Self {
                assert!(self.is_finite());
                assert!(resolution.is_finite());
                assert!(resolution.0 > 0);
                Self::from_value((self.0 / resolution.0) * resolution.0)
            }

            #[allow(dead_code)]
            const fn from_fraction(denominator: i64, value: i64) -> Self {
                assert!(denominator >= 0);
                Self::from_value(value * denominator)
            }

            #[allow(dead_code)]
            fn from_fraction_float(denominator: f64, value: f64) -> Self {
                Self::from_value_float(value * denominator)
            }

            #[allow(dead_code)]
            const fn to_fraction(self, denominator: i64) -> i64 {
                self.divide_round_to_nearest(denominator)
            }

            const fn divide_round_to_nearest(&self, d: i64) -> i64 {
                assert!(d >= 0);

                let v = self.to_value();
                let mut result = v / d;
                let remainder = v % d;

                if remainder.abs() * 2 >= d.abs() {
                    if (v < 0) != (d < 0) {
                        result -= 1
                    } else {
                        result += 1
                    }
                }
                result
            }

            #[allow(dead_code)]
            fn to_fraction_float(self, denominator: f64) -> f64 {
                assert!(denominator >= 0.0);
                self.to_value_float() / denominator
            }

            #[allow(dead_code)]
            const fn to_fraction_or(self, denominator: i64, fallback_value: i64) -> i64 {
                assert!(denominator >= 0);
                if self.is_finite() {
                    self.divide_round_to_nearest(denominator)
                } else {
                    fallback_value
                }
            }

            pub const fn to_multiple(self, factor: i64) -> i64 {
                assert!(factor >= 0);
                self.to_value() * factor
            }

            pub fn to_multiple_float(self, factor: f64) -> f64 {
                assert!(factor >= 0.0);
                self.to_value_float() * factor
            }

            const fn from_value(value: i64) -> Self {
                assert!(value != i64::MAX && value != i64::MIN);
                if Self::ONE_SIDED {
                    assert!(value >= 0);
                }

                Self(value)
            }

            fn from_value_float(value: f64) -> Self {
                assert!(!value.is_nan());

                if value == f64::INFINITY {
                    return Self::plus_infinity();
                }

                if Self::ONE_SIDED {
                    assert!(value >= 0.0);
                }

                if value == f64::NEG_INFINITY {
                    Self::minus_infinity()
                } else {
                    Self(value as i64)
                }
            }

            const fn to_value(self) -> i64 {
                assert!(self.is_finite());
                self.0
            }

            #[allow(dead_code)]
            const fn to_value_or(self, fallback_value: i64) -> i64 {
                if self.is_finite() {
                    self.0
                } else {
                    fallback_value
                }
            }

            const fn to_value_float(self) -> f64 {
                if self.is_plus_infinity() {
                    f64::INFINITY
                } else if self.is_minus_infinity() {
                    f64::NEG_INFINITY
                } else {
                    self.0 as f64
                }
            }
        }
    };
}

macro_rules! relative_unit {
    ($ty:ident) => {
        crate::api::units::unit_base!($ty);

        impl $ty {
            pub fn clamp_mut(&mut self, min_value: Self, max_value: Self) {
                *self = Self(self.0.max(min_value.0).min(max_value.0));
            }
        }

        impl ::std::ops::Add for $ty {
            type Output = Self;

            fn add(self, rhs: Self) -> Self::Output {
                if self.is_plus_infinity() || rhs.is_plus_infinity() {
                    assert!(!self.is_minus_infinity());
                    assert!(!rhs.is_minus_infinity());
                    return Self::plus_infinity();
                } else if self.is_minus_infinity() || rhs.is_minus_infinity() {
                    assert!(!self.is_plus_infinity());
                    assert!(!rhs.is_plus_infinity());
                    return Self::minus_infinity();
                }
                Self::from_value(self.to_value() + rhs.to_value())
            }
        }

        impl ::std::ops::Sub for $ty {
            type Output = Self;

            fn sub(self, rhs: Self) -> Self::Output {
                if self.is_plus_infinity() || rhs.is_minus_infinity() {
                    assert!(!self.is_minus_infinity());
                    assert!(!rhs.is_plus_infinity());
                    return Self::plus_infinity();
                } else if self.is_minus_infinity() || rhs.is_plus_infinity() {
                    assert!(!self.is_plus_infinity());
                    assert!(!rhs.is_minus_infinity());
                    return Self::minus_infinity();
                }
                Self::from_value(self.to_value() - rhs.to_value())
            }
        }

        impl ::std::ops::AddAssign for $ty {
            fn add_assign(&mut self, rhs: Self) {
                *self = Self::from_value(self.to_value() + rhs.to_value());
            }
        }

        impl ::std::ops::SubAssign for $ty {
            fn sub_assign(&mut self, rhs: Self) {
                *self = Self::from_value(self.to_value() - rhs.to_value());
            }
        }

        impl ::std::ops::Div for $ty {
            type Output = f64;

            fn div(self, rhs: Self) -> Self::Output {
                self.to_value_float() / rhs.to_value_float()
            }
        }

        impl ::std::ops::Div<f64> for $ty {
            type Output = Self;

            fn div(self, rhs: f64) -> Self::Output {
                Self::from_value_float((self.to_value_float() / rhs).round())
            }
        }

        impl ::std::ops::Div<i64> for $ty {
            type Output = Self;

            fn div(self, rhs: i64) -> Self::Output {
                Self::from_value(self.to_value() / rhs)
            }
        }

        impl ::std::ops::Mul<isize> for $ty {
            type Output = Self;

            fn mul(self, rhs: isize) -> Self::Output {
                Self::from_value(self.to_value() * rhs as i64)
            }
        }

        impl ::std::ops::Mul<i64> for $ty {
            type Output = Self;

            fn mul(self, rhs: i64) -> Self::Output {
                Self::from_value(self.to_value() * rhs)
            }
        }

        impl ::std::ops::Mul<i32> for $ty {
            type Output = Self;

            fn mul(self, rhs: i32) -> Self::Output {
                Self::from_value(self.to_value() * rhs as i64)
            }
        }

        impl ::std::ops::Mul<i16> for $ty {
            type Output = Self;

            fn mul(self, rhs: i16) -> Self::Output {
                Self::from_value(self.to_value() * rhs as i64)
            }
        }

        impl ::std::ops::Mul<usize> for $ty {
            type Output = Self;

            fn mul(self, rhs: usize) -> Self::Output {
                Self::from_value(self.to_value() * i64::try_from(rhs).unwrap())
            }
        }

        impl ::std::ops::Mul<u64> for $ty {
            type Output = Self;

            fn mul(self, rhs: u64) -> Self::Output {
                Self::from_value(self.to_value() * i64::try_from(rhs).unwrap())
            }
        }

        impl ::std::ops::Mul<u32> for $ty {
            type Output = Self;

            fn mul(self, rhs: u32) -> Self::Output {
                Self::from_value(self.to_value() * i64::try_from(rhs).unwrap())
            }
        }

        impl ::std::ops::Mul<u16> for $ty {
            type Output = Self;

            fn mul(self, rhs: u16) -> Self::Output {
                Self::from_value(self.to_value() * i64::try_from(rhs).unwrap())
            }
        }

        impl ::std::ops::Mul<f64> for $ty {
            type Output = Self;

            fn mul(self, rhs: f64) -> Self::Output {
                Self::from_value_float((self.to_value_float() * rhs).round())
            }
        }

        impl ::std::ops::Mul<f32> for $ty {
            type Output = Self;

            fn mul(self, rhs: f32) -> Self::Output {
                Self::from_value_float((self.to_value_float() * rhs as f64).round())
            }
        }

        impl ::std::ops::Neg for $ty {
            type Output = Self;

            fn neg(self) -> Self::Output {
                if self.is_plus_infinity() {
                    Self::minus_infinity()
                } else if self.is_minus_infinity() {
                    Self::plus_infinity()
                } else {
                    Self::from_value(-self.to_value())
                }
            }
        }

        impl ::std::ops::Mul<$ty> for isize {
            type Output = $ty;

            fn mul(self, rhs: $ty) -> Self::Output {
                rhs * self
            }
        }

        impl ::std::ops::Mul<$ty> for i64 {
            type Output = $ty;

            fn mul(self, rhs: $ty) -> Self::Output {
                rhs * self
            }
        }

        impl ::std::ops::Mul<$ty> for i32 {
            type Output = $ty;

            fn mul(self, rhs: $ty) -> Self::Output {
                rhs * self
            }
        }

        impl ::std::ops::Mul<$ty> for i16 {
            type Output = $ty;

            fn mul(self, rhs: $ty) -> Self::Output {
                rhs * self
            }
        }

        impl ::std::ops::Mul<$ty> for usize {
            type Output = $ty;

            fn mul(self, rhs: $ty) -> Self::Output {
                rhs * self
            }
        }

        impl ::std::ops::Mul<$ty> for u64 {
            type Output = $ty;

            fn mul(self, rhs: $ty) -> Self::Output {
                rhs * self
            }
        }

        impl ::std::ops::Mul<$ty> for u32 {
            type Output = $ty;

            fn mul(self, rhs: $ty) -> Self::Output {
                rhs * self
            }
        }

        impl ::std::ops::Mul<$ty> for u16 {
            type Output = $ty;

            fn mul(self, rhs: $ty) -> Self::Output {
                rhs * self
            }
        }

        impl ::std::ops::Mul<$ty> for f64 {
            type Output = $ty;

            fn mul(self, rhs: $ty) -> Self::Output {
                rhs * self
            }
        }

        impl ::std::ops::Mul<$ty> for f32 {
            type Output = $ty;

            fn mul(self, rhs: $ty) -> Self::Output {
                rhs * self
            }
        }

        impl ::std::ops::MulAssign<isize> for $ty {
            fn mul_assign(&mut self, rhs: isize) {
                *self = *self * rhs;
            }
        }

        impl ::std::ops::MulAssign<i64> for $ty {
            fn mul_assign(&mut self, rhs: i64) {
                *self = *self * rhs;
            }
        }

        impl ::std::ops::MulAssign<i32> for $ty {
            fn mul_assign(&mut self, rhs: i32) {
                *self = *self * rhs;
            }
        }

        impl ::std::ops::MulAssign<i16> for $ty {
            fn mul_assign(&mut self, rhs: i16) {
                *self = *self * rhs;
            }
        }

        impl ::std::ops::MulAssign<usize> for $ty {
            fn mul_assign(&mut self, rhs: usize) {
                *self = *self * rhs;
            }
        }

        impl ::std::ops::MulAssign<u64> for $ty {
            fn mul_assign(&mut self, rhs: u64) {
                *self = *self * rhs;
            }
        }

        impl ::std::ops::MulAssign<u32> for $ty {
            fn mul_assign(&mut self, rhs: u32) {
                *self = *self * rhs;
            }
        }

        impl ::std::ops::MulAssign<u16> for $ty {
            fn mul_assign(&mut self, rhs: u16) {
                *self = *self * rhs;
            }
        }

        impl ::std::ops::MulAssign<f64> for $ty {
            fn mul_assign(&mut self, rhs: f64) {
                *self = *self * rhs;
            }
        }

        impl ::std::ops::MulAssign<f32> for $ty {
            fn mul_assign(&mut self, rhs: f32) {
                *self = *self * rhs;
            }
        }
    };
}

pub(crate) use relative_unit;
pub(crate) use unit_base;
