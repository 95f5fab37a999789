/** Keeps an operator's clouds to the rate that its computer draws. Time is an argument. */

import type { CloudFormat } from '@farpoint/protocol';
import { EvenPace } from '@farpoint/timing';
import type { DrawnMost } from '../../sense/encode/plan.ts';

/** Of the clouds that are encoded once for everyone, chooses those for one operator. */
export class DisplayPace {
  /** The most that its computer draws; `null`: all that comes. */
  display: DrawnMost | null = null;
  readonly #bySensor = new Map<number, EvenPace>();

  /** @returns whether the operator gets this cloud */
  takes(sensor: number, capturedAtMs: number): boolean {
    if (this.display === null) return true;
    const intervalMs = 1000 / this.display.framesPerSecond;
    const pace = this.#bySensor.get(sensor) ?? new EvenPace();
    this.#bySensor.set(sensor, pace);
    if (!pace.takes(capturedAtMs, intervalMs)) return false;
    pace.taken(capturedAtMs, intervalMs);
    return true;
  }
}

/** Which clouds one operator wants, and reads, and draws. */
export class WantedClouds {
  /** The sensors whose clouds the operator wants. */
  sensors: ReadonlySet<number> = new Set([0]);
  /** The coded formats that the operator says it reads. */
  formats: ReadonlySet<CloudFormat> = new Set();
  /** How many of them its computer draws. */
  readonly pace = new DisplayPace();
}
