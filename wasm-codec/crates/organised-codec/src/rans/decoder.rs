//! From bytes to symbols and raw bits.

use bytemuck::must_cast;
use wide::i16x8;

use super::{
    Coder, LOW, LOW_BITS, PROBABILITY_BITS, RAW_BYTES, SPARE_BITS, STATES, Step, WORDS, code_escape,
};
use crate::contexts::CERTAIN;
use crate::lanes::{LANES, select};
use crate::tables::{CONTEXT_SLOTS, DecoderTables};

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
struct RawReader<'a> {
    bytes: &'a [u8; RAW_BYTES + 8],
    at: usize,
}

impl RawReader<'_> {
    /// 32 bits at most.
    #[inline(always)]
    fn take(&mut self, bits: u32) -> u32 {
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
    /// At a body's beginning.
    #[must_use]
    pub fn new(body: &'a Body, tables: &'a DecoderTables) -> Self {
        let mut raw = RawReader { bytes: &body.raw, at: 0 };
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

    /// Takes out of the states what the encoder put there in the beginning, 60 bits.
    #[must_use]
    pub fn take_held(&mut self) -> u64 {
        self.first_turn();
        let mut held = 0;
        for (i, state) in self.states.iter_mut().enumerate() {
            held |= u64::from(*state & (LOW - 1)) << (LOW_BITS * i as u32);
            *state &= !(LOW - 1);
        }
        held
    }

    /// True where all was read, what was left of the last byte of raw bits is 0, and the states are what the encoder began
    /// with, less what they held: 2¹⁵.
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

    /// Numbers of 16 bits, lane k by state k mod 4.
    #[inline(always)]
    pub fn step(&mut self, step: &Step) -> i16x8 {
        let [one, two, three] = step.shifted;
        let contexts = select(step.valid, step.contexts, i16x8::splat(CERTAIN as i16));
        let contexts: [u64; 2] = must_cast(contexts);
        let mut symbols = [0_u64; 2];
        for (pair, some) in step.pairs.into_iter().enumerate() {
            if some {
                for lane in [2 * pair, 2 * pair + 1] {
                    let (half, state) = (lane / STATES, lane % STATES);
                    let context = (contexts[half] >> (16 * state)) as usize % CONTEXT_SLOTS;
                    let symbol = self.tables.look(context, self.slot(state));
                    self.take(state, self.tables.share(context, symbol));
                    symbols[half] |= u64::from(symbol) << (16 * state);
                }
            }
        }
        let symbols: i16x8 = must_cast(symbols);
        let more = ((one | symbols.simd_gt(i16x8::splat(12))) & step.valid).to_bitmask();
        if more == 0 {
            return symbols;
        }
        let (numbers, raw) = extend(self.raw, more, symbols, -(one + two + three));
        self.raw = raw;
        numbers
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
            self.spare_bits = SPARE_BITS;
            self.spare = self.take_held();
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
    fn with_copy<T>(&mut self, work: impl FnOnce(&mut Self) -> T) -> T {
        let mut own = *self;
        let result = work(&mut own);
        *self = own;
        result
    }
}
