//! The entropy coder: range asymmetric numeral systems (Duda, arXiv:1311.2540) with static tables of 12 bits, two states
//! that take turns, and 16-bit words.

use crate::contexts::SYMBOLS;
use crate::tables::Tables;

/// Bits of a probability.
pub const PROBABILITY_BITS: u32 = 12;
/// Lower end of a state's interval [2¹⁵, 2³¹); also what the encoder begins with and the decoder must end with.
pub const LOW: u32 = 1 << 15;
/// A raw value has at most so many bits.
pub const MAX_RAW_BITS: u32 = 12;

/// Which of the two table sets of a packet a symbol belongs to.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Family {
    /// Kinds, patterns, masks, depth.
    Geometry,
    /// Colour.
    Colour,
}

/// One walk over the syntax serves coding, decoding and counting: a coder is given the value where it is known, and
/// returns the value that counts.
pub trait Coder {
    /// True where the values are not known beforehand.
    const DECODES: bool;
    /// A symbol 0..16 of a context.
    fn symbol(&mut self, family: Family, context: usize, value: u32) -> u32;
    /// Where the values are known: a symbol, but only where it is `coded`.
    #[inline(always)]
    fn symbol_if(&mut self, family: Family, context: usize, value: u32, coded: bool) {
        if coded {
            self.symbol(family, context, value);
        }
    }
    /// `bits` ≤ 12 bits of equal probability.
    fn raw(&mut self, bits: u32, value: u32) -> u32;
}

/// What coding a symbol takes: a reciprocal in place of the division.
#[derive(Clone, Copy, Debug, Default)]
pub struct EncoderSymbol {
    reciprocal: u32,
    bias: u16,
    frequency: u16,
    shift: u32,
}

impl EncoderSymbol {
    /// For a symbol whose share of 4096 begins at `start`.
    #[must_use]
    pub fn new(start: u32, frequency: u32) -> Self {
        if frequency < 2 {
            // x / 1 = x: one too few by the reciprocal, put right by the bias.
            let bias = (start + (1 << PROBABILITY_BITS) - 1) as u16;
            return Self { reciprocal: u32::MAX, bias, frequency: frequency as u16, shift: 0 };
        }
        let shift = 32 - (frequency - 1).leading_zeros();
        let reciprocal = (1u64 << (shift + 31)).div_ceil(u64::from(frequency));
        Self {
            reciprocal: reciprocal as u32,
            bias: start as u16,
            frequency: frequency as u16,
            shift: shift - 1,
        }
    }
}

/// The symbols of a packet in the order of decoding, and what they will cost.
#[derive(Default)]
pub struct Tokens {
    /// Those in use are the first `length`: what follows is room.
    tokens: Vec<u32>,
    length: usize,
    /// In 1/256 bit.
    cost: u32,
}

const RAW: u32 = 1 << 31;

/// More than a tile has: of 256 pixels 4 numbers each, of at most 3 tokens and the shift's, and the mask.
const TILE_TOKENS: usize = 256 * 4 * 4 + 128;

impl Tokens {
    /// Room for `capacity` symbols before the first reallocation.
    pub fn with_capacity(capacity: usize) -> Self {
        Self { tokens: vec![0; capacity], length: 0, cost: 0 }
    }

    /// Forgets all.
    pub fn clear(&mut self) {
        self.length = 0;
        self.cost = 0;
    }

    /// In 1/256 bit.
    pub fn cost(&self) -> u32 {
        self.cost
    }

    /// Where to go back to.
    pub fn mark(&self) -> (usize, u32) {
        (self.length, self.cost)
    }

    /// Back to a mark.
    pub fn rewind(&mut self, (length, cost): (usize, u32)) {
        self.length = self.length.min(length);
        self.cost = cost;
    }

    /// Makes room for a tile's tokens.
    pub fn reserve_tile(&mut self) {
        if self.tokens.len() < self.length + TILE_TOKENS {
            self.tokens.resize((self.length + TILE_TOKENS).next_power_of_two(), 0);
        }
    }

    /// Adds a token where `coded`, and what it costs. Without a branch: whether a pixel is valid cannot be foreseen.
    #[inline(always)]
    fn push_if(&mut self, token: u32, cost: u32, coded: bool) {
        self.tokens[self.length] = token;
        self.length += usize::from(coded);
        self.cost += if coded { cost } else { 0 };
    }

    /// Writes the two states and the words to the end of `bytes`, and returns where they begin; `None` where they do
    /// not fit.
    #[must_use]
    pub fn write(&self, tables: &Tables, bytes: &mut [u8]) -> Option<usize> {
        let symbols = tables.encoder_symbols();
        let mut at = bytes.len();
        // `x` codes the next symbol, `y` the one after.
        let (mut x, mut y) = (LOW, LOW);
        for &token in self.tokens[..self.length].iter().rev() {
            let coded = if token & RAW == 0 {
                let symbol = symbols[token as usize];
                let frequency = u32::from(symbol.frequency);
                if x >= frequency << (31 - PROBABILITY_BITS) {
                    at = at.checked_sub(2)?;
                    bytes[at..at + 2].copy_from_slice(&(x as u16).to_le_bytes());
                    x >>= 16;
                }
                let quotient = ((u64::from(x) * u64::from(symbol.reciprocal)) >> 32) as u32 >> symbol.shift;
                x + u32::from(symbol.bias) + quotient * ((1 << PROBABILITY_BITS) - frequency)
            } else {
                let bits = token >> 16 & 0xf;
                if x >= 1 << (31 - bits) {
                    at = at.checked_sub(2)?;
                    bytes[at..at + 2].copy_from_slice(&(x as u16).to_le_bytes());
                    x >>= 16;
                }
                x << bits | token & 0xffff
            };
            x = y;
            y = coded;
        }
        // The state that codes the first symbol comes first.
        at = at.checked_sub(8)?;
        bytes[at..at + 4].copy_from_slice(&y.to_le_bytes());
        bytes[at + 4..at + 8].copy_from_slice(&x.to_le_bytes());
        Some(at)
    }
}

/// Collects symbols for a packet.
pub struct Encoder<'a> {
    /// Where they go.
    pub tokens: &'a mut Tokens,
    /// Of all sets.
    pub costs: &'a [u16],
    /// First entry of the packet's geometry set.
    pub geometry: usize,
    /// First entry of the packet's colour set.
    pub colour: usize,
}

impl Coder for Encoder<'_> {
    const DECODES: bool = false;

    #[inline(always)]
    fn symbol(&mut self, family: Family, context: usize, value: u32) -> u32 {
        let base = if family == Family::Geometry { self.geometry } else { self.colour };
        let index = base + context * SYMBOLS + value as usize;
        self.tokens.push_if(index as u32, u32::from(self.costs[index]), true);
        value
    }

    #[inline(always)]
    fn symbol_if(&mut self, family: Family, context: usize, value: u32, coded: bool) {
        let base = if family == Family::Geometry { self.geometry } else { self.colour };
        let index = base + context * SYMBOLS + value as usize;
        self.tokens.push_if(index as u32, u32::from(self.costs[index]), coded);
    }

    #[inline(always)]
    fn raw(&mut self, bits: u32, value: u32) -> u32 {
        if bits > 0 {
            self.tokens.push_if(RAW | bits << 16 | value, bits << 8, true);
        }
        value
    }
}

/// Counts symbols: for training, and for what a frame would cost with each of the table sets.
pub struct Counter<'a> {
    /// By context and symbol.
    pub geometry: &'a mut [u32],
    /// By context and symbol.
    pub colour: &'a mut [u32],
    /// Raw bits.
    pub raw_bits: u64,
}

impl Coder for Counter<'_> {
    const DECODES: bool = false;

    #[inline(always)]
    fn symbol(&mut self, family: Family, context: usize, value: u32) -> u32 {
        let counts = if family == Family::Geometry { &mut *self.geometry } else { &mut *self.colour };
        counts[context * SYMBOLS + value as usize] += 1;
        value
    }

    #[inline(always)]
    fn raw(&mut self, bits: u32, value: u32) -> u32 {
        self.raw_bits += u64::from(bits);
        value
    }
}

/// Reads a packet's words. Past their end it reads zeros and says so at the end.
pub struct Decoder<'a> {
    x: u32,
    y: u32,
    words: &'a [[u8; 2]],
    at: usize,
    geometry: &'a [[u16; SYMBOLS]],
    colour: &'a [[u16; SYMBOLS]],
}

impl<'a> Decoder<'a> {
    /// `bytes` are the states and the words; the tables hold, for each symbol, where its share ends less 1. `None` where there is not room for the
    /// states, a state is outside its interval, or half a word is left over.
    #[must_use]
    pub fn new(
        bytes: &'a [u8],
        geometry: &'a [[u16; SYMBOLS]],
        colour: &'a [[u16; SYMBOLS]],
    ) -> Option<Self> {
        let (states, words) = bytes.split_at_checked(8)?;
        let x = u32::from_le_bytes([states[0], states[1], states[2], states[3]]);
        let y = u32::from_le_bytes([states[4], states[5], states[6], states[7]]);
        let (words, []) = words.as_chunks::<2>() else { return None };
        let inside = |state: u32| (LOW..1 << 31).contains(&state);
        (inside(x) && inside(y)).then_some(Self { x, y, words, at: 0, geometry, colour })
    }

    /// True where more words were read than there are.
    #[must_use]
    pub fn overrun(&self) -> bool {
        self.at > self.words.len()
    }

    /// True where every word was read and the states are those that the encoder began with.
    #[must_use]
    pub fn finished(&self) -> bool {
        self.at == self.words.len() && self.x == LOW && self.y == LOW
    }

    #[inline(always)]
    fn put_back(&mut self, mut x: u32) {
        if x < LOW {
            let word = self.words.get(self.at).copied().unwrap_or_default();
            x = x << 16 | u32::from(u16::from_le_bytes(word));
            self.at += 1;
        }
        self.x = self.y;
        self.y = x;
    }
}

impl Coder for Decoder<'_> {
    const DECODES: bool = true;

    #[inline(always)]
    fn symbol(&mut self, family: Family, context: usize, _value: u32) -> u32 {
        let tables = if family == Family::Geometry { self.geometry } else { self.colour };
        let table = &tables[context];
        let x = self.x;
        let slot = x & ((1 << PROBABILITY_BITS) - 1);
        let symbol = find(table, slot);
        let end = u32::from(table[symbol]) + 1;
        let start = if symbol == 0 { 0 } else { u32::from(table[symbol - 1]) + 1 };
        self.put_back((end - start) * (x >> PROBABILITY_BITS) + slot - start);
        symbol as u32
    }

    #[inline(always)]
    fn raw(&mut self, bits: u32, _value: u32) -> u32 {
        if bits == 0 {
            return 0;
        }
        let value = self.x & ((1 << bits) - 1);
        self.put_back(self.x >> bits);
        value
    }
}

/// The symbol whose share of 4096 holds `slot`: how many shares end before it.
#[inline(always)]
fn find(table: &[u16; SYMBOLS], slot: u32) -> usize {
    use wide::{i8x16, i16x16};
    let ends: i16x16 = bytemuck::must_cast(*table);
    let before = i16x16::splat(slot as i16).simd_gt(ends);
    let bits = i8x16::from_i16x16_saturate(before).to_bitmask();
    // The last share ends at 4095 or later: never more than 15 bits.
    ((bits as u16).count_ones() as usize).min(SYMBOLS - 1)
}
