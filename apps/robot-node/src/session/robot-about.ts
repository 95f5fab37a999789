/** What operators must know of this robot, by its configuration. */
import type { RobotAbout } from '@farpoint/protocol';
import type { RobotOptions } from '../robot-configuration.ts';

const SIMULATED = new Set(['sim', 'sim-lidar']);
const PLAYED = new Set(['pcd', 'rgbd', 'recording']);

/** @param recorded whether the session is recorded now */
export function robotAbout(
  { sink, base, sensors }: Pick<RobotOptions, 'sink' | 'base' | 'sensors'>,
  recorded: boolean,
): RobotAbout {
  const kinds = sensors.map(({ capture }) => capture.source.kind);
  const shows = kinds.some((kind) => PLAYED.has(kind))
    ? 'files'
    : kinds.some((kind) => SIMULATED.has(kind))
      ? 'simulation'
      : 'sensors';
  return { type: 'about', drives: sink.kind !== 'base' || base !== null, shows, recorded };
}
