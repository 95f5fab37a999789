/** Messages between the main thread and the base's thread. */
import type { Twist } from '@farpoint/protocol';
import type { TimedBaseState } from './base.ts';

export interface BaseOptions {
  /** The base stops after this long without a velocity, ms. */
  watchdogMs: number;
}

export interface BaseWorkerData extends BaseOptions {
  /** The newest state of the world, for the simulated sensors. */
  snapshot: SharedArrayBuffer;
}

export type BaseRequest = { type: 'twist'; twist: Twist } | { type: 'close' };

export interface BaseReport {
  state: TimedBaseState;
  /** How often the watchdog has stopped the base. */
  watchdogStops: number;
}
