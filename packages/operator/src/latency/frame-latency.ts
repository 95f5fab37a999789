/** Latency from a frame's capture to the end of the display frame that shows its last points. No clock here. */
import { sequenceDelta32 } from '@farpoint/protocol';
import { type Distribution, SampleWindow } from './sample-window.ts';

/** Age of a capture timestamp at a local time, ms; `null` while the robot's clock is unknown. */
export type AgeOfStamp = (captureTimeUs: number, nowMs: number) => number | null;

/** Told of each frame that is shown, as it is measured. */
export interface FrameListener {
  /** Times are NaN where they are not known. */
  onShown(
    frameNumber: number,
    captureUs: number,
    ageMs: number | null,
    arrivedMs: number,
    uploadedMs: number,
    drawnMs: number,
  ): void;
}

/**
 * Frames that were shown and are remembered, half of a second at 30 a second: a late packet of one begins no
 * new measurement.
 */
const MAX_DONE = 16;

export class FrameLatency {
  readonly #samples = new SampleWindow(1024);
  #frame: number | null = null;
  #captureUs = 0;
  /** When the last packet of the current frame came, and when the last one was uploaded. */
  #arrivedMs = Number.NaN;
  #uploadedMs = Number.NaN;
  #arrived = 0;
  #finished = false;
  /** Packets of the current frame wait for the display frame being drawn. */
  #fresh = false;
  #lastDrawnMs = 0;
  /** Capture times of the frames whose last packets are in the display frame being drawn. */
  readonly #done = new Float64Array(MAX_DONE);
  readonly #doneFrame = new Float64Array(MAX_DONE);
  readonly #doneArrivedMs = new Float64Array(MAX_DONE);
  readonly #doneUploadedMs = new Float64Array(MAX_DONE);
  #doneCount = 0;
  readonly #ageOf: AgeOfStamp;

  readonly #listener: FrameListener | null;

  constructor(ageOf: AgeOfStamp, listener: FrameListener | null = null) {
    this.#ageOf = ageOf;
    this.#listener = listener;
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

  /** A packet, which had come at `arrivedMs`, was uploaded at `uploadedMs` for the display frame being prepared. */
  onPacket(
    frameNumber: number,
    captureUs: number,
    points: number,
    totalPoints: number,
    arrivedMs = Number.NaN,
    uploadedMs = Number.NaN,
  ): void {
    if (frameNumber !== this.#frame) {
      // A late packet of the previous frame, which has been counted already.
      if (this.#frame !== null && sequenceDelta32(frameNumber, this.#frame) < 0) return;
      this.#close();
      this.#frame = frameNumber;
      this.#captureUs = captureUs;
      this.#arrivedMs = arrivedMs;
      this.#arrived = 0;
      this.#finished = false;
      this.#fresh = false;
    }
    this.#arrivedMs = Math.max(this.#arrivedMs, arrivedMs);
    this.#uploadedMs = uploadedMs;
    this.#arrived += points;
    this.#fresh = true;
    if (this.#arrived >= totalPoints && !this.#finished) {
      this.#finished = true;
      this.#push();
    }
  }

  /** The display frame is finished. */
  onDrawn(nowMs: number): void {
    for (let i = 0; i < this.#doneCount; i++) this.#addDone(i, nowMs);
    this.#doneCount = 0;
    if (this.#fresh) this.#lastDrawnMs = nowMs;
    this.#fresh = false;
  }

  /** The next frame begins: whatever is missing of this one was lost. */
  #close(): void {
    if (this.#frame === null || this.#finished) return;
    if (this.#fresh) this.#push();
    else this.#add(this.#frame, this.#captureUs, this.#arrivedMs, this.#uploadedMs, this.#lastDrawnMs);
  }

  /** The current frame is shown by the display frame being drawn. */
  #push(): void {
    if (this.#doneCount >= MAX_DONE) return;
    this.#doneFrame[this.#doneCount] = this.#frame as number;
    this.#doneArrivedMs[this.#doneCount] = this.#arrivedMs;
    this.#doneUploadedMs[this.#doneCount] = this.#uploadedMs;
    this.#done[this.#doneCount++] = this.#captureUs;
  }

  #addDone(i: number, nowMs: number): void {
    const [frame, captureUs] = [this.#doneFrame[i] as number, this.#done[i] as number];
    this.#add(frame, captureUs, this.#doneArrivedMs[i] as number, this.#doneUploadedMs[i] as number, nowMs);
  }

  #add(frame: number, captureUs: number, arrivedMs: number, uploadedMs: number, drawnMs: number): void {
    const age = this.#ageOf(captureUs, drawnMs);
    if (age !== null) this.#samples.add(age);
    this.#listener?.onShown(frame, captureUs, age, arrivedMs, uploadedMs, drawnMs);
  }
}
