//! The entropy coder: range asymmetric numeral systems (Duda, arXiv:1311.2540) with static tables of 9 bits, four states
//! side by side, 16-bit words; and a stream of raw bits beside them.

mod body;
mod decoder;
mod encoder_symbol;
mod packet_tokens;
mod plane_decoder;
mod tile_tokens;

pub use body::Body;
pub use decoder::Decoder;
pub use encoder_symbol::EncoderSymbol;
pub use packet_tokens::{Held, Mark, PacketTokens};
pub use plane_decoder::{PlaneDecoder, Step};
pub use tile_tokens::{TileTokens, token};

/// Bits of a probability: so few that what a decoder looks up for each slot of each context stays in the fastest memory. More
/// would save 0.3 % of the bits of a frame at the most.
pub const PROBABILITY_BITS: u32 = 9;
/// What a context's frequencies add up to.
pub const TOTAL: u16 = 1 << PROBABILITY_BITS;
/// Lower end of a state's interval [2¹⁵, 2³¹); also what the encoder begins with and the decoder must end with.
pub const LOW: u32 = 1 << LOW_BITS;
pub(crate) const LOW_BITS: u32 = 15;
/// States side by side.
pub const STATES: usize = 4;
/// A raw value has at most so many bits.
pub const MAX_RAW_BITS: u32 = 16;

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
    ESCAPES[2] - 1 + code_octaves(raw, number.wrapping_sub(ESCAPES[2] - 1) & 0xffff)
}

/// The raw bits of a number from 1 to 65535: 4 bits n, then n bits of it below its highest bit, 2ⁿ.
#[inline(always)]
pub fn code_octaves(mut raw: impl FnMut(u32, u32) -> u32, number: u32) -> u32 {
    let octave = raw(4, number.checked_ilog2().unwrap_or(0));
    1 << octave | raw(octave, number & ((1 << octave) - 1))
}

/// Where the state of a token begins, above its context and symbol.
pub(crate) const STATE_SHIFT: u32 = 13;
pub(crate) const TOKEN_MASK: usize = (1 << STATE_SHIFT) - 1;

/// Stands for no token, where there is no pixel.
pub const NO_TOKEN: i16 = -1;

/// Words that a body may have, and more: a power of two.
pub const WORDS: usize = 1024;
pub(crate) const RAW_BYTES: usize = 2048;

/// What the states can hold beside the highest bit that they end with.
pub(crate) const SPARE_BITS: u32 = LOW_BITS * STATES as u32;
