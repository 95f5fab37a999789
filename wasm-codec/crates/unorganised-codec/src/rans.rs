//! Range asymmetric numeral systems (Duda 2013): a 32-bit state, 16-bit words, probabilities in 1/4096. The encoder works
//! backwards, so that the decoder reads words in their order.

/// Bits of a probability.
pub const PROBABILITY_BITS: u32 = 12;
/// The state lies in LOWER…2³²−1 between symbols.
pub const LOWER: u32 = 1 << 16;
const RAW: u32 = 1 << 31;

/// A symbol of a table, ready to be encoded.
#[inline]
pub const fn symbol(start: u16, frequency: u16) -> u32 {
    (frequency as u32) << PROBABILITY_BITS | start as u32
}

/// `bits` (1 to 15) raw bits, ready to be encoded.
#[inline]
pub const fn raw(value: u32, bits: u32) -> u32 {
    RAW | bits << 16 | value
}

/// Encodes backwards: the state, and the words in the order in which they are read, from the end of `words` on.
///
/// @returns the state and how many words were written
pub fn encode(operations: &[u32], words: &mut Vec<u16>) -> u32 {
    words.clear();
    let mut state = LOWER;
    for operation in operations.iter().rev() {
        if operation & RAW != 0 {
            let bits = operation >> 16 & 0xf;
            if state >= 1 << (32 - bits) {
                words.push(state as u16);
                state >>= 16;
            }
            state = state << bits | operation & 0xffff;
        } else {
            let frequency = operation >> PROBABILITY_BITS;
            let start = operation & ((1 << PROBABILITY_BITS) - 1);
            if state >= frequency << 20 {
                words.push(state as u16);
                state >>= 16;
            }
            let whole = state / frequency;
            state = (whole << PROBABILITY_BITS) + (state - whole * frequency) + start;
        }
    }
    words.reverse();
    state
}

/// Reads what [`encode`] wrote.
pub struct RansReader<'a> {
    state: u32,
    words: &'a [[u8; 2]],
}

impl<'a> RansReader<'a> {
    /// `None` where no encoder can have left such a state.
    pub fn new(state: u32, words: &'a [[u8; 2]]) -> Option<Self> {
        (state >= LOWER).then_some(Self { state, words })
    }

    /// The slot 0…4095 in which the next symbol's range lies.
    #[inline]
    pub fn slot(&self) -> u16 {
        (self.state & ((1 << PROBABILITY_BITS) - 1)) as u16
    }

    /// Takes the symbol whose range holds the slot. `None` where the words have ended.
    #[inline]
    pub fn take(&mut self, start: u16, frequency: u16) -> Option<()> {
        let slot = self.slot();
        self.state = u32::from(frequency) * (self.state >> PROBABILITY_BITS) + u32::from(slot - start);
        self.refill()
    }

    /// Takes 1 to 15 raw bits.
    #[inline]
    pub fn raw(&mut self, bits: u32) -> Option<u32> {
        let value = self.state & ((1 << bits) - 1);
        self.state >>= bits;
        self.refill()?;
        Some(value)
    }

    #[inline]
    fn refill(&mut self) -> Option<()> {
        if self.state < LOWER {
            let (word, rest) = self.words.split_first()?;
            self.words = rest;
            self.state = self.state << 16 | u32::from(u16::from_le_bytes(*word));
        }
        Some(())
    }

    /// True where everything was read and the state is the encoder's first.
    pub fn is_finished(&self) -> bool {
        self.words.is_empty() && self.state == LOWER
    }
}
