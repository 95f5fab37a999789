//! Frames to packets: what others see of the encoder.

use crate::budget::{Budget, Spent};
use crate::frame::{Frame, Mix, Packet, Settings};
use crate::histogram::Histogram;
use crate::load::Source;
use crate::rate::RateState;
use crate::sampling::SamplingEncoder;
use crate::stream::StreamHeader;
use crate::thinning::{Validity, thin};
use crate::tile::Pattern;

/// Codes frames of one stream.
pub struct Encoder {
    header: StreamHeader,
    encoder: SamplingEncoder,
    rate: RateState,
}

impl Encoder {
    /// `None` where a value of the header is outside its range.
    #[must_use]
    pub fn new(header: StreamHeader) -> Option<Self> {
        let encoder = SamplingEncoder::new(&header)?;
        Some(Self { header, encoder, rate: RateState::default() })
    }

    /// The stream's header.
    #[must_use]
    pub fn header(&self) -> &StreamHeader {
        &self.header
    }

    /// The pattern of every tile for the next frames.
    pub fn patterns(&mut self) -> &mut [Pattern] {
        &mut self.encoder.frames.patterns
    }

    /// Thins the next frames by validity alone: the nearest tiles keep `density` of their points, farther ones less.
    pub fn thin_to(&mut self, source: Source<'_>, validity: &Validity, density: f32) {
        if self.encoder.takes(source) {
            thin(source, self.header.grid(), validity, density, self.patterns());
        }
    }

    /// The packets of the last frame.
    #[must_use]
    pub fn packets(&self) -> &[Packet] {
        self.encoder.frames.writer.packets()
    }

    /// The bytes of a packet of the last frame.
    #[must_use]
    pub fn packet(&self, index: usize) -> &[u8] {
        self.encoder.frames.writer.packet(index)
    }

    /// Codes a frame. `None` where it has not the header's number of pixels.
    pub fn encode(&mut self, source: Source<'_>, settings: &Settings) -> Option<Frame> {
        self.encoder.encode(source, &Mix { finer: *settings, coarser: *settings }, None)
    }

    /// Codes a frame within 5 % of the budget, or as far below it as the frame is smaller in the best quality. It is not over
    /// by more than a packet. `None` where the frame has not the header's number of pixels.
    pub fn encode_within(&mut self, source: Source<'_>, budget: &Budget) -> Option<Spent> {
        self.rate.encode(&mut self.encoder, source, budget)
    }

    /// Sets the table sets that suit the frame: those that would have suited the last one best, where it was coded much
    /// alike, else those that code a sample of this one in the fewest bits.
    pub fn choose_tables(&mut self, source: Source<'_>, settings: &mut Settings) {
        self.encoder.choose_tables(source, settings);
    }

    /// Counts the symbols of one run of `per_packet` tiles in `step`, each as a packet would code it, and returns how many
    /// times as many tiles there are.
    pub fn count(
        &mut self,
        source: Source<'_>,
        settings: &Settings,
        per_packet: usize,
        step: usize,
        histogram: &mut Histogram,
    ) -> f32 {
        self.encoder.count(source, settings, per_packet, step, histogram)
    }

    /// What the frame would take in one packet of any length, bits: what packets that need no other are measured against.
    /// The settings' tables are used, and the present patterns.
    pub fn bits_in_one_packet(&mut self, source: Source<'_>, settings: &Settings) -> f64 {
        self.encoder.bits_in_one_packet(source, settings)
    }
}
