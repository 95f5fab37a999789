/** Which clouds one operator wants, and reads, and draws. */
import type { CloudFormat } from '@farpoint/protocol';
import { DisplayPace } from './display-pace.ts';

export class WantedClouds {
  /** The sensors whose clouds the operator wants. */
  sensors: ReadonlySet<number> = new Set([0]);
  /** The coded formats that the operator says it reads. */
  formats: ReadonlySet<CloudFormat> = new Set();
  /** How many of them its computer draws. */
  readonly pace = new DisplayPace();
}
