/** Everything the page counts and measures about the stream. Time is an argument. */
import { RateMeter } from '@farpoint/congestion';
import type { Batch } from '../cloud/batch.ts';
import type { CloudView } from '../cloud/cloud-view.ts';
import type { DropCounts } from '../cloud/packet-intake.ts';
import type { IntakeReport } from '../cloud/worker-messages.ts';
import { type AgeOfStamp, FrameLatency } from '../latency/frame-latency.ts';
import type { LatencyResult } from '../latency/latency-test.ts';
import { SampleWindow } from '../latency/sample-window.ts';
import type { PageStats } from '../test-api.ts';

const MAX_RESULTS = 1000;
const LOSS_WINDOW_MS = 3000;

export class PageStatistics {
  readonly #ageOf: AgeOfStamp;
  readonly #delivery = new SampleWindow(8192);
  readonly #frameLatency: FrameLatency;
  readonly #mtp = new SampleWindow(MAX_RESULTS);
  readonly #mtpFirst = new SampleWindow(MAX_RESULTS);
  readonly #render = new SampleWindow(512);
  readonly #bytes = new RateMeter();
  readonly #frames = new RateMeter();
  readonly #points = new RateMeter();
  readonly #display = new RateMeter();
  readonly #lost = new RateMeter(LOSS_WINDOW_MS);
  readonly #received = new RateMeter(LOSS_WINDOW_MS);
  #report: IntakeReport | null = null;
  #displayFrames = 0;
  readonly results: LatencyResult[] = [];

  constructor(ageOf: AgeOfStamp) {
    this.#ageOf = ageOf;
    this.#frameLatency = new FrameLatency(ageOf);
  }

  /** A new session. */
  reset(): void {
    this.#report = null;
    for (const meter of [this.#bytes, this.#frames, this.#points, this.#lost, this.#received]) meter.reset();
    this.#delivery.clear();
    this.#frameLatency.reset();
  }

  /** Distributions begin anew. */
  resetDistributions(): void {
    this.#delivery.clear();
    this.#frameLatency.reset();
    this.#mtp.clear();
    this.#mtpFirst.clear();
    this.#render.clear();
  }

  onReport(report: IntakeReport): void {
    this.#report = report;
  }

  onPacket(batch: Batch, packet: number): void {
    const captureUs = batch.captureTimeUs(packet);
    const age = this.#ageOf(captureUs, batch.receivedMs(packet) - performance.timeOrigin);
    if (age !== null) this.#delivery.add(age);
    this.#frameLatency.onPacket(
      batch.frameNumber(packet),
      captureUs,
      batch.pointsCame(packet),
      batch.frameLength(packet) / 8,
    );
  }

  onDrawn(nowMs: number, renderMs: number): void {
    this.#displayFrames++;
    this.#render.add(renderMs);
    this.#frameLatency.onDrawn(nowMs);
  }

  onResult(result: LatencyResult): void {
    this.#mtp.add(result.mtpMs);
    this.#mtpFirst.add(result.firstMs);
    this.results.push(result);
    if (this.results.length > MAX_RESULTS) this.results.shift();
  }

  /** A few times a second. */
  tick(cloud: CloudView, nowMs: number): void {
    this.#bytes.update(this.#report?.bytesReceived ?? 0, nowMs);
    this.#lost.update(this.#report?.packetsLost ?? 0, nowMs);
    this.#received.update(this.#report?.packetsReceived ?? 0, nowMs);
    this.#frames.update(cloud.frames, nowMs);
    this.#points.update(cloud.points, nowMs);
    this.#display.update(this.#displayFrames, nowMs);
  }

  get displayFramesPerSecond(): number {
    return this.#display.perSecond;
  }

  snapshot(
    cloud: CloudView,
    clock: { rttMs: number | null; minRttMs: number | null },
    canvas: { width: number; height: number },
  ): PageStats {
    const drops: DropCounts = { ...this.#report?.drops };
    for (const [reason, count] of Object.entries(cloud.drops)) {
      drops[reason as keyof DropCounts] = (drops[reason as keyof DropCounts] ?? 0) + count;
    }
    const lost = this.#lost.perSecond;
    const sent = lost + this.#received.perSecond;
    const frames = this.#frames.perSecond;
    return {
      packetsReceived: this.#report?.packetsReceived ?? 0,
      packetsLost: this.#report?.packetsLost ?? 0,
      bytesReceived: this.#report?.bytesReceived ?? 0,
      framesDrawn: cloud.frames,
      pointsDrawn: cloud.points,
      drops,
      bitsPerSecond: this.#bytes.perSecond * 8,
      framesPerSecond: frames,
      pointsPerFrame: frames > 0 ? this.#points.perSecond / frames : 0,
      lossRate: sent > 0 ? lost / sent : 0,
      rttMs: clock.rttMs,
      minRttMs: clock.minRttMs,
      deliveryMs: this.#delivery.distribution(),
      frameLatencyMs: this.#frameLatency.distribution,
      mtpMs: this.#mtp.distribution(),
      mtpFirstMs: this.#mtpFirst.distribution(),
      renderMs: this.#render.distribution(),
      displayFramesPerSecond: this.#display.perSecond,
      decodeUs: this.#report?.decodeUs ?? 0,
      canvas: { width: canvas.width, height: canvas.height },
    };
  }
}
