//! The entropy coder: range asymmetric numeral systems (Duda, arXiv:1311.2540) with static tables of 12 bits, four states
//! side by side, 16-bit words; and a stream of raw bits beside them.

use bytemuck::must_cast;
use wide::i16x8;

use crate::contexts::{CERTAIN, SYMBOLS};
use crate::lanes::{LANES, gather, select};
use crate::tables::{DecoderTables, EncoderTables};

/// Bits of a probability.
pub const PROBABILITY_BITS: u32 = 12;
/// Lower end of a state's interval [2¹⁵, 2³¹); also what the encoder begins with and the decoder must end with.
pub const LOW: u32 = 1 << LOW_BITS;
const LOW_BITS: u32 = 15;
/// States side by side.
pub const STATES: usize = 4;
/// A raw value has at most so many bits.
pub const MAX_RAW_BITS: u32 = 16;

/// A step of a wavefront: eight numbers, one a lane, that do not depend on one another.
pub struct Step {
    /// Of the lanes that hold a pixel, all bits; else none.
    pub valid: i16x8,
    /// What each is coded with.
    pub contexts: i16x8,
    /// All bits where 1, 2 and 3 low bits of the number are not modelled (where 3 are, in all of them).
    pub shifted: [i16x8; 3],
    /// The numbers, where they are known.
    pub numbers: i16x8,
    /// Whether lanes 0–3 and 4–7 hold any pixel.
    pub halves: [bool; 2],
}

/// One walk over the syntax serves coding and decoding: a coder is given the value where it is known, and returns the value
/// that counts.
pub trait Coder {
    /// True where the values are not known beforehand.
    const DECODES: bool;
    /// The first state's turn is next.
    fn first_turn(&mut self);
    /// A symbol 0..16 of a context, by the first and the second state in turn.
    fn symbol(&mut self, context: usize, value: u32) -> u32;
    /// `bits` ≤ 16 bits of equal probability.
    fn raw(&mut self, bits: u32, value: u32) -> u32;
    /// The raw bits of a number whose symbol is 13 or more.
    fn escape(&mut self, symbol: u32, number: u32) -> u32;
    /// Begins the signs of a tile, the last that is coded of it. Where it is the packet's last tile, the first ones are what
    /// is left in the states.
    fn begin_signs(&mut self, last: bool);
    /// `bits` ≤ 16 signs.
    fn signs(&mut self, bits: u32, value: u32) -> u32;
    /// Numbers of 16 bits, lane k by state k mod 4.
    fn step(&mut self, step: &Step) -> i16x8;
    /// Works on a copy where that is cheap.
    #[inline(always)]
    fn with_copy<T>(&mut self, work: impl FnOnce(&mut Self) -> T) -> T
    where
        Self: Sized,
    {
        work(self)
    }
}

/// Symbols 13, 14 and 15 of a number: the first number that each stands for. The first two are followed by 3 and 6 raw
/// bits, the last by 4 raw bits n and n more: what the number is above 84, without its highest bit.
pub const ESCAPES: [u32; 3] = [13, 21, 85];
const ESCAPE_BITS: [u32; 2] = [3, 6];

/// The raw bits of a number with such a symbol, by a coder of raw bits.
#[inline(always)]
pub fn code_escape(mut raw: impl FnMut(u32, u32) -> u32, symbol: u32, number: u32) -> u32 {
    let escape = symbol.wrapping_sub(13) as usize;
    if let Some(bits) = ESCAPE_BITS.get(escape) {
        let first = ESCAPES[escape];
        return first + raw(*bits, number.wrapping_sub(first) & ((1 << bits) - 1));
    }
    let above = number.wrapping_sub(ESCAPES[2] - 1) & 0xffff;
    let octave = raw(4, above.checked_ilog2().unwrap_or(0));
    ESCAPES[2] - 1 + (1 << octave | raw(octave, above & ((1 << octave) - 1)))
}

/// What coding a symbol takes: a reciprocal in place of the division.
#[derive(Clone, Copy, Debug, Default)]
pub struct EncoderSymbol {
    /// 2⁴³ / frequency, rounded up: exact for states below frequency · 2¹⁹.
    reciprocal: u64,
    /// The state from which on a word must go first.
    limit: u32,
    start: u16,
    /// 4096 − frequency.
    rest: u16,
}

const RECIPROCAL_BITS: u32 = 43;

impl EncoderSymbol {
    /// For a symbol whose share of 4096 begins at `start`.
    #[must_use]
    pub fn new(start: u32, frequency: u32) -> Self {
        Self {
            reciprocal: (1u64 << RECIPROCAL_BITS).div_ceil(u64::from(frequency)),
            limit: frequency << (16 + LOW_BITS - PROBABILITY_BITS),
            start: start as u16,
            rest: ((1 << PROBABILITY_BITS) - frequency) as u16,
        }
    }
}

/// Where the state of a token begins, above its context and symbol.
const STATE_SHIFT: u32 = 13;
const TOKEN_MASK: usize = (1 << STATE_SHIFT) - 1;
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

#[inline(always)]
fn shifts(step: &Step) -> i16x8 {
    let [one, two, three] = step.shifted;
    -(one + two + three)
}

/// The symbols and raw bits of a packet.
#[derive(Default)]
pub struct PacketTokens {
    tokens: Vec<u16>,
    raw: Vec<u32>,
    /// Where among the raw bits the last tile's signs begin.
    signs: usize,
}

/// A place in a packet's tokens to go back to.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mark {
    tokens: usize,
    raw: usize,
    signs: usize,
}

impl PacketTokens {
    /// Forgets all.
    pub fn clear(&mut self) {
        self.tokens.clear();
        self.raw.clear();
    }

    /// Adds a tile.
    pub fn push(&mut self, tile: &TileTokens) {
        self.signs = self.raw.len() + tile.signs.min(tile.raw.count);
        self.tokens.extend_from_slice(&tile.tokens[..tile.count]);
        self.raw.extend_from_slice(tile.raw.all());
    }

    /// Where to go back to.
    #[must_use]
    pub fn mark(&self) -> Mark {
        Mark { tokens: self.tokens.len(), raw: self.raw.len(), signs: self.signs }
    }

    /// Back to a mark.
    pub fn rewind(&mut self, mark: Mark) {
        self.tokens.truncate(mark.tokens);
        self.raw.truncate(mark.raw);
        self.signs = mark.signs;
    }

    /// Adds the packet's body to `bytes`: words, then the raw bits (`head` first) from the end backwards. False, and
    /// nothing added, where it would have more than `limit` bytes.
    #[must_use]
    pub fn write(
        &self,
        tables: &EncoderTables,
        head: &[(u32, u32)],
        words: &mut [u16; WORDS],
        limit: usize,
        bytes: &mut Vec<u8>,
    ) -> bool {
        let symbols = tables.symbols();
        let (raw_bits, signs) = self.raw.split_at(self.signs);
        // What the states begin with the decoder finds in them at the end: room for the last tile's first signs.
        let mut left = 0_u64;
        let mut held = 0;
        let mut beyond = [0_u32; 1];
        let mut rest = signs;
        while let Some((first, others)) = rest.split_first() {
            let (bits, value) = (first >> 16, first & 0xffff);
            left |= u64::from(value) << held & SPARE_MASK;
            if held + bits > SPARE_BITS {
                let fit = SPARE_BITS - held;
                beyond[0] = (bits - fit) << 16 | value >> fit;
                rest = others;
                break;
            }
            held += bits;
            rest = others;
        }
        let mut states: [u32; STATES] =
            core::array::from_fn(|i| LOW | (left >> (LOW_BITS * i as u32)) as u32 & (LOW - 1));
        let mut at = 0;
        for &token in self.tokens.iter().rev() {
            let symbol = &symbols[usize::from(token) & TOKEN_MASK];
            let own = usize::from(token >> STATE_SHIFT) % STATES;
            let x = states[own];
            // The last word comes first.
            words[at % WORDS] = x as u16;
            let over = u32::from(x >= symbol.limit);
            at += over as usize;
            let x = x >> (16 * over);
            let quotient = ((u64::from(x) * symbol.reciprocal) >> RECIPROCAL_BITS) as u32;
            states[own] = x + u32::from(symbol.start) + quotient * u32::from(symbol.rest);
        }
        if at > limit / 2 {
            return false;
        }
        let start = bytes.len();
        bytes.extend(words[..at].iter().rev().flat_map(|word| word.to_le_bytes()));
        let mut raw = RawWriter { bytes, buffer: 0, filled: 0 };
        for (bits, value) in head {
            raw.put(*bits, *value);
        }
        for state in states {
            let more = 31 - LOW_BITS - state.leading_zeros();
            raw.put(4, more);
            raw.put(LOW_BITS + more, state ^ 1 << (LOW_BITS + more));
        }
        for bits in raw_bits.iter().chain(&beyond).chain(rest) {
            raw.put(bits >> 16, bits & 0xffff);
        }
        raw.finish();
        bytes[start + 2 * at..].reverse();
        if bytes.len() - start > limit {
            bytes.truncate(start);
            return false;
        }
        true
    }
}

/// What the states can hold beside the highest bit that they end with.
const SPARE_BITS: u32 = LOW_BITS * STATES as u32;
const SPARE_MASK: u64 = (1 << SPARE_BITS) - 1;

/// Bits to bytes, the lowest first.
struct RawWriter<'a> {
    bytes: &'a mut Vec<u8>,
    buffer: u64,
    filled: u32,
}

impl RawWriter<'_> {
    #[inline(always)]
    fn put(&mut self, bits: u32, value: u32) {
        self.buffer |= u64::from(value) << self.filled;
        self.filled += bits;
        if self.filled >= 32 {
            self.bytes.extend_from_slice(&(self.buffer as u32).to_le_bytes());
            self.buffer >>= 32;
            self.filled -= 32;
        }
    }

    fn finish(self) {
        let rest = self.filled.div_ceil(8) as usize;
        self.bytes.extend_from_slice(&self.buffer.to_le_bytes()[..rest]);
    }
}

/// Words that a body may have, and more: a power of two.
pub const WORDS: usize = 1024;
const RAW_BYTES: usize = 2048;

/// A packet's body as words from its beginning and as bytes from its end.
pub struct Body {
    words: Box<[u16; WORDS]>,
    raw: Box<[u8; RAW_BYTES + 8]>,
    length: usize,
}

impl Default for Body {
    fn default() -> Self {
        Self { words: Box::new([0; WORDS]), raw: Box::new([0; RAW_BYTES + 8]), length: 0 }
    }
}

impl Body {
    /// Takes over a packet's bytes after its header, at most 2047.
    pub fn load(&mut self, bytes: &[u8]) {
        let bytes = &bytes[..bytes.len().min(RAW_BYTES - 1)];
        for (word, pair) in self.words.iter_mut().zip(bytes.as_chunks::<2>().0) {
            *word = u16::from_le_bytes(*pair);
        }
        let (first, eights) = bytes.as_rchunks::<8>();
        let (raw_eights, _) = self.raw.as_chunks_mut::<8>();
        for (own, eight) in raw_eights.iter_mut().zip(eights.iter().rev()) {
            *own = u64::from_le_bytes(*eight).to_be_bytes();
        }
        for (own, byte) in self.raw[8 * eights.len()..].iter_mut().zip(first.iter().rev()) {
            *own = *byte;
        }
        // What lies beyond is the same whatever packet came before.
        if self.length > bytes.len() {
            self.words[bytes.len() / 2..self.length.div_ceil(2)].fill(0);
            self.raw[bytes.len()..self.length].fill(0);
        }
        self.length = bytes.len();
    }
}

/// Raw bits, one after another. Beyond the end they are 0.
#[derive(Clone, Copy)]
pub struct RawReader<'a> {
    bytes: &'a [u8; RAW_BYTES + 8],
    at: usize,
}

impl<'a> RawReader<'a> {
    /// From a body's end.
    #[must_use]
    pub fn new(body: &'a Body) -> Self {
        Self { bytes: &body.raw, at: 0 }
    }

    /// 32 bits at most.
    #[inline(always)]
    pub fn take(&mut self, bits: u32) -> u32 {
        let at = self.at / 8 % RAW_BYTES;
        let eight: &[u8; 8] = self.bytes[at..at + 8].first_chunk().expect("eight bytes");
        let window = u64::from_le_bytes(*eight) >> (self.at % 8);
        self.at += bits as usize;
        (window & ((1 << bits) - 1)) as u32
    }
}

/// Reads a body. Past its end there are zeros; that it ended is told at the end.
///
/// It is small and copied: loops work on a copy, so that it stays in registers.
#[derive(Clone, Copy)]
pub struct Decoder<'a> {
    states: [u32; STATES],
    /// The first two states are exchanged.
    odd: bool,
    words: &'a [u16; WORDS],
    at: usize,
    raw: RawReader<'a>,
    /// Signs that were in the states, and how many of them have not been read.
    spare: u64,
    spare_bits: u32,
    length: usize,
    tables: &'a DecoderTables,
}

impl<'a> Decoder<'a> {
    /// Of a body whose head has been read.
    #[must_use]
    pub fn new(body: &'a Body, mut raw: RawReader<'a>, tables: &'a DecoderTables) -> Self {
        let states = core::array::from_fn(|_| {
            let bits = LOW_BITS + raw.take(4);
            1 << bits | raw.take(bits)
        });
        Self {
            states,
            odd: false,
            words: &body.words,
            at: 0,
            raw,
            spare: 0,
            spare_bits: 0,
            length: body.length,
            tables,
        }
    }

    /// True where more was read than there is.
    #[must_use]
    pub fn overrun(&self) -> bool {
        2 * self.at + self.raw.at / 8 > self.length
    }

    /// True where all was read, what was left of the last byte of raw bits is 0, and the states are what the encoder began
    /// with: 2¹⁵ and the last tile's first signs, or zeros.
    #[must_use]
    pub fn finished(&self) -> bool {
        let used = self.raw.at;
        let rest = used.next_multiple_of(8) - used;
        2 * self.at + used.div_ceil(8) == self.length
            && { self.raw }.take(rest as u32) == 0
            && self.spare == 0
            // Which of them is which is no matter here: all are the same.
            && self.states == [LOW; STATES]
    }

    #[inline(always)]
    fn slot(&self, state: usize) -> u32 {
        self.states[state] & ((1 << PROBABILITY_BITS) - 1)
    }

    /// Takes a symbol with such a share off a state.
    #[inline(always)]
    fn take(&mut self, state: usize, share: u32) {
        let x = self.states[state];
        let slot = self.slot(state);
        let x = (share & 0xffff) * (x >> PROBABILITY_BITS) + slot - (share >> 16);
        // Without a branch: which symbol needs a word is hard to foretell.
        let short = u32::from(x < LOW);
        let word = u32::from(self.words[self.at % WORDS]) & short.wrapping_neg();
        self.states[state] = x << (16 * short) | word;
        self.at += short as usize;
    }

    /// Symbols of four contexts of 16 bits each, packed as those are.
    #[inline(always)]
    fn four(&mut self, contexts: u64) -> u64 {
        let mut symbols = 0;
        for lane in 0..STATES {
            let context = (contexts >> (16 * lane)) as usize & 0xffff;
            let symbol = self.tables.look(context, self.slot(lane));
            self.take(lane, self.tables.share(context, symbol));
            symbols |= u64::from(symbol) << (16 * lane);
        }
        symbols
    }
}

/// Not inlined, and by value: what is passed by reference to a call in a loop does not stay in registers.
#[cold]
#[inline(never)]
fn read_escape(mut raw: RawReader<'_>, symbol: u32) -> (u32, RawReader<'_>) {
    (code_escape(|bits, _| raw.take(bits), symbol, 0), raw)
}

/// Numbers of the lanes whose symbol says not all, and the reader behind their raw bits.
#[inline(never)]
fn extend<'a>(
    mut raw: RawReader<'a>,
    mut lanes: u32,
    symbols: i16x8,
    shifts: i16x8,
) -> (i16x8, RawReader<'a>) {
    let mut numbers = symbols.to_array();
    let shifts = shifts.to_array();
    while lanes != 0 {
        let lane = lanes.trailing_zeros() as usize % LANES;
        lanes &= lanes - 1;
        let (symbol, shift) = (numbers[lane] as u32, shifts[lane] as u32);
        let high = if symbol > 12 { code_escape(|bits, _| raw.take(bits), symbol, 0) } else { symbol };
        numbers[lane] = (high << shift | raw.take(shift)) as i16;
    }
    (numbers.into(), raw)
}

impl Coder for Decoder<'_> {
    const DECODES: bool = true;

    #[inline(always)]
    fn first_turn(&mut self) {
        if self.odd {
            self.states.swap(0, 1);
            self.odd = false;
        }
    }

    #[inline(always)]
    fn symbol(&mut self, context: usize, _value: u32) -> u32 {
        let symbol = self.tables.search(context, self.slot(0));
        self.take(0, self.tables.share(context, symbol));
        self.states.swap(0, 1);
        self.odd = !self.odd;
        symbol
    }

    #[inline(always)]
    fn raw(&mut self, bits: u32, _value: u32) -> u32 {
        self.raw.take(bits)
    }

    #[inline(always)]
    fn escape(&mut self, symbol: u32, _number: u32) -> u32 {
        let (number, raw) = read_escape(self.raw, symbol);
        self.raw = raw;
        number
    }

    fn begin_signs(&mut self, last: bool) {
        if last {
            self.first_turn();
            self.spare_bits = SPARE_BITS;
            for (i, state) in self.states.iter_mut().enumerate() {
                self.spare |= u64::from(*state & (LOW - 1)) << (LOW_BITS * i as u32);
                *state &= !(LOW - 1);
            }
        }
    }

    #[inline(always)]
    fn signs(&mut self, bits: u32, _value: u32) -> u32 {
        if self.spare_bits == 0 {
            return self.raw.take(bits);
        }
        let held = bits.min(self.spare_bits);
        let value = (self.spare & ((1 << held) - 1)) as u32;
        self.spare >>= held;
        self.spare_bits -= held;
        value | self.raw.take(bits - held) << held
    }

    #[inline(always)]
    fn step(&mut self, step: &Step) -> i16x8 {
        let contexts = select(step.valid, step.contexts, i16x8::splat(CERTAIN as i16));
        let [low, high]: [u64; 2] = must_cast(contexts);
        let mut symbols = [0_u64; 2];
        if step.halves[0] {
            symbols[0] = self.four(low);
        }
        if step.halves[1] {
            symbols[1] = self.four(high);
        }
        let symbols: i16x8 = must_cast(symbols);
        let more = ((step.shifted[0] | symbols.simd_gt(i16x8::splat(12))) & step.valid).to_bitmask();
        if more == 0 {
            return symbols;
        }
        let (numbers, raw) = extend(self.raw, more, symbols, shifts(step));
        self.raw = raw;
        numbers
    }

    #[inline(always)]
    fn with_copy<T>(&mut self, work: impl FnOnce(&mut Self) -> T) -> T {
        let mut own = *self;
        let result = work(&mut own);
        *self = own;
        result
    }
}
