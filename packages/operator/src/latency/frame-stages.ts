/**
 * Where the time of each cloud goes: the robot's own times of a frame, and the page's, from its capture to the end of the
 * display frame that shows its last points. No clock here.
 */
import type { FrameTimes } from '@farpoint/protocol';
import type { FrameListener } from './frame-latency.ts';
import { StageWindow } from './stage-window.ts';

/** The stages of a cloud, in their order. */
export const frameStages = [
  'capture', // from the sensor to the robot's memory
  'encode', // the obstacle guard's judgement, choosing points, packing them
  'queue', // until the robot's transport has the last packet
  'link', // until the last packet is at the page
  'decode', // until the points are with the GPU
  'draw', // until the end of the display frame that shows them
] as const;
/**
 * A stage of a cloud.
 *
 * @useDeclaredType
 */
export type FrameStage = (typeof frameStages)[number];

/** Frames that are kept: 30 s at 60 a second, and a reserve. */
const MOST_FRAMES = 2048;
/** Frames whose times come before they are shown: what a robot tells in 2 s at most. */
const MOST_EARLY = 128;

/** Joins what the robot tells of its frames with when they were shown. Of one sensor. */
export class FrameStages implements FrameListener {
  /** The latest frames. */
  readonly window = new StageWindow(frameStages, MOST_FRAMES);
  /** Times of frames that are not shown yet, in a ring. */
  readonly #early: FrameTimes[] = [];
  #earlyAt = 0;

  /**
   * A frame is on the screen. Times are the page's, `performance.now()`, NaN for what is not known.
   *
   * @param ageMs since its capture; `null` while the robot's clock is unknown
   * @param arrivedMs when its last packet came
   * @param uploadedMs when its last points were with the GPU
   */
  onShown(
    frameNumber: number,
    captureUs: number,
    ageMs: number | null,
    arrivedMs: number,
    uploadedMs: number,
    drawnMs: number,
  ): void {
    const { window } = this;
    const slot = window.add(frameNumber, captureUs, drawnMs, ageMs ?? Number.NaN);
    window.set(slot, 'decode', uploadedMs - arrivedMs);
    window.set(slot, 'draw', drawnMs - uploadedMs);
    const early = this.#early.find((times) => times[1] === frameNumber && times[2] === captureUs);
    if (early !== undefined) this.#join(slot, early);
  }

  /** The robot has told the times of a frame. */
  onTimes(times: FrameTimes): void {
    const [, frameNumber, captureUs] = times;
    const slot = this.window.find(frameNumber, captureUs);
    if (slot >= 0) this.#join(slot, times);
    else this.#early[this.#earlyAt++ % MOST_EARLY] = times;
  }

  /** One comparison of the clocks, at the end, for the whole: what is neither the robot's time nor the page's is the link's. */
  #join(slot: number, [, , , memoryUs, encodedUs, , lastUs]: Readonly<FrameTimes>): void {
    const { window } = this;
    const totalMs = window.totalMs(slot);
    window.set(slot, 'capture', memoryUs / 1000);
    window.set(slot, 'encode', (encodedUs - memoryUs) / 1000);
    window.set(slot, 'queue', (lastUs - encodedUs) / 1000);
    const pageMs = window.get(slot, 'decode') + window.get(slot, 'draw');
    window.set(slot, 'link', totalMs - lastUs / 1000 - pageMs);
    window.tell(slot, totalMs);
  }
}
