import type { RobotClient } from '@farpoint/operator';

/** Where the clouds come from: a {@link RobotClient}, or something that behaves as one. */
export type CloudSource = Pick<
  RobotClient,
  'on' | 'release' | 'noteUploaded' | 'noteDrawn' | 'pointsAtMs'
> & {
  /** Of the latency tests: whether the display frame being drawn must be timed. */
  readonly latency: Pick<RobotClient['latency'], 'wantsTime'>;
};

/** What a {@link CloudView} can be told. */
export interface CloudViewOptions {
  /** Whose clouds are drawn; the first sensor's where left out. */
  sensor?: number;
}
