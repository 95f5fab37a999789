/** A source that can be asked at any time, asked at the instants at which the cameras beside it capture. */

import type {
  CaptureRoom,
  CaptureWishes,
  FrameSource,
  SourceDescription,
  SourceFrame,
} from '@farpoint/cloud-source';
import { SimTrigger } from '../video/feed/sim-trigger.ts';

export class TriggeredSource implements FrameSource {
  readonly description: SourceDescription;
  onReady: (() => void) | null = null;
  /** A cloud that nobody takes is skipped: it would be of an instant long ago. */
  readonly goesOn = true;
  readonly #source: FrameSource;
  readonly #trigger: SimTrigger;
  readonly #intervalNs: bigint;
  /** Of the cloud that is ready, ms; `null` before the first. */
  #instantMs: number | null = null;
  #end: (() => void) | null = null;

  /** @param perSecond it is asked at the multiples of this rate's interval, counted from the clock's zero */
  constructor(source: FrameSource, perSecond: number, nowNs = () => process.hrtime.bigint()) {
    this.#source = source;
    this.#trigger = new SimTrigger(nowNs);
    this.#intervalNs = BigInt(Math.round(1e9 / perSecond));
    this.description = { ...source.description, framesPerSecond: perSecond };
  }

  get state() {
    return this.#source.state;
  }

  start(): void {
    this.#end = this.#trigger.add({
      intervalNs: this.#intervalNs,
      capture: (atNs) => {
        this.#instantMs = Number(atNs) / 1e6;
        this.onReady?.();
      },
    });
  }

  capture(_nowMs: number, wishes: CaptureWishes, room: CaptureRoom): SourceFrame | null {
    return this.#instantMs === null ? null : this.#source.capture(this.#instantMs, wishes, room);
  }

  /** Nothing is kept. */
  skip(): void {}

  close(): void {
    this.#end?.();
    this.#source.close();
  }
}
