/** What the main thread and the base's thread say to each other. */
import type { Twist } from '@farpoint/protocol';
import type { TimedBaseState } from './base.ts';

export interface BaseOptions {
  /** Without a word on the velocity for this long the base stands. */
  watchdogMs: number;
}

export interface BaseWorkerData extends BaseOptions {
  /** For what sensors draw. */
  snapshot: SharedArrayBuffer;
}

export type BaseRequest = { type: 'twist'; twist: Twist } | { type: 'close' };

export interface BaseReport {
  state: TimedBaseState;
  /** How often silence has stopped it. */
  watchdogStops: number;
}
