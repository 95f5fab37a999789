//! A frame of points into packets.

use crate::Point;
use crate::contexts::SYMBOLS;
use crate::model::Model;
use crate::order::{Order, Sorter, bounds, is_ordered};
use crate::packing::{Cloud, Packer, Plan};
use crate::ports::{Counter, Estimate};
use crate::predictor::Mode;
use crate::quantise::{Attribute, GridPoint, find_levels, quantise};
use crate::settings::{EncodeReport, InvalidSettings, Settings, check};
use crate::start::{AttributeKind, Start};
use crate::tables::{Table, all};

/// Encodes frames; its memory is kept from one to the next.
pub struct Encoder {
    tables: Vec<Table>,
    points: Vec<GridPoint>,
    order: Vec<u32>,
    other_order: Vec<u32>,
    sorter: Sorter,
    packer: Packer,
}

impl Default for Encoder {
    fn default() -> Self {
        Self::new()
    }
}

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
            packer: Packer::default(),
        }
    }

    /// Encodes a frame; [`Encoder::packets`] gives the packets until the next call.
    ///
    /// # Errors
    /// For settings out of range, and more than 2²⁴ points.
    pub fn encode(&mut self, frame: &[Point], settings: &Settings) -> Result<EncodeReport, InvalidSettings> {
        self.packer.clear();
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

        let cloud = Cloud { tables: &self.tables, points: &self.points, plan };
        let packer = &mut self.packer;
        packer.pack(cloud, &self.order);
        if let Some(budget) = settings.budget_bytes.filter(|budget| packer.bytes.len() > *budget) {
            packer.fit(cloud, &self.order, budget, settings.lambda);
        }
        // Nearest first; equal ones as they were packed.
        let written = &mut packer.written;
        written.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        if let Some(budget) = settings.budget_bytes {
            while written.iter().map(|packet| packet.length).sum::<usize>() > budget {
                written.pop();
            }
        }
        let kept = written.iter().map(|packet| packet.count).sum();
        Ok(EncodeReport {
            kept,
            thinned: self.points.len() - kept,
            rejected,
            packets: written.len(),
            bytes: written.iter().map(|packet| packet.length).sum(),
        })
    }

    /// The packets of the last frame, those nearest to the origin first.
    pub fn packets(&self) -> impl ExactSizeIterator<Item = &[u8]> {
        let Packer { bytes, written, .. } = &self.packer;
        written.iter().map(|packet| &bytes[packet.offset..packet.offset + packet.length])
    }

    /// Where the packets lie in [`Encoder::bytes`]: offset, length and points of each, in the order of
    /// [`Encoder::packets`].
    pub fn extents(&self) -> impl ExactSizeIterator<Item = [usize; 3]> {
        self.packer.written.iter().map(|packet| [packet.offset, packet.length, packet.count])
    }

    /// The memory in which the packets lie.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        &self.packer.bytes
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
        counts: &mut [[u64; SYMBOLS]],
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
}
