/**
 * What a rate controller is told and what it answers. It is as much as Google congestion control needs
 * (draft-ietf-rmcat-gcc-02): when each packet left and how big it was, when it arrived or that it did not, the receiver's
 * own limit, and a regular tick. One controller serves one operator's path.
 *
 * Times are the robot's monotonic clock in ms unless said otherwise; sizes are bytes on the wire, IP and UDP included.
 */
export interface RateController {
  /** A packet has left. `transportSequence` is its transport-wide sequence number, 16 bits, wraps. */
  onPacketSent(transportSequence: number, bytes: number, nowMs: number): void;
  /** One transport-wide feedback message, joined with what was sent (transport-feedback-adapter.ts), in sending order. */
  onFeedback(results: readonly PacketResult[], nowMs: number): void;
  /** The receiving application's sums; a way to learn of loss where transport-wide feedback is missing. */
  onReceiverReport(report: ReceiverSums, nowMs: number): void;
  /** The receiver's limit; it holds until the next one. */
  onReceiverLimit(bitsPerSecond: number, nowMs: number): void;
  /** To be called every 25 ms or so. */
  onTick(nowMs: number): void;
  /** What all the streams of this path together may send now. */
  targetBitsPerSecond(nowMs: number): number;
}

/** What became of one packet. */
export interface PacketResult {
  transportSequence: number;
  bytes: number;
  sentMs: number;
  /** The receiver's clock, µs, continuous over feedback messages; only differences mean something. `null`: lost. */
  arrivalUs: number | null;
}

/** Sums since the session began. */
export interface ReceiverSums {
  packetsReceived: number;
  packetsLost: number;
}
