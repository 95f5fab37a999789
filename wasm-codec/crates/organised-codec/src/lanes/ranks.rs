//! Limits to rank numbers by.

/// How many of some limits a number is above. The limits are 0 to 14.
pub struct Ranks {
    #[cfg_attr(not(all(target_arch = "wasm32", target_feature = "simd128")), allow(dead_code))]
    pub(super) table: [u8; 16],
    #[cfg_attr(all(target_arch = "wasm32", target_feature = "simd128"), allow(dead_code))]
    pub(super) limits: &'static [i16],
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
}
