/** What is counted and measured about the stream, from the network to the display. Time is an argument. */

import { type ClockOffset, pointsOfBytes } from '@farpoint/protocol';
import { BitRate, RateMeter } from '@farpoint/timing';
import type { Batch } from '../cloud/batch.ts';
import type { DropCounts } from '../cloud/packet-intake.ts';
import type { IntakeReport } from '../cloud/worker-messages.ts';
import { type AgeOfStamp, FrameLatency } from '../latency/frame-latency.ts';
import type { LatencyResult } from '../latency/latency-test.ts';
import { type Distribution, SampleWindow } from '../latency/sample-window.ts';

/** Times in ms, rates a second. */
export interface StreamStats {
  /** Packets that arrived since the session began. */
  packetsReceived: number;
  /** Packets that were lost since the session began. */
  packetsLost: number;
  /** Bytes that arrived since the session began. */
  bytesReceived: number;
  /** Packets that arrived and were not decoded since the session began, by reason. */
  drops: DropCounts;
  /** Rate of arrival over the last second. */
  bitsPerSecond: number;
  /** Share of packets lost over the last seconds, 0–1. */
  lossRate: number;
  /** Round trip of the latest clock probe; `null` before the first answer. */
  rttMs: number | null;
  /** Shortest round trip among the last clock probes; `null` before the first answer. */
  minRttMs: number | null;
  /** Capture to the worker, each packet. */
  deliveryMs: Distribution | null;
  /** Capture to the end of the display frame with the frame's last points. */
  frameLatencyMs: Distribution | null;
  /** Motion to photon: until the whole green cloud was drawn. */
  mtpMs: Distribution | null;
  /** Motion to photon: until the first points of the green cloud were drawn. */
  mtpFirstMs: Distribution | null;
  /** Mean µs the worker spent on a packet. */
  decodeUs: number;
}

const MAX_RESULTS = 1000;
const LOSS_WINDOW_MS = 3000;

/** Counts and measures the stream, from the network to the display. {@link RobotClient} makes one and calls it. */
export class StreamStatistics {
  readonly #ageOf: AgeOfStamp;
  readonly #delivery = new SampleWindow(8192);
  readonly #frameLatency: FrameLatency;
  readonly #mtp = new SampleWindow(MAX_RESULTS);
  readonly #mtpFirst = new SampleWindow(MAX_RESULTS);
  readonly #bytes = new RateMeter();
  readonly #lost = new RateMeter(LOSS_WINDOW_MS);
  readonly #received = new RateMeter(LOSS_WINDOW_MS);
  #report: IntakeReport | null = null;
  /** Latency tests, the oldest forgotten. */
  readonly results: LatencyResult[] = [];

  /** @param ageOf how long ago a stamp of the robot's clock was, ms */
  constructor(ageOf: AgeOfStamp) {
    this.#ageOf = ageOf;
    this.#frameLatency = new FrameLatency(ageOf);
  }

  /** A new session. */
  reset(): void {
    this.#report = null;
    for (const meter of [this.#bytes, this.#lost, this.#received]) meter.reset();
    this.#delivery.clear();
    this.#frameLatency.reset();
  }

  /** Distributions begin anew. */
  resetDistributions(): void {
    this.#delivery.clear();
    this.#frameLatency.reset();
    this.#mtp.clear();
    this.#mtpFirst.clear();
  }

  /** The cloud worker reported its sums. */
  onReport(report: IntakeReport): void {
    this.#report = report;
  }

  /**
   * A packet's points were uploaded for the display frame being prepared.
   *
   * @param packet index in the batch
   */
  onUploaded(batch: Batch, packet: number): void {
    const captureUs = batch.captureTimeUs(packet);
    const age = this.#ageOf(captureUs, batch.receivedAtMs(packet) - performance.timeOrigin);
    if (age !== null) this.#delivery.add(age);
    this.#frameLatency.onPacket(
      batch.frameNumber(packet),
      captureUs,
      batch.pointsCame(packet),
      pointsOfBytes(batch.frameLength(packet)),
    );
  }

  /**
   * The display frame is finished.
   *
   * @param nowMs `performance.now()`
   */
  onDrawn(nowMs: number): void {
    this.#frameLatency.onDrawn(nowMs);
  }

  /** A latency test ended. */
  onResult(result: LatencyResult): void {
    this.#mtp.add(result.mtpMs);
    this.#mtpFirst.add(result.firstMs);
    this.results.push(result);
    if (this.results.length > MAX_RESULTS) this.results.shift();
  }

  /**
   * Updates the rates. Call it a few times a second.
   *
   * @param nowMs `performance.now()`
   */
  tick(nowMs: number): void {
    this.#bytes.update(this.#report?.bytesReceived ?? 0, nowMs);
    this.#lost.update(this.#report?.packetsLost ?? 0, nowMs);
    this.#received.update(this.#report?.packetsReceived ?? 0, nowMs);
  }

  /**
   * Everything as it is now.
   *
   * @param clock tells the round trips
   */
  snapshot(clock: Pick<ClockOffset, 'lastRttMs' | 'minRttMs'>): StreamStats {
    const lost = this.#lost.perSecond;
    const sent = lost + this.#received.perSecond;
    return {
      packetsReceived: this.#report?.packetsReceived ?? 0,
      packetsLost: this.#report?.packetsLost ?? 0,
      bytesReceived: this.#report?.bytesReceived ?? 0,
      drops: { ...this.#report?.drops },
      bitsPerSecond: BitRate.fromBytesPerSecond(this.#bytes.perSecond),
      lossRate: sent > 0 ? lost / sent : 0,
      rttMs: clock.lastRttMs,
      minRttMs: clock.minRttMs,
      deliveryMs: this.#delivery.distribution(),
      frameLatencyMs: this.#frameLatency.distribution,
      mtpMs: this.#mtp.distribution(),
      mtpFirstMs: this.#mtpFirst.distribution(),
      decodeUs: this.#report?.decodeUs ?? 0,
    };
  }
}
