//! Numbers as a symbol and raw bits.

use crate::rans::{Coder, ESCAPES};

/// 0, −1, 1, −2 … become 0, 1, 2, 3 ….
#[inline(always)]
pub fn fold(value: i32) -> u32 {
    (value << 1 ^ value >> 31) as u32
}

/// Back from [`fold`].
#[inline(always)]
pub fn unfold(value: u32) -> i32 {
    (value >> 1) as i32 ^ -((value & 1) as i32)
}

/// A number of 16 bits: 13 direct symbols, then three with raw bits.
#[inline(always)]
pub fn code_number<C: Coder>(coder: &mut C, context: usize, number: u32) -> u32 {
    let escape = u32::from(number >= ESCAPES[1]) + u32::from(number >= ESCAPES[2]);
    let symbol = coder.symbol(context, if number < 13 { number } else { 13 + escape });
    if symbol < 13 { symbol } else { coder.escape(symbol, number) }
}

/// The bin of a folded residual: 0, 1–2, 3–8, more.
#[inline(always)]
pub fn residual_bin(folded: u32) -> usize {
    usize::from(folded > 0) + usize::from(folded > 2) + usize::from(folded > 8)
}
