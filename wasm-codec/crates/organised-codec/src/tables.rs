//! The static probability tables: sets of geometry and colour tables, of which a packet names one each.
//!
//! They are kept as frequencies out of 4096 in `tables.bin`, little-endian u16: [`GEOMETRY_SETS`] sets of
//! [`GEOMETRY_CONTEXTS`] contexts of 16 symbols, then [`COLOUR_SETS`] sets of [`COLOUR_CONTEXTS`] contexts. They are made by
//! `cargo run --release -p xtask -- train-tables`, from synthetic scenes alone.

use crate::contexts::{COLOUR_CONTEXTS, GEOMETRY_CONTEXTS, INDEX, SYMBOLS};
use crate::rans::{EncoderSymbol, PROBABILITY_BITS};

/// Which tables a stream is coded with; part of the stream header.
pub const TABLE_VERSION: u8 = 1;
/// Geometry sets to choose from.
pub const GEOMETRY_SETS: usize = 8;
/// Colour sets to choose from.
pub const COLOUR_SETS: usize = 4;

const BYTES: &[u8] = include_bytes!("tables.bin");
const ENTRIES: usize = (GEOMETRY_SETS * GEOMETRY_CONTEXTS + COLOUR_SETS * COLOUR_CONTEXTS) * SYMBOLS;

/// All sets, ready for use.
pub struct Tables {
    encoder: Vec<EncoderSymbol>,
    costs: Vec<u16>,
    ends: Vec<[u16; SYMBOLS]>,
}

impl Default for Tables {
    fn default() -> Self {
        Self::new(&[])
    }
}

impl Tables {
    /// The tables of [`TABLE_VERSION`], with a stream's own frequencies of palette indices where it has some.
    #[must_use]
    pub fn new(index_frequencies: &[[u16; SYMBOLS]]) -> Self {
        let (frequencies, _) = BYTES.as_chunks::<2>();
        let mut frequencies: Vec<u16> = frequencies.iter().map(|bytes| u16::from_le_bytes(*bytes)).collect();
        for set in 0..COLOUR_SETS {
            let start = Self::colour_base(set) + INDEX * SYMBOLS;
            let own = index_frequencies.as_flattened();
            frequencies[start..start + own.len()].copy_from_slice(own);
        }
        Self::from_frequencies(&frequencies)
    }

    /// From frequencies in the order of the file; each context's sum is 4096 and none is 0.
    ///
    /// # Panics
    /// If they are not.
    #[must_use]
    pub fn from_frequencies(frequencies: &[u16]) -> Self {
        assert_eq!(frequencies.len(), ENTRIES);
        let mut tables = Self {
            encoder: Vec::with_capacity(ENTRIES),
            costs: Vec::with_capacity(ENTRIES),
            ends: Vec::with_capacity(ENTRIES / SYMBOLS),
        };
        for context in frequencies.as_chunks::<SYMBOLS>().0 {
            let mut start = 0;
            let mut ends = [0; SYMBOLS];
            for (end, frequency) in ends.iter_mut().zip(context) {
                assert!(*frequency > 0);
                let frequency = u32::from(*frequency);
                tables.encoder.push(EncoderSymbol::new(start, frequency));
                let bits = PROBABILITY_BITS as f32 - (frequency as f32).log2();
                tables.costs.push((bits * 256.0 + 0.5) as u16);
                start += frequency;
                *end = (start - 1) as u16;
            }
            assert_eq!(start, 1 << PROBABILITY_BITS);
            tables.ends.push(ends);
        }
        tables
    }

    pub(crate) fn encoder_symbols(&self) -> &[EncoderSymbol] {
        &self.encoder
    }

    /// Cost of each symbol in 1/256 bit.
    #[must_use]
    pub fn costs(&self) -> &[u16] {
        &self.costs
    }

    /// First entry of a geometry set.
    #[must_use]
    pub const fn geometry_base(set: usize) -> usize {
        set * GEOMETRY_CONTEXTS * SYMBOLS
    }

    /// First entry of a colour set.
    #[must_use]
    pub const fn colour_base(set: usize) -> usize {
        (GEOMETRY_SETS * GEOMETRY_CONTEXTS + set * COLOUR_CONTEXTS) * SYMBOLS
    }

    /// Where the shares of a geometry set end, less 1.
    #[must_use]
    pub fn geometry(&self, set: usize) -> &[[u16; SYMBOLS]] {
        &self.ends[set * GEOMETRY_CONTEXTS..][..GEOMETRY_CONTEXTS]
    }

    /// Where the shares of a colour set end, less 1.
    #[must_use]
    pub fn colour(&self, set: usize) -> &[[u16; SYMBOLS]] {
        &self.ends[GEOMETRY_SETS * GEOMETRY_CONTEXTS + set * COLOUR_CONTEXTS..][..COLOUR_CONTEXTS]
    }
}

/// Counts to frequencies: their sum is 4096 and none is 0. Unseen symbols get the least share.
#[must_use]
pub fn normalise(counts: &[f64; SYMBOLS]) -> [u16; SYMBOLS] {
    let total: f64 = counts.iter().sum();
    let whole = f64::from(1u32 << PROBABILITY_BITS);
    let mut frequencies = [1_u16; SYMBOLS];
    if total > 0.0 {
        for (frequency, count) in frequencies.iter_mut().zip(counts) {
            *frequency = (count / total * whole).round().max(1.0) as u16;
        }
    } else {
        frequencies = [256; SYMBOLS];
    }
    loop {
        let sum: i32 = frequencies.iter().map(|f| i32::from(*f)).sum();
        let missing = (1 << PROBABILITY_BITS) - sum;
        if missing == 0 {
            return frequencies;
        }
        // The largest share bears the change best.
        let largest = frequencies.iter_mut().max().expect("16 symbols");
        *largest = (i32::from(*largest) + missing).max(i32::from(*largest) / 2 + 1) as u16;
    }
}
