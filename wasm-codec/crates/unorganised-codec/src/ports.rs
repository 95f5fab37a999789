//! Where an encoder's symbols go: into a packet, into an estimate of its size, or into counts to train tables.

use crate::contexts::SYMBOLS;
use crate::model::Port;
use crate::rans;
use crate::tables::{MAX_VALUE, Table, split};

/// The symbols of the packet in hand.
#[derive(Default)]
pub(crate) struct Writer {
    pub operations: Vec<u32>,
    /// Where each point's operations end.
    pub ends: Vec<usize>,
    /// In 1/256 bit.
    pub cost: u32,
}

impl Writer {
    pub fn clear(&mut self) {
        self.operations.clear();
        self.ends.clear();
        self.ends.push(0);
        self.cost = 0;
    }
}

/// The point lies too far from the packet's first one.
pub(crate) struct TooFar;

/// Notes symbols.
pub(crate) struct Emit<'a> {
    pub tables: &'a [Table],
    pub writer: &'a mut Writer,
}

impl Port for Emit<'_> {
    type Error = TooFar;

    #[inline]
    fn code(&mut self, table: usize, value: u32) -> Result<u32, TooFar> {
        if value > MAX_VALUE {
            return Err(TooFar);
        }
        let (symbol, bits, rest) = split(value);
        let table = &self.tables[table];
        let start = table.starts[symbol];
        self.writer.operations.push(rans::symbol(start, table.starts[symbol + 1] - start));
        if bits > 0 {
            self.writer.operations.push(rans::raw(rest, bits));
        }
        self.writer.cost += u32::from(table.costs[symbol]);
        Ok(value)
    }

    fn impossible(&self) -> TooFar {
        TooFar
    }
}

/// Adds up what symbols would cost.
pub(crate) struct Estimate<'a> {
    pub tables: &'a [Table],
    pub cost: u64,
}

impl Port for Estimate<'_> {
    type Error = TooFar;

    #[inline]
    fn code(&mut self, table: usize, value: u32) -> Result<u32, TooFar> {
        if value > MAX_VALUE {
            return Err(TooFar);
        }
        self.cost += u64::from(self.tables[table].costs[split(value).0]);
        Ok(value)
    }

    fn impossible(&self) -> TooFar {
        TooFar
    }
}

/// Counts symbols.
pub(crate) struct Counter<'a> {
    pub counts: &'a mut [[u64; SYMBOLS]],
}

impl Port for Counter<'_> {
    type Error = TooFar;

    fn code(&mut self, table: usize, value: u32) -> Result<u32, TooFar> {
        if value > MAX_VALUE {
            return Err(TooFar);
        }
        self.counts[table][split(value).0] += 1;
        Ok(value)
    }

    fn impossible(&self) -> TooFar {
        TooFar
    }
}
