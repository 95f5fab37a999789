import type { PacketResult } from '@farpoint/rtp';

/**
 * Interface of all rate controllers. Inputs: when each packet was sent and its size, when it arrived or that it did
 * not, the receiver's own limit, and the time. One controller serves one operator's path.
 *
 * Times are the robot's monotonic clock in ms unless stated otherwise; sizes are bytes on the wire, including IP and
 * UDP.
 */
export interface RateController {
  /**
   * A packet was sent. `transportSequence` is its transport-wide sequence number: 16 bits, wraps.
   *
   * @param probeCluster the `clusterId` of the probe it belongs to; 0 or absent for none
   */
  onPacketSent(transportSequence: number, bytes: number, nowMs: number, probeCluster?: number): void;
  /** One transport-wide feedback message, joined with what was sent (`TransportFeedbackAdapter`), in sending order. */
  onFeedback(results: readonly PacketResult[], nowMs: number): void;
  /** The receiving application's sums: shows loss where transport-wide feedback is missing. */
  onReceiverReport(report: ReceiverSums, nowMs: number): void;
  /** The receiver's limit; valid until the next one. */
  onReceiverLimit(bitsPerSecond: number, nowMs: number): void;
  /** Decides anew for the time that has passed. Call about every 25 ms. */
  update(nowMs: number): void;
  /** The rate at which all streams of this path together may send now. */
  targetBitsPerSecond(nowMs: number): number;
  /** What the planner and the pacer need now. Returns one object, which the next call overwrites. */
  decision(nowMs: number): Readonly<RateDecision>;
  /** For metrics and plots. Returns a new object. */
  snapshot(nowMs: number): RateSnapshot;
}

/** Cumulative sums since the session began. */
export interface ReceiverSums {
  packetsReceived: number;
  packetsLost: number;
  /** Who counted: sums from different counters must not be combined. */
  source?: 'rtcp' | 'application' | undefined;
  /** From sending the newest counted packet to receiving the report, ms. */
  rttMs?: number | null | undefined;
}

/** What may be sent. Ask again before each frame, after each feedback message and after each update. */
export interface RateDecision {
  /** The rate to plan media for, over all streams of the path, bit/s. */
  targetBitsPerSecond: number;
  /** The fastest rate of sending, bit/s; slightly above the target, so that a frame ends before the next one comes. */
  pacingBitsPerSecond: number;
  /** Nothing may be sent while `bytesInFlight` is at least this. Infinity for no limit. */
  congestionWindowBytes: number;
  /** Sent and not yet covered by any feedback. */
  bytesInFlight: number;
  /** The probe to send; `null` for none. It stays until it is seen to be sent, expires, or is replaced. */
  probe: Readonly<ProbeRequest> | null;
}

/** The object that a controller fills in before each answer. Its window stays unlimited if the controller has none. */
export function emptyDecision(): RateDecision {
  return {
    targetBitsPerSecond: 0,
    pacingBitsPerSecond: 0,
    congestionWindowBytes: Number.POSITIVE_INFINITY,
    bytesInFlight: 0,
    probe: null,
  };
}

/**
 * A request for a short train of packets at a higher rate: waiting media first, then points that were left out, then
 * padding. Each packet of the train is reported with its `clusterId`. A sender that cannot send trains may ignore it.
 */
export interface ProbeRequest {
  /** Counts up from 1; a new number is a new request. */
  clusterId: number;
  /** Rate of the train, bit/s. */
  bitsPerSecond: number;
  /** Length of the train, bytes on the wire. */
  bytes: number;
}

export interface RateSnapshot {
  /** The rate that the link is estimated to carry for us, bit/s. */
  estimateBitsPerSecond: number;
  /** The controller's own name for its state. */
  state: string;
  /** Recent loss fraction of the reported packets, 0–1. */
  lossFraction: number;
  /** From sending to receiving the report, latest sample, ms; `null` before the first. */
  rttMs: number | null;
  /** Estimated waiting time in the path's queue, ms. */
  queueMs: number;
  /** The rate that arrived recently, bit/s. */
  ackedBitsPerSecond: number;
}
