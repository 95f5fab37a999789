/** Plays a recording and takes every cloud, at a clock that does not wait. */
import type { Pose } from '@farpoint/protocol';
import { CloudPlayer } from '../cloud-player.ts';
import type { RecordingError } from '../errors.ts';
import type { PlayOptions } from '../play-options.ts';
import { FakeClock } from './fake-clock.ts';

export interface ShownCloud {
  atMs: number;
  count: number;
  first: number[];
  pose: Pose;
}

/** How a recording is played if nothing else is said: all of it, once. */
export const PLAY_ALL = { topic: null, rate: 1, fromS: 0, atEnd: 'stop', axes: 'auto' } as const;

/** @param most after so many clouds, it ends */
export async function playClouds(
  options: Partial<PlayOptions> & Pick<PlayOptions, 'path'>,
  most = Number.POSITIVE_INFINITY,
) {
  const clock = new FakeClock();
  const player = await CloudPlayer.open({ ...PLAY_ALL, ...options }, clock);
  const points = new Float32Array(player.stream.capacity * 4);
  const shown: ShownCloud[] = [];
  const faults: RecordingError[] = [];
  player.onFault = (error) => faults.push(error);
  player.onCloud = () => {
    const cloud = player.take(points);
    const first = [...points.subarray(0, 3)];
    if (cloud !== null) shown.push({ atMs: clock.ms, count: cloud.count, first, pose: cloud.cameraPose });
    if (shown.length >= most) void player.close();
  };
  await player.run();
  await player.close();
  return { shown, faults, player };
}
