import { readFileSync } from 'node:fs';
import { BandwidthEstimator, initSync } from '../wasm/farpoint_bandwidth_estimator.js';
import { InFlight } from './in-flight.ts';
import type {
  PacketResult,
  ProbeRequest,
  RateController,
  RateDecision,
  RateSnapshot,
  ReceiverSums,
} from './rate-controller.ts';

export interface GoogCcOptions {
  startBitsPerSecond?: number;
  minBitsPerSecond?: number;
  maxBitsPerSecond?: number;
}

/** Doubles in a row of either kind (see the crate `bandwidth-estimator`). */
const ROW = 5;
/** Clocks begin here, µs: the controller does not like times near 0. */
const EPOCH_US = 1e9;

let memory: { readonly buffer: ArrayBuffer } | null = null;

function loadModule(): { readonly buffer: ArrayBuffer } {
  if (memory === null) {
    const file = new URL('../wasm/farpoint_bandwidth_estimator_bg.wasm', import.meta.url);
    memory = initSync({ module: readFileSync(file) }).memory as { readonly buffer: ArrayBuffer };
  }
  return memory;
}

/**
 * libwebrtc's Google congestion control, unchanged: what AdaptiveRateController is compared with. Packets are kept in
 * preallocated rows and handed over in batches, before each feedback message and each tick.
 */
export class GoogCcController implements RateController {
  readonly #memory = loadModule();
  readonly #estimator: BandwidthEstimator;
  readonly #capacity: number;
  readonly #flight = new InFlight();
  readonly #rows: Float64Array;
  #count = 0;
  #sequence = -1;
  #receiverLimit = Number.POSITIVE_INFINITY;
  #probe: (ProbeRequest & { sentBytes: number }) | null = null;
  #acked = 0;
  #lastArrivalMs = Number.NaN;
  readonly #decision: RateDecision = {
    targetBitsPerSecond: 0,
    pacingBitsPerSecond: 0,
    congestionWindowBytes: 0,
    bytesInFlight: 0,
    probe: null,
  };

  constructor(options: GoogCcOptions = {}) {
    this.#estimator = new BandwidthEstimator(
      options.startBitsPerSecond ?? 3e6,
      options.minBitsPerSecond ?? 150_000,
      options.maxBitsPerSecond ?? 200e6,
      EPOCH_US,
    );
    this.#capacity = this.#estimator.rowsCapacity();
    this.#rows = new Float64Array(this.#capacity * ROW);
  }

  onPacketSent(transportSequence: number, bytes: number, nowMs: number, probeCluster = 0): void {
    this.#flight.onSent(transportSequence, bytes, probeCluster);
    if (probeCluster !== 0 && this.#probe !== null) this.#probe.sentBytes += bytes;
    this.#sequence = this.#unwrap(transportSequence);
    this.#row(this.#sequence, bytes, nowMs * 1000 + EPOCH_US, probeCluster, this.#flight.bytes);
    if (this.#count === this.#capacity) this.#flush();
  }

  onFeedback(results: readonly PacketResult[], nowMs: number): void {
    this.#flush();
    const newest = results[results.length - 1];
    if (newest === undefined) return;
    this.#flight.onAnswered(newest.transportSequence);
    let bytes = 0;
    let lastMs = this.#lastArrivalMs;
    for (const { transportSequence, bytes: size, sentMs, arrivalUs } of results) {
      const cluster = this.#flight.clusterOf(transportSequence);
      const arrival = arrivalUs === null ? Number.NaN : arrivalUs + EPOCH_US;
      this.#row(this.#unwrap(transportSequence), size, sentMs * 1000 + EPOCH_US, cluster, arrival);
      if (arrivalUs !== null) {
        bytes += size;
        lastMs = arrivalUs / 1000;
      }
      if (this.#count === this.#capacity) this.#report(nowMs);
    }
    this.#report(nowMs);
    if (lastMs > this.#lastArrivalMs) this.#acked = (bytes * 8000) / (lastMs - this.#lastArrivalMs);
    this.#lastArrivalMs = lastMs;
    this.#wish();
  }

  onReceiverReport(_report: ReceiverSums, _nowMs: number): void {}

  onReceiverLimit(bitsPerSecond: number, _nowMs: number): void {
    this.#receiverLimit = Math.max(bitsPerSecond, 0);
  }

  onTick(nowMs: number): void {
    this.#flush();
    this.#estimator.tick(nowMs * 1000 + EPOCH_US);
    this.#wish();
  }

  targetBitsPerSecond(_nowMs: number): number {
    return Math.min(this.#estimator.target, this.#receiverLimit);
  }

  decision(nowMs: number): Readonly<RateDecision> {
    const d = this.#decision;
    d.targetBitsPerSecond = this.targetBitsPerSecond(nowMs);
    d.pacingBitsPerSecond = Math.max(this.#estimator.pacing, d.targetBitsPerSecond);
    d.bytesInFlight = this.#flight.bytes;
    d.congestionWindowBytes = this.#estimator.window;
    if (this.#probe !== null && this.#probe.sentBytes >= this.#probe.bytes) this.#wish();
    d.probe = this.#probe !== null && this.#probe.sentBytes < this.#probe.bytes ? this.#probe : null;
    return d;
  }

  snapshot(_nowMs: number): RateSnapshot {
    const { target, loss, rttUs } = this.#estimator;
    return {
      estimateBitsPerSecond: target,
      state: 'gcc',
      lossFraction: loss,
      rttMs: Number.isNaN(rttUs) ? null : rttUs / 1000,
      queueMs: 0,
      ackedBitsPerSecond: this.#acked,
    };
  }

  /** Takes the next probe where the last one has been sent. */
  #wish(): void {
    if (this.#probe !== null && this.#probe.sentBytes < this.#probe.bytes) return;
    const [clusterId, bitsPerSecond, bytes] = this.#estimator.takeProbe();
    if (clusterId === undefined || bitsPerSecond === undefined || bytes === undefined) return;
    this.#probe = { clusterId, bitsPerSecond, bytes, sentBytes: 0 };
  }

  #row(a: number, b: number, c: number, d: number, e: number): void {
    const at = this.#count++ * ROW;
    this.#rows[at] = a;
    this.#rows[at + 1] = b;
    this.#rows[at + 2] = c;
    this.#rows[at + 3] = d;
    this.#rows[at + 4] = e;
  }

  #flush(): void {
    if (this.#count > 0) this.#estimator.sent(this.#handOver());
  }

  #report(nowMs: number): void {
    if (this.#count > 0)
      this.#estimator.feedback(this.#handOver(), this.#flight.bytes, nowMs * 1000 + EPOCH_US);
  }

  #handOver(): number {
    const count = this.#count;
    // The module's memory may have grown and moved since the last time.
    const into = new Float64Array(this.#memory.buffer, this.#estimator.rowsPointer(), count * ROW);
    into.set(this.#rows.subarray(0, count * ROW));
    this.#count = 0;
    return count;
  }

  /** The number nearest to the last one sent. */
  #unwrap(transportSequence: number): number {
    if (this.#sequence < 0) return transportSequence;
    const ahead = (transportSequence - this.#sequence) & 0xffff;
    return this.#sequence + (ahead < 0x8000 ? ahead : ahead - 0x10000);
  }
}
