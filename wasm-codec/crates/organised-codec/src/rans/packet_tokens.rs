//! A packet's symbols and raw bits, and how they become bytes.

use super::encoder_symbol::RECIPROCAL_BITS;
use super::{LOW, LOW_BITS, SPARE_BITS, STATE_SHIFT, STATES, TOKEN_MASK, TileTokens, WORDS};
use crate::tables::EncoderTables;

/// The symbols and raw bits of a packet.
#[derive(Default)]
pub struct PacketTokens {
    tokens: Vec<u16>,
    raw: Vec<u32>,
    /// Where among the raw bits the last tile's signs begin.
    signs: usize,
}

/// What the states begin with, beside their highest bit: the decoder finds it in them at the end.
#[derive(Clone, Copy, Debug)]
pub enum Held {
    /// The last tile's first signs.
    Signs,
    /// A check value of 60 bits.
    Check(u64),
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
        let (raw, signs) = tile.raw_entries();
        self.signs = self.raw.len() + signs;
        self.tokens.extend_from_slice(tile.tokens());
        self.raw.extend_from_slice(raw);
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

    /// Adds the packet's body to `bytes`: words, then the raw bits (states, then `head`, first) from the end backwards.
    /// False, and nothing added, where it would have more than `limit` bytes.
    #[must_use]
    pub fn write(
        &self,
        tables: &EncoderTables,
        head: &[(u32, u32)],
        held: Held,
        words: &mut [u16; WORDS],
        limit: usize,
        bytes: &mut Vec<u8>,
    ) -> bool {
        let symbols = tables.symbols();
        let (raw_bits, signs) = self.raw.split_at(self.signs);
        let (held, beyond, rest) = match held {
            Held::Signs => hold(signs),
            Held::Check(value) => (value, 0, signs),
        };
        let mut states: [u32; STATES] =
            core::array::from_fn(|i| LOW | (held >> (LOW_BITS * i as u32)) as u32 & (LOW - 1));
        let mut at = 0;
        for &token in self.tokens.iter().rev() {
            let symbol = &symbols[usize::from(token) & TOKEN_MASK];
            let own = usize::from(token >> STATE_SHIFT) % STATES;
            let x = states[own];
            // The last word comes first.
            words[at % WORDS] = x as u16;
            let over = x >= symbol.limit;
            at += usize::from(over);
            let x = if over { x >> 16 } else { x };
            let quotient = ((u64::from(x) * symbol.reciprocal) >> RECIPROCAL_BITS) as u32;
            states[own] = x + u32::from(symbol.start) + quotient * u32::from(symbol.rest);
        }
        if at > limit / 2 {
            return false;
        }
        let start = bytes.len();
        bytes.extend(words[..at].iter().rev().flat_map(|word| word.to_le_bytes()));
        let mut raw = RawWriter { bytes, buffer: 0, filled: 0 };
        for state in states {
            let more = 31 - LOW_BITS - state.leading_zeros();
            raw.put(4, more);
            raw.put(LOW_BITS + more, state ^ 1 << (LOW_BITS + more));
        }
        for (bits, value) in head {
            raw.put(*bits, *value);
        }
        for bits in raw_bits.iter().chain(&[beyond]).chain(rest) {
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

const SPARE_MASK: u64 = (1 << SPARE_BITS) - 1;

/// The first signs as the states hold them, what is left of the entry that they end in, and the other entries.
fn hold(signs: &[u32]) -> (u64, u32, &[u32]) {
    let mut held = 0;
    let mut count = 0;
    let mut rest = signs;
    while let Some((first, others)) = rest.split_first() {
        let (bits, value) = (first >> 16, first & 0xffff);
        held |= u64::from(value) << count & SPARE_MASK;
        rest = others;
        if count + bits > SPARE_BITS {
            let fit = SPARE_BITS - count;
            return (held, (bits - fit) << 16 | value >> fit, rest);
        }
        count += bits;
    }
    (held, 0, rest)
}

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
