//! A tile's symbols and raw bits.

use bytemuck::must_cast;
use wide::i16x8;

use super::{Coder, NO_TOKEN, STATE_SHIFT, TOKEN_MASK, code_escape};
use crate::contexts::{FIRST_ROW_BIN, SHIFTED_BIN, SYMBOLS};
use crate::lanes::{LANES, gather, select};
use crate::tables::EncoderTables;
use crate::tile::{LINE, Plane, columns_of};

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
    /// Puts the tokens of a plane into the order of a front's steps.
    #[inline(always)]
    pub fn push_front(&mut self, plane: &Plane, width: usize, height: usize, base: usize) {
        let last_row = height - 1;
        let steps = 2 * (last_row % LANES) + 2 * LANES * (last_row / LANES) + width;
        self.with_copy(|own| {
            for block in 0..steps.div_ceil(LANES) {
                for (i, column) in columns_of(&plane.tokens, block).into_iter().enumerate() {
                    own.push_step(column, plane, block * LANES + i, base);
                }
            }
            own.base = own.count;
        });
    }

    /// Puts the tokens of a mask of 16 × 16 pixels into the order of its walk: [`crate::syntax`] says which.
    pub fn push_mask(&mut self, groups: [[i16x8; 2]; 4]) {
        let start = self.count % TILE_TOKENS;
        let turn = (self.count - self.base) as u16 % 2;
        let [even, odd] = [turn << STATE_SHIFT, (1 - turn) << STATE_SHIFT];
        let groups: [[u16; 16]; 4] = must_cast(groups);
        let all = &mut self.tokens[start..start + 64];
        (all[0], all[1]) = (groups[0][0] | even, groups[1][0] | odd);
        for (y, four) in (1..16).zip(all[2..62].as_chunks_mut::<4>().0) {
            *four =
                [groups[0][y] | even, groups[2][y - 1] | odd, groups[1][y] | even, groups[3][y - 1] | odd];
        }
        (all[62], all[63]) = (groups[2][15] | even, groups[3][15] | odd);
        self.count += 64;
    }

    #[inline(always)]
    fn push_step(&mut self, column: i16x8, plane: &Plane, t: usize, base: usize) {
        let mask = !column.simd_eq(i16x8::splat(NO_TOKEN)).to_bitmask() & 0xff;
        let tokens = column & i16x8::MAX;
        // Room for eight, however many of them count.
        let start = self.count % TILE_TOKENS;
        self.tokens[start..start + LANES].copy_from_slice(&gather(tokens, mask as u8));
        self.count += mask.count_ones() as usize;
        let more = column.to_bitmask() & mask;
        if more != 0 {
            let numbers = plane.numbers.each_ref().map(|line| line[t % LINE]);
            self.raw = push_lanes(core::mem::take(&mut self.raw), more, tokens, numbers, base);
        }
    }

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
    pub(crate) fn tokens(&self) -> &[u16] {
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

/// The states of the lanes.
const OWNERS: i16x8 = i16x8::new([0, 1 << 13, 2 << 13, 3 << 13, 0, 1 << 13, 2 << 13, 3 << 13]);

/// The symbols of numbers, and all bits where raw ones follow.
#[inline(always)]
fn symbols(numbers: i16x8, [one, two, three]: [i16x8; 3]) -> (i16x8, i16x8) {
    // Numbers beyond 2¹⁵ are as much an escape as 2¹⁵.
    let capped = select(numbers.simd_lt(i16x8::ZERO), i16x8::MAX, numbers);
    let mut high = select(one, capped >> 1, capped);
    high = select(two, capped >> 2, high);
    high = select(three, capped >> 3, high);
    let symbols =
        high.min(i16x8::splat(13)) - high.simd_gt(i16x8::splat(20)) - high.simd_gt(i16x8::splat(84));
    (symbols, one | symbols.simd_gt(i16x8::splat(12)))
}

/// What a front notes of eight numbers of a row that a lane handles: negative where raw bits follow.
#[inline(always)]
#[must_use]
pub fn token(contexts: i16x8, numbers: i16x8, shifted: [i16x8; 3], lane: usize) -> i16x8 {
    let (symbols, more) = symbols(numbers, shifted);
    let own = i16x8::splat(OWNERS.to_array()[lane % LANES]) | (more & i16x8::MIN);
    ((contexts << 4) + symbols) | own
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
    fn with_copy<T>(&mut self, work: impl FnOnce(&mut Self) -> T) -> T {
        let mut own = core::mem::take(self);
        let result = work(&mut own);
        *self = own;
        result
    }
}

/// The raw bits of the lanes of a step.
#[inline(never)]
fn push_lanes(
    mut raw: RawTokens,
    mut lanes: u32,
    tokens: i16x8,
    numbers: [i16; LANES],
    base: usize,
) -> RawTokens {
    let tokens = tokens.to_array();
    while lanes != 0 {
        let lane = lanes.trailing_zeros() as usize % LANES;
        lanes &= lanes - 1;
        let (token, number) = (tokens[lane] as usize & TOKEN_MASK, u32::from(numbers[lane] as u16));
        let (symbol, bin) = (token % SYMBOLS, (token / SYMBOLS - base) / 4);
        // None in the bin after the last, which is that of first rows.
        let shift =
            if bin < FIRST_ROW_BIN as usize { (bin + 1).saturating_sub(SHIFTED_BIN) as u32 } else { 0 };
        if symbol > 12 {
            raw = push_escape(raw, symbol as u32, number >> shift);
        }
        raw.push(shift, number & ((1 << shift) - 1));
    }
    raw
}
