//! A frame of points into packets.

use crate::Point;
use crate::model::{Model, Port, Start};
use crate::order::{Order, Sorter, bounds, is_ordered};
use crate::packet::{
    AttributeKind, CHECK_BYTES, HEADER_BYTES, Header, MAX_PACKET_BYTES, MAX_POINTS_PER_PACKET,
    MIN_PACKET_BYTES,
};
use crate::predictor::Mode;
use crate::quantise::{Attribute, GridPoint, Rejected, find_levels, quantise};
use crate::rans;
use crate::tables::{MAX_VALUE, Table, all, split};
use crate::thinning::{Weights, thin};

/// How a frame is encoded.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// Grid step, 1 to 100 mm; a coordinate is wrong by half of it at most.
    pub step_mm: u8,
    /// What the fourth word holds.
    pub attribute: Attribute,
    /// The order of the points.
    pub order: Order,
    /// 128 to 1200.
    pub max_packet_bytes: usize,
    /// Points are left out until all packets together have no more bytes.
    pub budget_bytes: Option<usize>,
    /// How fast the share of kept points falls with range where there is a budget; 0 is even. 0 to 8.
    pub lambda: f32,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            step_mm: 10,
            attribute: Attribute::Colour,
            order: Order::Auto,
            max_packet_bytes: MAX_PACKET_BYTES,
            budget_bytes: None,
            lambda: 0.0,
        }
    }
}

/// A setting outside its range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InvalidSettings {
    /// Not 1 to 100 mm.
    Step,
    /// Not 128 to 1200 bytes.
    PacketBytes,
    /// Not 0 to 8.
    Lambda,
    /// More than 2²⁴ points.
    TooManyPoints,
}

/// What became of a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EncodeReport {
    /// Points in the packets.
    pub kept: usize,
    /// Points left out for the budget.
    pub thinned: usize,
    /// Points that cannot be sent.
    pub rejected: Rejected,
    /// Packets.
    pub packets: usize,
    /// Bytes of all packets together.
    pub bytes: usize,
}

#[derive(Clone, Copy)]
struct Written {
    offset: usize,
    length: usize,
    count: usize,
    /// Mean square of the distance from the origin.
    distance: f32,
}

/// Encodes frames; its memory is kept from one to the next.
pub struct Encoder {
    tables: Vec<Table>,
    points: Vec<GridPoint>,
    order: Vec<u32>,
    other_order: Vec<u32>,
    sorter: Sorter,
    weights: Weights,
    kept: Vec<u32>,
    writer: Writer,
    words: Vec<u16>,
    bytes: Vec<u8>,
    written: Vec<Written>,
}

impl Default for Encoder {
    fn default() -> Self {
        Self::new()
    }
}

/// Far above any sensor's frame.
const MAX_POINTS: usize = 1 << 24;
/// What rANS may waste in a packet, and the rounding of costs, 1/256 bit.
const SLACK: u32 = 64 * 256;
/// Trials of how many points fit a budget.
const TRIALS: usize = 8;

impl Encoder {
    /// An encoder without packets.
    #[must_use]
    pub fn new() -> Self {
        Self {
            tables: all(),
            points: Vec::new(),
            order: Vec::new(),
            other_order: Vec::new(),
            sorter: Sorter::default(),
            weights: Weights::default(),
            kept: Vec::new(),
            writer: Writer::default(),
            words: Vec::new(),
            bytes: Vec::new(),
            written: Vec::new(),
        }
    }

    /// Encodes a frame; [`Encoder::packets`] gives the packets until the next call.
    ///
    /// # Errors
    /// For settings out of range, and more than 2²⁴ points.
    pub fn encode(&mut self, frame: &[Point], settings: &Settings) -> Result<EncodeReport, InvalidSettings> {
        self.bytes.clear();
        self.written.clear();
        check(frame, settings)?;
        self.points.clear();
        let rejected = quantise(frame, settings.attribute, settings.step_mm, &mut self.points);
        let (kind, top) = match settings.attribute {
            Attribute::None => (AttributeKind::None, 0),
            Attribute::Colour => (AttributeKind::Colour, 0),
            _ => (AttributeKind::Intensity, find_levels(&mut self.points)),
        };
        let mode = self.arrange(settings.order);
        let plan = Plan { mode, kind, top, step_mm: settings.step_mm, max_bytes: settings.max_packet_bytes };

        let order = std::mem::take(&mut self.order);
        self.pack(&order, plan);
        if let Some(budget) = settings.budget_bytes.filter(|budget| self.bytes.len() > *budget) {
            self.fit(&order, plan, budget, settings.lambda);
        }
        self.order = order;
        // Nearest first; equal ones as they were packed.
        self.written.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        if let Some(budget) = settings.budget_bytes {
            while self.written.iter().map(|packet| packet.length).sum::<usize>() > budget {
                self.written.pop();
            }
        }
        let kept = self.written.iter().map(|packet| packet.count).sum();
        Ok(EncodeReport {
            kept,
            thinned: self.points.len() - kept,
            rejected,
            packets: self.written.len(),
            bytes: self.written.iter().map(|packet| packet.length).sum(),
        })
    }

    /// The packets of the last frame, those nearest to the origin first.
    pub fn packets(&self) -> impl ExactSizeIterator<Item = &[u8]> {
        self.written.iter().map(|packet| &self.bytes[packet.offset..packet.offset + packet.length])
    }

    /// Where the packets lie in [`Encoder::bytes`]: offset, length and points of each, in the order of
    /// [`Encoder::packets`].
    pub fn extents(&self) -> impl ExactSizeIterator<Item = [usize; 3]> {
        self.written.iter().map(|packet| [packet.offset, packet.length, packet.count])
    }

    /// The memory in which the packets lie.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Counts how often each table codes each symbol in a frame: for training.
    ///
    /// # Errors
    /// As [`Encoder::encode`].
    pub fn count_symbols(
        &mut self,
        frame: &[Point],
        settings: &Settings,
        step_mode: bool,
        counts: &mut [[u64; crate::SYMBOLS]],
    ) -> Result<(), InvalidSettings> {
        self.encode(frame, settings)?;
        let mode = if step_mode { Mode::Step } else { self.arrange(settings.order) };
        let kind = match settings.attribute {
            Attribute::None => AttributeKind::None,
            Attribute::Colour => AttributeKind::Colour,
            _ => AttributeKind::Intensity,
        };
        let top = self.points.iter().map(|point| point.attribute).max().unwrap_or(1).clamp(1, 255) as u8;
        // Packets of about as many points as real ones.
        for packet in self.order.chunks(700) {
            let first = self.points[packet[0] as usize];
            let mut model = Model::new(Start { mode, kind, top, first });
            let mut port = Counter { counts };
            for index in &packet[1..] {
                let Ok(_) = model.code(&mut port, self.points[*index as usize]) else { break };
            }
        }
        Ok(())
    }

    /// Fills `order` and chooses the predictor.
    fn arrange(&mut self, order: Order) -> Mode {
        let ordered = match order {
            Order::Auto => is_ordered(&self.points),
            other => other == Order::AsGiven,
        };
        if ordered {
            self.order.clear();
            self.order.extend(0..self.points.len() as u32);
        } else if order == Order::Morton {
            self.sorter.morton(&self.points, &mut self.order);
        } else {
            self.sorter.sweep(&self.points, &mut self.order);
        }
        self.split_far_apart();
        let (mode, cost) = self.cheapest_mode(&self.order);
        if ordered || order != Order::Auto {
            return mode;
        }
        let mut other = std::mem::take(&mut self.other_order);
        self.sorter.morton(&self.points, &mut other);
        std::mem::swap(&mut self.order, &mut other);
        self.other_order = other;
        self.split_far_apart();
        let (other_mode, other_cost) = self.cheapest_mode(&self.order);
        if other_cost <= cost {
            return other_mode;
        }
        std::mem::swap(&mut self.order, &mut self.other_order);
        mode
    }

    /// A packet's coordinates are 16 bits: where the cloud is larger, by cubes of 2¹⁵ steps, each in the order it had.
    fn split_far_apart(&mut self) {
        let [least, greatest] = bounds(&self.points);
        if (0..3).any(|axis| greatest[axis].saturating_sub(least[axis]) > 32_767) {
            let points = &self.points;
            self.order.sort_by_key(|index| points[*index as usize].at.map(|coordinate| coordinate >> 15));
        }
    }

    /// The predictor that codes some runs of points with the fewest bits, and how many.
    fn cheapest_mode(&self, order: &[u32]) -> (Mode, u64) {
        const RUNS: usize = 16;
        const LENGTH: usize = 96;
        let stride = (order.len() / RUNS).max(1);
        let cost_of = |mode: Mode| -> u64 {
            let mut port = Estimate { tables: &self.tables, cost: 0 };
            for run in order.chunks(stride).map(|run| &run[..run.len().min(LENGTH)]) {
                let first = self.points[run[0] as usize];
                let mut model = Model::new(Start { mode, kind: AttributeKind::None, top: 0, first });
                for index in &run[1..] {
                    let Ok(_) = model.code(&mut port, self.points[*index as usize]) else { break };
                }
            }
            port.cost
        };
        let costs = Mode::ALL.map(|mode| (mode, cost_of(mode)));
        costs.into_iter().min_by_key(|(_, cost)| *cost).unwrap_or((Mode::Step, 0))
    }

    /// Tries how many points fit.
    fn fit(&mut self, order: &[u32], plan: Plan, budget: usize, lambda: f32) {
        let mut weights = std::mem::take(&mut self.weights);
        let mut kept = std::mem::take(&mut self.kept);
        weights.fill(&self.points, plan.step_mm, lambda);
        // `low` points fit, `high` do not.
        let (mut low, mut high) = (0.0, self.points.len() as f32);
        let mut count = high;
        for trial in 0..TRIALS {
            let size = self.bytes.len().max(1);
            // A little under the budget; points far apart take more bits.
            let aimed = count * (0.98 * budget as f32 / size as f32).powf(if trial == 0 { 1.3 } else { 1.1 });
            count = if aimed > low && aimed < high { aimed } else { (low + high) / 2.0 };
            thin(order, &weights.each, weights.scale_for(count), &mut kept);
            self.pack(&kept, plan);
            if self.bytes.len() > budget {
                high = count;
            } else {
                low = count;
                if self.bytes.len() * 100 >= budget * 96 {
                    break;
                }
            }
        }
        if self.bytes.len() > budget {
            thin(order, &weights.each, weights.scale_for(low), &mut kept);
            self.pack(&kept, plan);
        }
        (self.weights, self.kept) = (weights, kept);
    }

    /// Writes the points of `order` as packets.
    fn pack(&mut self, order: &[u32], plan: Plan) {
        self.bytes.clear();
        self.written.clear();
        let mut rest = order;
        while let Some((first, others)) = rest.split_first() {
            let first = self.points[*first as usize];
            let Plan { mode, kind, top, step_mm, max_bytes } = plan;
            let start = Start { mode, kind, top, first };
            let limit = ((max_bytes - HEADER_BYTES - CHECK_BYTES) * 8 * 256) as u32 - SLACK;
            let mut model = Model::new(start);
            let mut distance = square(first);
            self.writer.clear();
            let mut port = Emit { tables: &self.tables, writer: &mut self.writer };
            for index in others.iter().take(MAX_POINTS_PER_PACKET - 1) {
                let point = self.points[*index as usize];
                if model.code(&mut port, point).is_err() || port.writer.cost > limit {
                    break;
                }
                port.writer.ends.push(port.writer.operations.len());
                distance += square(point);
            }
            let offset = self.bytes.len();
            // The first end is the first point's, which takes no operations.
            loop {
                let count = self.writer.ends.len();
                let operations = &self.writer.operations[..self.writer.ends[count - 1]];
                let state = rans::encode(operations, &mut self.words);
                let length = HEADER_BYTES + CHECK_BYTES + self.words.len() * 2;
                // The slack makes a second turn all but impossible.
                if length <= max_bytes || count == 1 {
                    Header { start, step_mm, count, state }.write(&self.words, &mut self.bytes);
                    break;
                }
                self.writer.ends.pop();
            }
            let count = self.writer.ends.len();
            let length = self.bytes.len() - offset;
            self.written.push(Written { offset, length, count, distance: distance / count as f32 });
            rest = &rest[count..];
        }
    }
}

fn check(frame: &[Point], settings: &Settings) -> Result<(), InvalidSettings> {
    if !(1..=100).contains(&settings.step_mm) {
        return Err(InvalidSettings::Step);
    }
    if !(MIN_PACKET_BYTES..=MAX_PACKET_BYTES).contains(&settings.max_packet_bytes) {
        return Err(InvalidSettings::PacketBytes);
    }
    if !(0.0..=8.0).contains(&settings.lambda) {
        return Err(InvalidSettings::Lambda);
    }
    if frame.len() > MAX_POINTS {
        return Err(InvalidSettings::TooManyPoints);
    }
    Ok(())
}

/// What is the same for all packets of a frame.
#[derive(Clone, Copy)]
struct Plan {
    mode: Mode,
    kind: AttributeKind,
    top: u8,
    step_mm: u8,
    max_bytes: usize,
}

#[inline]
fn square(point: GridPoint) -> f32 {
    let [x, y, z] = point.at.map(|coordinate| coordinate as f32);
    x * x + y * y + z * z
}

/// The symbols of the packet in hand.
#[derive(Default)]
struct Writer {
    operations: Vec<u32>,
    /// Where each point's operations end.
    ends: Vec<usize>,
    /// In 1/256 bit.
    cost: u32,
}

impl Writer {
    fn clear(&mut self) {
        self.operations.clear();
        self.ends.clear();
        self.ends.push(0);
        self.cost = 0;
    }
}

/// The point lies too far from the packet's first one.
struct TooFar;

struct Emit<'a> {
    tables: &'a [Table],
    writer: &'a mut Writer,
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

struct Estimate<'a> {
    tables: &'a [Table],
    cost: u64,
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

struct Counter<'a> {
    counts: &'a mut [[u64; crate::SYMBOLS]],
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
