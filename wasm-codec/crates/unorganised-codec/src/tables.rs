//! Symbols and their static tables. A value 0…131071 is a symbol and raw bits: 0…15 stand for themselves; above, the
//! symbol holds the exponent and the bit below the highest, the rest is raw.

use crate::contexts::{SYMBOLS, TABLE_COUNT};
use crate::rans::PROBABILITY_BITS;
use crate::tables_data::FREQUENCIES;

/// The largest value that has a symbol.
pub const MAX_VALUE: u32 = 131_071;
const DIRECT: u32 = 16;
const TOTAL: u32 = 1 << PROBABILITY_BITS;
const HINTS: usize = 64;
const HINT_SHIFT: u32 = PROBABILITY_BITS - 6;

/// Symbol, number of raw bits and their value.
#[inline]
pub const fn split(value: u32) -> (usize, u32, u32) {
    if value < DIRECT {
        return (value as usize, 0, 0);
    }
    let exponent = 31 - value.leading_zeros();
    let bits = exponent - 1;
    let symbol = DIRECT + 2 * (exponent - 4) + (value >> bits & 1);
    (symbol as usize, bits, value & ((1 << bits) - 1))
}

/// The least value of a symbol and its number of raw bits.
#[inline]
pub const fn base(symbol: u32) -> (u32, u32) {
    if symbol < DIRECT {
        return (symbol, 0);
    }
    let bits = (symbol - DIRECT) / 2 + 3;
    (((symbol & 1) | 2) << bits, bits)
}

/// One table as the coder wants it.
pub struct Table {
    /// Where each symbol's range begins; one more for the end.
    pub starts: [u16; SYMBOLS + 1],
    /// The symbol in whose range slot 64·i lies.
    hints: [u8; HINTS],
    /// Cost of each symbol with its raw bits in 1/256 bit, rounded up.
    pub costs: [u16; SYMBOLS],
}

impl Table {
    fn new(frequencies: &[u16; SYMBOLS]) -> Self {
        let mut starts = [0; SYMBOLS + 1];
        let mut costs = [0; SYMBOLS];
        for (i, frequency) in frequencies.iter().enumerate() {
            starts[i + 1] = starts[i] + frequency;
            costs[i] = cost(*frequency) + base(i as u32).1 as u16 * 256;
        }
        debug_assert_eq!(u32::from(starts[SYMBOLS]), TOTAL);
        let hints = std::array::from_fn(|i| {
            (starts.iter().rposition(|start| *start <= (i << HINT_SHIFT) as u16).unwrap_or(0))
                .min(SYMBOLS - 1) as u8
        });
        Self { starts, hints, costs }
    }

    /// The symbol in whose range the slot lies.
    #[inline]
    pub fn find(&self, slot: u16) -> usize {
        let mut symbol = usize::from(self.hints[usize::from(slot >> HINT_SHIFT) % HINTS]);
        while symbol + 1 < SYMBOLS && self.starts[symbol + 1] <= slot {
            symbol += 1;
        }
        symbol
    }
}

/// −log₂(frequency / 4096) in 1/256 bit, rounded up; in integers, so that every machine makes the same packets.
fn cost(frequency: u16) -> u16 {
    let exponent = frequency.ilog2();
    let mut mantissa = u64::from(frequency) << (30 - exponent);
    let mut logarithm = exponent * 256;
    for bit in (0..8).rev() {
        mantissa = (mantissa * mantissa) >> 30;
        if mantissa >= 1 << 31 {
            mantissa >>= 1;
            logarithm += 1 << bit;
        }
    }
    (PROBABILITY_BITS * 256 - logarithm) as u16
}

/// All tables, by their index.
pub fn all() -> Vec<Table> {
    FREQUENCIES.iter().take(TABLE_COUNT).map(Table::new).collect()
}

/// Counts to frequencies that add up to 4096, none of them 0: what the training writes.
#[must_use]
pub fn normalise(counts: &[u64; SYMBOLS]) -> [u16; SYMBOLS] {
    let sum: u64 = counts.iter().sum::<u64>().max(1);
    let spare = u64::from(TOTAL) - SYMBOLS as u64;
    let mut frequencies = counts.map(|count| (count * spare / sum) as u16 + 1);
    let used: u32 = frequencies.iter().map(|frequency| u32::from(*frequency)).sum();
    let largest = (0..SYMBOLS).max_by_key(|i| (frequencies[*i], SYMBOLS - i)).unwrap_or(0);
    frequencies[largest] += (TOTAL - used) as u16;
    frequencies
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_is_a_symbol_and_raw_bits() {
        for value in 0..131_072 {
            let (symbol, bits, rest) = split(value);
            assert!(symbol < SYMBOLS && bits <= 15);
            assert_eq!(base(symbol as u32), (value - rest, bits));
        }
    }

    #[test]
    fn tables_are_whole_and_found_by_slot() {
        for table in all() {
            assert_eq!(table.starts[SYMBOLS], 4096);
            for slot in 0..4096 {
                let symbol = table.find(slot);
                assert!(table.starts[symbol] <= slot && slot < table.starts[symbol + 1]);
            }
        }
    }

    #[test]
    fn the_published_tables_are_these() {
        let published: Vec<Vec<u16>> =
            serde_json::from_str(include_str!("../vectors/tables.json")).expect("numbers");
        assert!(published.iter().map(Vec::as_slice).eq(FREQUENCIES.iter().map(<[u16; SYMBOLS]>::as_slice)));
    }

    #[test]
    fn costs_are_logarithms_rounded_up() {
        for frequency in 1..4096 {
            let exact = (12.0 - f64::from(frequency).log2()) * 256.0;
            let rounded = f64::from(cost(frequency));
            assert!(rounded >= exact - 1e-3 && rounded < exact + 1.01, "{frequency}: {rounded} {exact}");
        }
    }

    #[test]
    fn normalised_counts_add_up() {
        let mut counts = [0; SYMBOLS];
        counts[3] = 1_000_000;
        counts[40] = 1;
        let frequencies = normalise(&counts);
        assert_eq!(frequencies.iter().map(|f| u32::from(*f)).sum::<u32>(), 4096);
        assert!(frequencies.iter().all(|f| *f > 0));
    }
}
