//! A tile's symbols and raw bits.

use wide::i16x8;

use super::{Coder, STATE_SHIFT, Step, TOKEN_MASK, code_escape, shifts};
use crate::contexts::SYMBOLS;
use crate::lanes::{LANES, gather, select};
use crate::tables::EncoderTables;

/// Room for a tile's tokens: 16 × 16 of depth and of indices, 64 of the mask, 12 blocks of 66.
const TILE_TOKENS: usize = 2048;

/// Room for a tile's raw bits: three entries a pixel at most, two an index, two a coefficient.
const TILE_RAW: usize = 4096;

/// The symbols and raw bits of a tile, in the order of decoding.
///
/// As with the decoder, loops work on what was moved out of it; so nothing here is passed to a call by reference.
#[derive(Default)]
pub struct TileTokens {
    tokens: Vec<u16>,
    count: usize,
    /// The count where the first state's turn was last.
    base: usize,
    raw: RawTokens,
    /// Where among the raw bits the signs begin.
    signs: usize,
}

/// Raw bits, each entry their number << 16 | bits.
#[derive(Default)]
struct RawTokens {
    entries: Vec<u32>,
    count: usize,
}

impl RawTokens {
    #[inline(always)]
    fn push(&mut self, bits: u32, value: u32) -> u32 {
        self.entries[self.count % TILE_RAW] = bits << 16 | value;
        self.count += usize::from(bits > 0);
        value
    }

    fn all(&self) -> &[u32] {
        &self.entries[..self.count]
    }
}

impl TileTokens {
    /// None.
    #[must_use]
    pub fn new() -> Self {
        Self {
            tokens: vec![0; TILE_TOKENS + LANES],
            raw: RawTokens { entries: vec![0; TILE_RAW], count: 0 },
            ..Self::default()
        }
    }

    /// Forgets all.
    pub fn clear(&mut self) {
        (self.count, self.base, self.raw.count, self.signs) = (0, 0, 0, usize::MAX);
    }

    /// Context · 16 + symbol of each.
    pub fn symbols(&self) -> impl Iterator<Item = usize> {
        self.tokens[..self.count].iter().map(|token| usize::from(*token) & TOKEN_MASK)
    }

    /// As they are noted: with the states' numbers.
    pub(super) fn tokens(&self) -> &[u16] {
        &self.tokens[..self.count]
    }

    /// Raw bits as they are noted, and where among them the signs begin.
    pub(super) fn raw_entries(&self) -> (&[u32], usize) {
        (self.raw.all(), self.signs.min(self.raw.count))
    }

    /// Raw bits.
    #[must_use]
    pub fn raw_bits(&self) -> u32 {
        self.raw.all().iter().map(|raw| raw >> 16).sum()
    }

    /// In 1/256 bit.
    #[must_use]
    pub fn cost(&self, tables: &EncoderTables) -> u32 {
        let costs = tables.costs();
        let symbols: u32 = self.tokens[..self.count]
            .iter()
            .map(|token| u32::from(costs[usize::from(*token) & TOKEN_MASK]))
            .sum();
        symbols + (self.raw_bits() << 8)
    }
}

#[cold]
#[inline(never)]
fn push_escape(mut raw: RawTokens, symbol: u32, number: u32) -> RawTokens {
    code_escape(|bits, value| raw.push(bits, value), symbol, number);
    raw
}

impl Coder for TileTokens {
    const DECODES: bool = false;

    #[inline(always)]
    fn first_turn(&mut self) {
        self.base = self.count;
    }

    #[inline(always)]
    fn symbol(&mut self, context: usize, value: u32) -> u32 {
        let turn = (self.count - self.base) as u16 & 1;
        let token = (context * SYMBOLS) as u16 + value as u16 + (turn << STATE_SHIFT);
        self.tokens[self.count % TILE_TOKENS] = token;
        self.count += 1;
        value
    }

    #[inline(always)]
    fn raw(&mut self, bits: u32, value: u32) -> u32 {
        self.raw.push(bits, value)
    }

    #[inline(always)]
    fn escape(&mut self, symbol: u32, number: u32) -> u32 {
        self.raw = push_escape(core::mem::take(&mut self.raw), symbol, number);
        number
    }

    #[inline(always)]
    fn begin_signs(&mut self, _last: bool) {
        self.signs = self.raw.count;
    }

    #[inline(always)]
    fn signs(&mut self, bits: u32, value: u32) -> u32 {
        self.raw.push(bits, value)
    }

    #[inline(always)]
    fn step(&mut self, step: &Step) -> i16x8 {
        const OWNERS: i16x8 = i16x8::new([0, 1 << 13, 2 << 13, 3 << 13, 0, 1 << 13, 2 << 13, 3 << 13]);
        let Step { valid, contexts, shifted: [one, two, three], numbers, .. } = *step;
        // Numbers beyond 2¹⁵ are as much an escape as 2¹⁵.
        let capped = select(numbers.simd_lt(i16x8::ZERO), i16x8::MAX, numbers);
        let mut high = select(one, capped >> 1, capped);
        high = select(two, capped >> 2, high);
        high = select(three, capped >> 3, high);
        let symbols =
            high.min(i16x8::splat(13)) - high.simd_gt(i16x8::splat(20)) - high.simd_gt(i16x8::splat(84));
        let tokens: i16x8 = ((contexts << 4) + symbols) | OWNERS;
        let mask = valid.to_bitmask() as u8;
        // Room for eight, however many of them count.
        let start = self.count % TILE_TOKENS;
        self.tokens[start..start + LANES].copy_from_slice(&gather(tokens, mask));
        self.count += mask.count_ones() as usize;
        self.base = self.count;
        let more = ((one | symbols.simd_gt(i16x8::splat(12))) & valid).to_bitmask();
        if more != 0 {
            let raw = core::mem::take(&mut self.raw);
            self.raw = push_lanes(raw, more, symbols, step.numbers, shifts(step));
        }
        numbers
    }

    #[inline(always)]
    fn with_copy<T>(&mut self, work: impl FnOnce(&mut Self) -> T) -> T {
        let mut own = core::mem::take(self);
        let result = work(&mut own);
        *self = own;
        result
    }
}

#[inline(never)]
fn push_lanes(
    mut raw: RawTokens,
    mut lanes: u32,
    symbols: i16x8,
    numbers: i16x8,
    shifts: i16x8,
) -> RawTokens {
    let (symbols, numbers, shifts) = (symbols.to_array(), numbers.to_array(), shifts.to_array());
    while lanes != 0 {
        let lane = lanes.trailing_zeros() as usize % LANES;
        lanes &= lanes - 1;
        let (number, shift) = (u32::from(numbers[lane] as u16), shifts[lane] as u32);
        if symbols[lane] > 12 {
            raw = push_escape(raw, symbols[lane] as u32, number >> shift);
        }
        raw.push(shift, number & ((1 << shift) - 1));
    }
    raw
}
