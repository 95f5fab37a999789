//! A packet's body, and its raw bits.

use super::{RAW_BYTES, WORDS};

/// A packet's body as words from its beginning, with room for four to be read at once, and as bytes from its end.
pub struct Body {
    pub(super) words: Box<[u16; WORDS + 4]>,
    pub(super) raw: Box<[u8; RAW_BYTES + 8]>,
    pub(super) length: usize,
}

impl Default for Body {
    fn default() -> Self {
        Self { words: Box::new([0; WORDS + 4]), raw: Box::new([0; RAW_BYTES + 8]), length: 0 }
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
pub(super) struct RawReader<'a> {
    bytes: &'a [u8; RAW_BYTES + 8],
    at: usize,
}

impl<'a> RawReader<'a> {
    /// At the beginning.
    #[inline(always)]
    pub(super) const fn new(bytes: &'a [u8; RAW_BYTES + 8]) -> Self {
        Self { bytes, at: 0 }
    }

    /// Bits taken so far.
    #[inline(always)]
    pub(super) const fn at(&self) -> usize {
        self.at
    }

    /// 32 bits at most.
    #[inline(always)]
    pub(super) fn take(&mut self, bits: u32) -> u32 {
        let at = self.at / 8 % RAW_BYTES;
        let eight: &[u8; 8] = self.bytes[at..at + 8].first_chunk().expect("eight bytes");
        let window = u64::from_le_bytes(*eight) >> (self.at % 8);
        self.at += bits as usize;
        (window & ((1 << bits) - 1)) as u32
    }
}
