import type { PacketResult } from '@farpoint/rtp';

/**
 * What a rate controller is told and what it answers: when each packet left and how big it was, when it arrived or that it
 * did not, the receiver's own limit, and a regular tick. One controller serves one operator's path.
 *
 * Times are the robot's monotonic clock in ms unless said otherwise; sizes are bytes on the wire, IP and UDP included.
 */
export interface RateController {
  /**
   * A packet has left. `transportSequence` is its transport-wide sequence number, 16 bits, wraps.
   *
   * @param probeCluster the `clusterId` of the probe it was sent for; 0 or absent for none
   */
  onPacketSent(transportSequence: number, bytes: number, nowMs: number, probeCluster?: number): void;
  /** One transport-wide feedback message, joined with what was sent (`TransportFeedbackAdapter`), in sending order. */
  onFeedback(results: readonly PacketResult[], nowMs: number): void;
  /** The receiving application's sums; a way to learn of loss where transport-wide feedback is missing. */
  onReceiverReport(report: ReceiverSums, nowMs: number): void;
  /** The receiver's limit; it holds until the next one. */
  onReceiverLimit(bitsPerSecond: number, nowMs: number): void;
  /** To be called every 25 ms or so. */
  onTick(nowMs: number): void;
  /** What all the streams of this path together may send now. */
  targetBitsPerSecond(nowMs: number): number;
  /** What the planner and the pacer need, for now. One object, overwritten by the next call. */
  decision(nowMs: number): Readonly<RateDecision>;
  /** For metrics and plots. A new object. */
  snapshot(nowMs: number): RateSnapshot;
}

/** Sums since the session began. */
export interface ReceiverSums {
  packetsReceived: number;
  packetsLost: number;
  /** Who counted: sums of different counters do not go together. */
  source?: 'rtcp' | 'application' | undefined;
  /** From sending the newest packet that is counted to hearing of it, ms. */
  rttMs?: number | null | undefined;
}

/** What may be sent. Ask again before each frame, after each feedback message and on each tick. */
export interface RateDecision {
  /** Media may be planned for this, bit/s, over all streams of the path. */
  targetBitsPerSecond: number;
  /** Packets leave no faster than this, bit/s; a little above the target, so that a frame is over before the next comes. */
  pacingBitsPerSecond: number;
  /** Nothing may be sent while `bytesInFlight` is at least this. Infinity where there is no limit. */
  congestionWindowBytes: number;
  /** Sent and not yet spoken of by any feedback. */
  bytesInFlight: number;
  /** What to try out, `null` for nothing. It stays until it is seen to be sent, is outdated, or is replaced. */
  probe: Readonly<ProbeRequest> | null;
}

/** What a controller fills in before each answer. Its window stays without a limit where the controller has none. */
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
 * A wish for a short train of packets at a higher rate: media that waits, then points that were left out, then padding.
 * Each packet of the train is reported with its `clusterId`. A sender that cannot may ignore it.
 */
export interface ProbeRequest {
  /** Counts up from 1; a new number is a new wish. */
  clusterId: number;
  /** The rate of the train, bit/s. */
  bitsPerSecond: number;
  /** Its length, bytes on the wire. */
  bytes: number;
}

export interface RateSnapshot {
  /** What the link is thought to carry of ours, bit/s. */
  estimateBitsPerSecond: number;
  /** The controller's own word for what it is doing. */
  state: string;
  /** Lost of those reported lately, 0–1. */
  lossFraction: number;
  /** From sending to being reported, the last sample, ms; `null` before the first. */
  rttMs: number | null;
  /** Waiting time in the path's queue, estimated, ms. */
  queueMs: number;
  /** What the receiver got lately, bit/s. */
  ackedBitsPerSecond: number;
}
