/** Messages between the main thread and the base's thread. */

import type { TimedBaseState } from '@farpoint/cloud-source';
import type { Twist } from '@farpoint/protocol';
import type { TopicReading } from '@farpoint/ros';
import type { EarthOrigin, Thing } from '@farpoint/sim';
import type { SimNavigationOptions } from './sim-navigation.ts';

export interface BaseOptions {
  /** The base stops after this long without a velocity, ms. */
  watchdogMs: number;
  /** How fast it goes sideways, m/s; left out: 0, it cannot. */
  maxLateral?: number | undefined;
  /** Charge of the battery at the start, 0 to 1. */
  charge: number;
  /** Where the world is on the earth; without it, the robot has no satellite receiver. */
  origin: EarthOrigin | null;
  /** Put into the world. */
  things?: readonly Thing[] | undefined;
  /** What its navigator publishes; if undefined, it has none. */
  navigation?: SimNavigationOptions | undefined;
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
  /** What its topics say: the joints 20 times a second, the components and the position by satellite once. */
  readings?: TopicReading[];
  /** The numbers of the motors' topic; once a second. */
  motors?: readonly (number | null)[];
}
