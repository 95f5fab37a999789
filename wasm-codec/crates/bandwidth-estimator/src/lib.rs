//! Google congestion control (the crate `goog_cc`, a port of libwebrtc's; see NOTICE) for JavaScript.
//!
//! Packets cross the border in batches: the caller writes rows of doubles into a buffer of this module and says how
//! many. Times are microseconds of any one clock, sizes bytes on the wire, rates bit/s.

use std::collections::VecDeque;

use goog_cc::network_control::{NetworkControllerConfig, NetworkControllerInterface};
use goog_cc::transport::{
    NetworkAvailability, NetworkControlUpdate, PacedPacketInfo, PacketResult, ProbeClusterConfig,
    ProcessInterval, SentPacket, StreamsConfig, TargetRateConstraints, TransportPacketsFeedback,
};
use goog_cc::units::{DataRate, DataSize, TimeDelta, Timestamp};
use goog_cc::{GoogCcConfig, GoogCcNetworkController};
use wasm_bindgen::prelude::*;

/// Doubles in a row: sequence number (unwrapped), bytes, time of sending, probe cluster (0: none), bytes in flight after it.
pub const SENT_ROW: usize = 5;
/// Doubles in a row: sequence number, bytes, time of sending, probe cluster, time of arrival (NaN: lost).
pub const RESULT_ROW: usize = 5;
/// Rows that either buffer holds.
pub const ROWS: usize = 4096;
/// Clusters that may still be asked for; the oldest is dropped.
const WAITING_PROBES: usize = 8;

/// One path's controller.
#[wasm_bindgen]
pub struct BandwidthEstimator {
    controller: GoogCcNetworkController,
    rows: Vec<f64>,
    waiting: VecDeque<ProbeClusterConfig>,
    known: VecDeque<ProbeClusterConfig>,
    target: f64,
    pacing: f64,
    window: f64,
    loss: f64,
    rtt_us: f64,
}

#[wasm_bindgen]
impl BandwidthEstimator {
    /// Begins at `start_bps`, between the other two.
    #[wasm_bindgen(constructor)]
    pub fn new(start_bps: f64, min_bps: f64, max_bps: f64, now_us: f64) -> Self {
        let constraints = TargetRateConstraints {
            at_time: at(now_us),
            min_data_rate: Some(rate(min_bps)),
            max_data_rate: Some(rate(max_bps)),
            starting_rate: Some(rate(start_bps)),
        };
        let stream_based_config = StreamsConfig {
            at_time: at(now_us),
            requests_alr_probing: Some(true),
            // The point pacer's own factor; libwebrtc's 2.5 would send whole frames in bursts.
            pacing_factor: Some(1.1),
            ..StreamsConfig::default()
        };
        let config = NetworkControllerConfig {
            constraints,
            stream_based_config,
            ..NetworkControllerConfig::default()
        };
        let mut estimator = Self {
            controller: GoogCcNetworkController::new(config, GoogCcConfig { feedback_only: true }),
            rows: vec![0.0; ROWS * SENT_ROW.max(RESULT_ROW)],
            waiting: VecDeque::new(),
            known: VecDeque::new(),
            target: start_bps,
            pacing: start_bps,
            window: f64::INFINITY,
            loss: 0.0,
            rtt_us: f64::NAN,
        };
        let available = NetworkAvailability { at_time: at(now_us), network_available: true };
        let update = estimator.controller.on_network_availability(available);
        estimator.take(update);
        let update = estimator.controller.on_streams_config(stream_based_config);
        estimator.take(update);
        estimator
    }

    /// Where the rows are written before `sent` and `feedback`; an offset into the module's memory.
    #[wasm_bindgen(js_name = rowsPointer)]
    pub fn rows_pointer(&mut self) -> *mut f64 {
        self.rows.as_mut_ptr()
    }

    /// How many rows fit.
    #[wasm_bindgen(js_name = rowsCapacity)]
    pub fn rows_capacity(&self) -> usize {
        ROWS
    }

    /// The first `count` rows are packets that left (see `SENT_ROW`), in order.
    pub fn sent(&mut self, count: usize) {
        for i in 0..count.min(ROWS) {
            let packet = self.packet(i);
            let update = self.controller.on_sent_packet(packet);
            self.take(update);
        }
    }

    /// The first `count` rows are one feedback message (see `RESULT_ROW`).
    pub fn feedback(&mut self, count: usize, in_flight: f64, now_us: f64) {
        let packet_feedbacks: Vec<PacketResult> = (0..count.min(ROWS))
            .map(|i| {
                let arrival = self.rows[i * RESULT_ROW + 4];
                PacketResult {
                    sent_packet: SentPacket { data_in_flight: DataSize::zero(), ..self.packet(i) },
                    receive_time: if arrival.is_nan() { Timestamp::plus_infinity() } else { at(arrival) },
                    ..PacketResult::default()
                }
            })
            .collect();
        // The controller does not expect a message of losses alone.
        if !packet_feedbacks.iter().any(PacketResult::is_received) {
            return;
        }
        let update = self.controller.on_transport_packets_feedback(TransportPacketsFeedback {
            feedback_time: at(now_us),
            data_in_flight: DataSize::from_bytes(in_flight as i64),
            packet_feedbacks,
            ..TransportPacketsFeedback::default()
        });
        self.take(update);
    }

    /// To be called every 25 ms or more often.
    pub fn tick(&mut self, now_us: f64) {
        let update = self
            .controller
            .on_process_interval(ProcessInterval { at_time: at(now_us), ..ProcessInterval::default() });
        self.take(update);
    }

    /// What media may use.
    #[wasm_bindgen(getter)]
    pub fn target(&self) -> f64 {
        self.target
    }

    /// How fast packets may leave.
    #[wasm_bindgen(getter)]
    pub fn pacing(&self) -> f64 {
        self.pacing
    }

    /// Bytes that may be unacknowledged; infinity: no limit.
    #[wasm_bindgen(getter)]
    pub fn window(&self) -> f64 {
        self.window
    }

    /// Of the packets sent, 0–1.
    #[wasm_bindgen(getter)]
    pub fn loss(&self) -> f64 {
        self.loss
    }

    /// Round trip; NaN before the first.
    #[wasm_bindgen(getter, js_name = rttUs)]
    pub fn rtt_us(&self) -> f64 {
        self.rtt_us
    }

    /// Takes the next wish for a probe: cluster (from 1), bit/s, bytes. Empty where there is none.
    #[wasm_bindgen(js_name = takeProbe)]
    pub fn take_probe(&mut self) -> Vec<f64> {
        let Some(probe) = self.waiting.pop_front() else { return Vec::new() };
        let bytes = min_bytes(&probe) as f64;
        let wish = vec![f64::from(probe.id), probe.target_data_rate.bps_float(), bytes];
        if self.known.len() == WAITING_PROBES {
            self.known.pop_front();
        }
        self.known.push_back(probe);
        wish
    }
}

impl BandwidthEstimator {
    fn packet(&self, i: usize) -> SentPacket {
        let row = &self.rows[i * SENT_ROW..(i + 1) * SENT_ROW];
        let pacing_info = match self.known.iter().find(|probe| f64::from(probe.id) == row[3]) {
            Some(probe) => PacedPacketInfo {
                send_bitrate: probe.target_data_rate,
                ..PacedPacketInfo::new(probe.id, i64::from(probe.target_probe_count), min_bytes(probe))
            },
            None => PacedPacketInfo::default(),
        };
        SentPacket {
            send_time: at(row[2]),
            size: DataSize::from_bytes(row[1] as i64),
            sequence_number: row[0] as i64,
            data_in_flight: DataSize::from_bytes(row[4] as i64),
            pacing_info,
            ..SentPacket::default()
        }
    }

    fn take(&mut self, update: NetworkControlUpdate) {
        if let Some(target) = update.target_rate {
            self.target = target.target_rate.bps_float();
            self.loss = f64::from(target.network_estimate.loss_rate_ratio);
            let rtt = target.network_estimate.round_trip_time;
            if rtt < TimeDelta::plus_infinity() {
                self.rtt_us = rtt.us() as f64;
            }
        }
        if let Some(pacer) = update.pacer_config {
            self.pacing = pacer.data_rate().bps_float();
        }
        if let Some(window) = update.congestion_window {
            self.window = window.bytes() as f64;
        }
        for probe in update.probe_cluster_configs {
            if self.waiting.len() == WAITING_PROBES {
                self.waiting.pop_front();
            }
            self.waiting.push_back(probe);
        }
    }
}

fn at(us: f64) -> Timestamp {
    Timestamp::from_micros(us as i64)
}

fn rate(bps: f64) -> DataRate {
    DataRate::from_bits_per_sec(bps as i64)
}

fn min_bytes(probe: &ProbeClusterConfig) -> i64 {
    (probe.target_data_rate.bps_float() / 8.0 * probe.target_duration.us() as f64 / 1e6) as i64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A path that delivers everything after 20 ms, never more than `capacity`.
    fn run(seconds: f64, capacity: f64) -> BandwidthEstimator {
        let mut estimator = BandwidthEstimator::new(3e6, 1e5, 1e8, 1e6);
        let (mut now, mut sequence, mut free) = (1e6, 0.0, 0.0_f64);
        let mut flying: VecDeque<[f64; 5]> = VecDeque::new();
        let mut next_tick = now;
        while now < 1e6 + seconds * 1e6 {
            estimator.rows[..5].copy_from_slice(&[sequence, 1200.0, now, 0.0, flying.len() as f64 * 1200.0]);
            estimator.sent(1);
            free = free.max(now) + 9600.0 / capacity * 1e6;
            flying.push_back([sequence, 1200.0, now, 0.0, free + 20e3]);
            sequence += 1.0;
            now += 9600.0 / estimator.target() * 1e6;
            if now < next_tick {
                continue;
            }
            next_tick += 50e3;
            estimator.tick(now);
            let count = flying.iter().take_while(|row| row[4] < now).count();
            for (i, row) in flying.drain(..count).enumerate() {
                estimator.rows[i * RESULT_ROW..(i + 1) * RESULT_ROW].copy_from_slice(&row);
            }
            if count > 0 {
                estimator.feedback(count, flying.len() as f64 * 1200.0, now);
            }
        }
        estimator
    }

    #[test]
    fn finds_the_order_of_a_steady_link() {
        let target = run(30.0, 10e6).target();
        assert!((5e6..12e6).contains(&target), "{target}");
    }

    #[test]
    fn asks_for_probes_at_the_start() {
        let mut estimator = BandwidthEstimator::new(3e6, 1e5, 1e8, 1e6);
        estimator.tick(1e6);
        let probe = estimator.take_probe();
        assert_eq!(probe.len(), 3);
        assert!(probe[1] > 3e6 && probe[2] > 0.0);
    }
}
