//! The static probability tables: sets of geometry and colour tables, of which a packet names one each.
//!
//! They are kept as frequencies out of 512 in `tables.bin`, little-endian u16: [`GEOMETRY_SETS`] sets of
//! [`GEOMETRY_CONTEXTS`] contexts of 16 symbols, then [`COLOUR_SETS`] sets of [`COLOUR_CONTEXTS`] contexts. They are made by
//! `cargo run --release -p xtask -- train-tables`, from synthetic scenes alone.

use bytemuck::must_cast;
use wide::{i8x16, i16x16};

use crate::contexts::{
    CERTAIN, COLOUR_CONTEXTS, CONTEXTS, DEPTH, GEOMETRY_CONTEXTS, INDEX, PLANE_CONTEXTS, SYMBOLS,
};
use crate::rans::{EncoderSymbol, PROBABILITY_BITS, TOTAL};

/// Which tables a stream is coded with; part of the stream header.
pub const TABLE_VERSION: u8 = 2;
/// Geometry sets to choose from.
pub const GEOMETRY_SETS: usize = 8;
/// Colour sets to choose from.
pub const COLOUR_SETS: usize = 4;
/// Places for contexts: a power of two, so that a place is within with no more than a mask.
pub const CONTEXT_SLOTS: usize = 512;

/// Frequencies of a context of which nothing is known.
pub const EVEN: [u16; SYMBOLS] = [TOTAL / SYMBOLS as u16; SYMBOLS];

const BYTES: &[u8] = include_bytes!("tables.bin");
const ENTRIES: usize = (GEOMETRY_SETS * GEOMETRY_CONTEXTS + COLOUR_SETS * COLOUR_CONTEXTS) * SYMBOLS;
const PLACES: usize = CONTEXT_SLOTS * SYMBOLS;

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

/// The frequencies of all sets, with a stream's own ones of palette indices where it has some.
fn frequencies(index_frequencies: &[[u16; SYMBOLS]]) -> Vec<u16> {
    let (frequencies, _) = BYTES.as_chunks::<2>();
    let mut frequencies: Vec<u16> = frequencies.iter().map(|bytes| u16::from_le_bytes(*bytes)).collect();
    assert_eq!(frequencies.len(), ENTRIES);
    for set in 0..COLOUR_SETS {
        let start = colour_base(set) + (INDEX - GEOMETRY_CONTEXTS) * SYMBOLS;
        let own = index_frequencies.as_flattened();
        frequencies[start..start + own.len()].copy_from_slice(own);
    }
    frequencies
}

/// Of two chosen sets, one after the other, what belongs to them of what all sets have.
fn chosen<T: Copy>(all: &[T], (geometry, colour): Sets, into: &mut [T; PLACES]) {
    let (own_geometry, rest) = into.split_at_mut(GEOMETRY_CONTEXTS * SYMBOLS);
    own_geometry.copy_from_slice(&all[geometry_base(geometry.into())..][..GEOMETRY_CONTEXTS * SYMBOLS]);
    let own_colour = &mut rest[..COLOUR_CONTEXTS * SYMBOLS];
    own_colour.copy_from_slice(&all[colour_base(colour.into())..][..COLOUR_CONTEXTS * SYMBOLS]);
}

/// A geometry and a colour set.
pub type Sets = (u8, u8);

fn places<T: Copy + core::fmt::Debug>(fill: T) -> Box<[T; PLACES]> {
    vec![fill; PLACES].into_boxed_slice().try_into().expect("as many")
}

/// What an encoder needs of all sets, and those of the two that it uses.
pub struct EncoderTables {
    all_symbols: Vec<EncoderSymbol>,
    all_costs: Vec<u16>,
    sets: Option<Sets>,
    symbols: Box<[EncoderSymbol; PLACES]>,
    costs: Box<[u16; PLACES]>,
}

impl EncoderTables {
    /// The tables of [`TABLE_VERSION`], with a stream's own frequencies of palette indices where it has some.
    #[must_use]
    pub fn new(index_frequencies: &[[u16; SYMBOLS]]) -> Self {
        let frequencies = frequencies(index_frequencies);
        let mut all_symbols = Vec::with_capacity(ENTRIES);
        let mut all_costs = Vec::with_capacity(ENTRIES);
        for context in frequencies.as_chunks::<SYMBOLS>().0 {
            let mut start = 0;
            for frequency in context {
                assert!(*frequency > 0);
                let frequency = u32::from(*frequency);
                all_symbols.push(EncoderSymbol::new(start, frequency));
                let bits = PROBABILITY_BITS as f32 - (frequency as f32).log2();
                all_costs.push((bits * 256.0 + 0.5) as u16);
                start += frequency;
            }
            assert_eq!(start, u32::from(TOTAL));
        }
        let mut tables = Self {
            all_symbols,
            all_costs,
            sets: None,
            symbols: places(EncoderSymbol::default()),
            costs: places(0),
        };
        tables.choose((0, 0));
        tables
    }

    /// Takes the sets for the next packets.
    pub fn choose(&mut self, sets: Sets) {
        if self.sets != Some(sets) {
            self.sets = Some(sets);
            chosen(&self.all_symbols, sets, &mut self.symbols);
            chosen(&self.all_costs, sets, &mut self.costs);
        }
    }

    /// Of the chosen sets, by context and symbol.
    #[inline(always)]
    pub(crate) fn symbols(&self) -> &[EncoderSymbol; PLACES] {
        &self.symbols
    }

    /// Cost of each symbol in 1/256 bit, of the chosen sets.
    #[inline(always)]
    #[must_use]
    pub fn costs(&self) -> &[u16; PLACES] {
        &self.costs
    }

    /// Costs of all sets: see [`geometry_base`], [`colour_base`].
    #[must_use]
    pub fn all_costs(&self) -> &[u16] {
        &self.all_costs
    }
}

/// What a decoder needs of the two sets that a packet uses.
pub struct DecoderTables {
    frequencies: Vec<u16>,
    sets: Option<Sets>,
    /// For the contexts of planes, of every slot: there a look is faster than a search.
    slots: Box<[Share; SLOTS]>,
    /// Where the shares end, less 1.
    ends: Box<[[u16; SYMBOLS]; CONTEXT_SLOTS]>,
    /// By context and symbol.
    shares: Box<[Share; PLACES]>,
}

/// A symbol << 20 | where its share of [`TOTAL`] begins << 10 | how long it is.
pub(crate) type Share = u32;
/// Where a share's parts lie, and the mask of the lower two.
pub(crate) const SHARE_START: u32 = 10;
pub(crate) const SHARE_SYMBOL: u32 = 20;
pub(crate) const SHARE_MASK: u32 = (1 << SHARE_START) - 1;
const _: () = assert!(TOTAL as u32 <= SHARE_MASK);

/// Slots of all contexts, [`TOTAL`] each.
pub(crate) const SLOTS: usize = CONTEXT_SLOTS << PROBABILITY_BITS;

impl DecoderTables {
    /// As [`EncoderTables::new`].
    #[must_use]
    pub fn new(index_frequencies: &[[u16; SYMBOLS]]) -> Self {
        let mut slots = vec![0; SLOTS];
        // Symbol 0 has all.
        slots[CERTAIN << PROBABILITY_BITS..][..TOTAL.into()].fill(TOTAL.into());
        let ends = vec![[0; SYMBOLS]; CONTEXT_SLOTS];
        Self {
            frequencies: frequencies(index_frequencies),
            sets: None,
            slots: slots.into_boxed_slice().try_into().expect("as many"),
            ends: ends.into_boxed_slice().try_into().expect("as many"),
            shares: places(0),
        }
    }

    /// Takes the sets for the next packet.
    pub fn choose(&mut self, sets: Sets) {
        let (geometry, colour) = sets;
        let before = self.sets.replace(sets);
        if before.is_none_or(|(own, _)| own != geometry) {
            self.fill(0..GEOMETRY_CONTEXTS, geometry_base(geometry.into()));
        }
        if before.is_none_or(|(_, own)| own != colour) {
            self.fill(GEOMETRY_CONTEXTS..CONTEXTS, colour_base(colour.into()));
        }
    }

    fn fill(&mut self, contexts: core::ops::Range<usize>, base: usize) {
        let (own, _) = self.frequencies[base..].as_chunks::<SYMBOLS>();
        let (shares, _) = self.shares.as_chunks_mut::<SYMBOLS>();
        let (slots, _) = self.slots.as_chunks_mut::<{ TOTAL as usize }>();
        for (context, frequencies) in contexts.zip(own) {
            let of_plane =
                [DEPTH, INDEX].iter().any(|base| (*base..base + PLANE_CONTEXTS).contains(&context));
            let mut start = 0;
            for (symbol, frequency) in frequencies.iter().enumerate() {
                let end = start + usize::from(*frequency);
                let share =
                    (symbol as u32) << SHARE_SYMBOL | (start as u32) << SHARE_START | u32::from(*frequency);
                shares[context][symbol] = share;
                self.ends[context][symbol] = (end - 1) as u16;
                if of_plane {
                    slots[context][start..end].fill(share);
                }
                start = end;
            }
        }
    }

    /// The share that each slot of 512 lies in, of planes' contexts and the certain one.
    #[inline(always)]
    pub(crate) fn slots(&self) -> &[Share; SLOTS] {
        &self.slots
    }

    /// The same of any context but the certain one, by a search, which touches less memory: how many shares end before it.
    #[inline(always)]
    pub(crate) fn search(&self, context: usize, slot: u32) -> Share {
        let ends: i16x16 = must_cast(self.ends[context % CONTEXT_SLOTS]);
        let before = i16x16::splat(slot as i16).simd_gt(ends);
        let symbol = (!i8x16::from_i16x16_saturate(before).to_bitmask()).trailing_zeros();
        self.shares[(context * SYMBOLS + symbol as usize) % PLACES]
    }
}

/// Counts to frequencies: their sum is [`TOTAL`] and none is 0. Unseen symbols get the least share.
#[must_use]
pub fn normalise(counts: &[f64; SYMBOLS]) -> [u16; SYMBOLS] {
    let total: f64 = counts.iter().sum();
    let whole = f64::from(TOTAL);
    let mut frequencies = [1_u16; SYMBOLS];
    if total > 0.0 {
        for (frequency, count) in frequencies.iter_mut().zip(counts) {
            *frequency = (count / total * whole).round().max(1.0) as u16;
        }
    } else {
        frequencies = EVEN;
    }
    loop {
        let sum: i32 = frequencies.iter().map(|f| i32::from(*f)).sum();
        let missing = i32::from(TOTAL) - sum;
        if missing == 0 {
            return frequencies;
        }
        // The largest share bears the change best.
        let largest = frequencies.iter_mut().max().expect("16 symbols");
        *largest = (i32::from(*largest) + missing).max(i32::from(*largest) / 2 + 1) as u16;
    }
}
