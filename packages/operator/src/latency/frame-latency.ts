/** Latency from a frame's capture to the end of the display frame that shows its last points. No clock here. */
import { sequenceDelta32 } from '@farpoint/protocol';
import { type Distribution, SampleWindow } from './sample-window.ts';

/** Age of a capture timestamp at a local time, ms; `null` while the robot's clock is unknown. */
export type AgeOfStamp = (captureTimeUs: number, nowMs: number) => number | null;

/**
 * Frames that were shown and are remembered, half of a second at 30 a second: a late packet of one begins no
 * new measurement.
 */
const MAX_DONE = 16;

export class FrameLatency {
  readonly #samples = new SampleWindow(1024);
  #frame: number | null = null;
  #captureUs = 0;
  #arrived = 0;
  #finished = false;
  /** Packets of the current frame wait for the display frame being drawn. */
  #fresh = false;
  #lastDrawnMs = 0;
  /** Capture times of the frames whose last packets are in the display frame being drawn. */
  readonly #done = new Float64Array(MAX_DONE);
  #doneCount = 0;
  readonly #ageOf: AgeOfStamp;

  constructor(ageOf: AgeOfStamp) {
    this.#ageOf = ageOf;
  }

  get distribution(): Distribution | null {
    return this.#samples.distribution();
  }

  reset(): void {
    this.#samples.clear();
    this.#frame = null;
    this.#doneCount = 0;
    this.#fresh = false;
  }

  /** A packet was uploaded for the display frame being prepared. */
  onPacket(frameNumber: number, captureUs: number, points: number, totalPoints: number): void {
    if (frameNumber !== this.#frame) {
      // A late packet of the previous frame, which has been counted already.
      if (this.#frame !== null && sequenceDelta32(frameNumber, this.#frame) < 0) return;
      this.#close();
      this.#frame = frameNumber;
      this.#captureUs = captureUs;
      this.#arrived = 0;
      this.#finished = false;
      this.#fresh = false;
    }
    this.#arrived += points;
    this.#fresh = true;
    if (this.#arrived >= totalPoints && !this.#finished) {
      this.#finished = true;
      this.#push(captureUs);
    }
  }

  /** The display frame is finished. */
  onDrawn(nowMs: number): void {
    for (let i = 0; i < this.#doneCount; i++) this.#add(this.#done[i] as number, nowMs);
    this.#doneCount = 0;
    if (this.#fresh) this.#lastDrawnMs = nowMs;
    this.#fresh = false;
  }

  /** The next frame begins: whatever is missing of this one was lost. */
  #close(): void {
    if (this.#frame === null || this.#finished) return;
    if (this.#fresh) this.#push(this.#captureUs);
    else this.#add(this.#captureUs, this.#lastDrawnMs);
  }

  #push(captureUs: number): void {
    if (this.#doneCount < MAX_DONE) this.#done[this.#doneCount++] = captureUs;
  }

  #add(captureUs: number, nowMs: number): void {
    const age = this.#ageOf(captureUs, nowMs);
    if (age !== null) this.#samples.add(age);
  }
}
