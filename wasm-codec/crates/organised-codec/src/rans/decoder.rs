//! From bytes to symbols and raw bits.

use super::body::{Body, RawReader};
use super::plane_decoder::PlaneDecoder;
use super::{Coder, LOW, LOW_BITS, PROBABILITY_BITS, SPARE_BITS, STATES, TOTAL, WORDS, code_escape};
use crate::tables::{DecoderTables, SHARE_MASK, SHARE_START, SHARE_SYMBOL};

/// Reads a body. Past its end there are zeros; that it ended is told at the end.
///
/// It is small and copied: loops work on a copy, so that it stays in registers.
#[derive(Clone, Copy)]
pub struct Decoder<'a> {
    states: [u32; STATES],
    /// The first two states are exchanged.
    odd: bool,
    words: &'a [u16; WORDS + 4],
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
        let mut raw = RawReader::new(&body.raw);
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
        2 * self.at + self.raw.at() / 8 > self.length
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
        let used = self.raw.at();
        let rest = used.next_multiple_of(8) - used;
        2 * self.at + used.div_ceil(8) == self.length
            && { self.raw }.take(rest as u32) == 0
            && self.spare == 0
            // Which of them is which is no matter here: all are the same.
            && self.states == [LOW; STATES]
    }

    /// The states for planes, which all take part there.
    #[inline(always)]
    pub fn plane_decoder(&self) -> PlaneDecoder<'a> {
        PlaneDecoder::new(self.states, self.words, self.at, self.raw, self.tables.slots())
    }

    /// Goes on behind a plane.
    #[inline(always)]
    pub fn resume(&mut self, plane: &PlaneDecoder<'a>) {
        (self.states, self.at, self.raw) = plane.place();
    }
}

/// Not inlined, and by value: what is passed by reference to a call in a loop does not stay in registers.
#[cold]
#[inline(never)]
fn read_escape(mut raw: RawReader<'_>, symbol: u32) -> (u32, RawReader<'_>) {
    (code_escape(|bits, _| raw.take(bits), symbol, 0), raw)
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
        let x = self.states[0];
        let slot = x & u32::from(TOTAL - 1);
        let share = self.tables.search(context, slot);
        let x = (share & SHARE_MASK) * (x >> PROBABILITY_BITS) + slot - (share >> SHARE_START & SHARE_MASK);
        // Without a branch: which symbol needs a word is hard to foretell.
        let short = u32::from(x < LOW);
        let word = u32::from(self.words[self.at % WORDS]) & short.wrapping_neg();
        self.states[0] = x << (16 * short) | word;
        self.at += short as usize;
        self.states.swap(0, 1);
        self.odd = !self.odd;
        share >> SHARE_SYMBOL
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
