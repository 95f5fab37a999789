//! Points in their order into packets, as many as a budget allows.

use crate::model::Model;
use crate::packet::{CHECK_BYTES, HEADER_BYTES, Header, MAX_POINTS_PER_PACKET};
use crate::ports::{Emit, Writer};
use crate::predictor::Mode;
use crate::quantise::GridPoint;
use crate::rans;
use crate::start::{AttributeKind, Start};
use crate::tables::Table;
use crate::thinning::{Weights, thin};

/// What rANS may waste in a packet, and the rounding of costs, 1/256 bit.
const SLACK: u32 = 64 * 256;
/// Trials of how many points fit a budget.
const TRIALS: usize = 8;

/// What is the same for all packets of a frame.
#[derive(Clone, Copy)]
pub(crate) struct Plan {
    pub mode: Mode,
    pub kind: AttributeKind,
    pub top: u8,
    pub step_mm: u8,
    pub max_bytes: usize,
}

/// A frame's points, and how they are coded.
#[derive(Clone, Copy)]
pub(crate) struct Cloud<'a> {
    pub tables: &'a [Table],
    pub points: &'a [GridPoint],
    pub plan: Plan,
}

/// A packet among the bytes of a [`Packer`].
#[derive(Clone, Copy)]
pub(crate) struct Written {
    pub offset: usize,
    pub length: usize,
    pub count: usize,
    /// Mean square of the distance from the origin.
    pub distance: f32,
}

/// Writes frames as packets; its memory is kept from one to the next.
#[derive(Default)]
pub(crate) struct Packer {
    weights: Weights,
    kept: Vec<u32>,
    writer: Writer,
    words: Vec<u16>,
    pub bytes: Vec<u8>,
    pub written: Vec<Written>,
}

#[inline]
fn square(point: GridPoint) -> f32 {
    let [x, y, z] = point.at.map(|coordinate| coordinate as f32);
    x * x + y * y + z * z
}

impl Packer {
    /// Forgets the last frame's packets.
    pub fn clear(&mut self) {
        self.bytes.clear();
        self.written.clear();
    }

    /// Writes as many points as fit a budget, by trial. All of them have been tried, and do not.
    pub fn fit(&mut self, cloud: Cloud<'_>, order: &[u32], budget: usize, lambda: f32) {
        let mut kept = std::mem::take(&mut self.kept);
        self.weights.fill(cloud.points, cloud.plan.step_mm, lambda);
        // `low` points fit, `high` do not.
        let (mut low, mut high) = (0.0, cloud.points.len() as f32);
        let mut count = high;
        for trial in 0..TRIALS {
            let size = self.bytes.len().max(1);
            // A little under the budget; points far apart take more bits.
            let aimed = count * (0.98 * budget as f32 / size as f32).powf(if trial == 0 { 1.3 } else { 1.1 });
            count = if aimed > low && aimed < high { aimed } else { (low + high) / 2.0 };
            thin(order, &self.weights.each, self.weights.scale_for(count), &mut kept);
            self.pack(cloud, &kept);
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
            thin(order, &self.weights.each, self.weights.scale_for(low), &mut kept);
            self.pack(cloud, &kept);
        }
        self.kept = kept;
    }

    /// Writes the points of `order` as packets.
    pub fn pack(&mut self, cloud: Cloud<'_>, order: &[u32]) {
        self.clear();
        let mut rest = order;
        while !rest.is_empty() {
            let count = self.add_packet(cloud, rest);
            rest = &rest[count..];
        }
    }

    /// Writes as many of some points as a packet holds; their number.
    fn add_packet(&mut self, cloud: Cloud<'_>, order: &[u32]) -> usize {
        let Plan { mode, kind, top, .. } = cloud.plan;
        let first = cloud.points[order[0] as usize];
        let start = Start { mode, kind, top, first };
        let distance = self.code(cloud, start, &order[1..]);
        let offset = self.bytes.len();
        let count = self.write(cloud.plan, start);
        let length = self.bytes.len() - offset;
        self.written.push(Written { offset, length, count, distance: distance / count as f32 });
        count
    }

    /// Codes the points that follow a packet's first one until it is full; the sum of the squares of all distances.
    #[inline]
    fn code(&mut self, Cloud { tables, points, plan }: Cloud<'_>, start: Start, others: &[u32]) -> f32 {
        let limit = ((plan.max_bytes - HEADER_BYTES - CHECK_BYTES) * 8 * 256) as u32 - SLACK;
        let mut model = Model::new(start);
        let mut distance = square(start.first);
        self.writer.clear();
        let mut port = Emit { tables, writer: &mut self.writer };
        for index in others.iter().take(MAX_POINTS_PER_PACKET - 1) {
            let point = points[*index as usize];
            if model.code(&mut port, point).is_err() || port.writer.cost > limit {
                break;
            }
            port.writer.ends.push(port.writer.operations.len());
            distance += square(point);
        }
        distance
    }

    /// Writes the coded points as a packet, as many as fit; their number.
    fn write(&mut self, Plan { step_mm, max_bytes, .. }: Plan, start: Start) -> usize {
        // The first end is the first point's, which takes no operations.
        loop {
            let count = self.writer.ends.len();
            let operations = &self.writer.operations[..self.writer.ends[count - 1]];
            let state = rans::encode(operations, &mut self.words);
            let length = HEADER_BYTES + CHECK_BYTES + self.words.len() * 2;
            // The slack makes a second turn all but impossible.
            if length <= max_bytes || count == 1 {
                Header { start, step_mm, count, state }.write(&self.words, &mut self.bytes);
                return count;
            }
            self.writer.ends.pop();
        }
    }
}
