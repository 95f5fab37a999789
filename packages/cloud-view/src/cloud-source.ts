import type { RobotClient } from '@farpoint/operator';

/** Where the clouds come from: a {@link RobotClient}, or an object with the same interface. */
export type CloudSource = Pick<
  RobotClient,
  'on' | 'release' | 'noteUploaded' | 'noteDrawn' | 'pointsAtMs'
> & {
  /** Latency tests: `wantsTime` says whether the display frame being drawn must be timed. */
  readonly latency: Pick<RobotClient['latency'], 'wantsTime'>;
};

/** Options of a {@link CloudView}. */
export interface CloudViewOptions {
  /** Number of the sensor whose clouds are drawn; default: the first. */
  sensor?: number;
}
