//! Points in their order into packets, as many as a budget allows.

use crate::encoder::{Encoder, Written};
use crate::model::{Model, Start};
use crate::packet::{AttributeKind, CHECK_BYTES, HEADER_BYTES, Header, MAX_POINTS_PER_PACKET};
use crate::ports::Emit;
use crate::predictor::Mode;
use crate::quantise::GridPoint;
use crate::rans;
use crate::thinning::thin;

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

#[inline]
fn square(point: GridPoint) -> f32 {
    let [x, y, z] = point.at.map(|coordinate| coordinate as f32);
    x * x + y * y + z * z
}

impl Encoder {
    /// Tries how many points fit.
    pub(crate) fn fit(&mut self, order: &[u32], plan: Plan, budget: usize, lambda: f32) {
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
    pub(crate) fn pack(&mut self, order: &[u32], plan: Plan) {
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
