import { pointsOfBytes } from '@farpoint/protocol';
import type { Batch } from '../cloud/batch.ts';
import { type AgeOfStamp, FrameLatency } from '../latency/frame-latency.ts';
import { FrameStages } from '../latency/frame-stages.ts';
import type { Distribution } from '../latency/sample-window.ts';

/** What was drawn of one sensor's clouds since the session began. */
export interface SensorStats {
  /** The sensor's number. */
  sensor: number;
  /** Frames of which at least one point was drawn. */
  frames: number;
  /** Points received in the packets that were drawn. */
  points: number;
  /** Packets that were drawn. */
  packets: number;
  /** Capture to the end of the display frame with the frame's last points, ms. */
  frameLatencyMs: Distribution | null;
}

/** Counts one sensor's clouds, from the decoder to the display. */
export class SensorStatistics {
  /** Where the time of each of its frames goes. */
  readonly stages = new FrameStages();
  readonly #latency: FrameLatency;
  #frame: number | null = null;
  #frames = 0;
  #points = 0;
  #packets = 0;

  /** @param ageOf the age of a timestamp of the robot's clock, ms */
  constructor(ageOf: AgeOfStamp) {
    this.#latency = new FrameLatency(ageOf, this.stages);
  }

  /** Capture to the end of the display frame with the frame's last points, ms. */
  get frameLatencyMs(): Distribution | null {
    return this.#latency.distribution;
  }

  /** Restarts the latency distribution; the totals continue. */
  resetDistribution(): void {
    this.#latency.reset();
  }

  /** @param packet index in the batch @param receivedMs when it came, `performance.now()` @param nowMs the same now */
  onUploaded(batch: Batch, packet: number, receivedMs: number, nowMs: number): void {
    const frame = batch.frameNumber(packet);
    if (frame !== this.#frame) this.#frames++;
    this.#frame = frame;
    const came = batch.pointsCame(packet);
    this.#points += came;
    this.#packets++;
    this.#latency.onPacket(
      frame,
      batch.captureTimeUs(packet),
      came,
      pointsOfBytes(batch.frameLength(packet)),
      receivedMs,
      nowMs,
    );
  }

  onDrawn(nowMs: number): void {
    this.#latency.onDrawn(nowMs);
  }

  snapshot(sensor: number): SensorStats {
    const [frames, points, packets] = [this.#frames, this.#points, this.#packets];
    return { sensor, frames, points, packets, frameLatencyMs: this.frameLatencyMs };
  }
}
