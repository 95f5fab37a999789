/** What operators must know of this robot, by its configuration. */
import type { RobotAbout } from '@farpoint/protocol';

/** Kinds of sources that show a world that is computed, and one that was. */
const SIMULATED: ReadonlySet<string> = new Set(['sim', 'sim-lidar']);
const PLAYED: ReadonlySet<string> = new Set(['pcd', 'rgbd', 'recording']);

export interface AboutOptions {
  /** What takes the velocities. */
  sink: { kind: string };
  /** The wheels of the kind `base`; `null`: none. */
  base: object | null;
  sensors: readonly { capture: { source: { kind: string } } }[];
}

/** @param recorded whether the session is recorded now */
export function robotAbout({ sink, base, sensors }: AboutOptions, recorded: boolean): RobotAbout {
  const kinds = sensors.map(({ capture }) => capture.source.kind);
  const shows = kinds.some((kind) => PLAYED.has(kind))
    ? 'files'
    : kinds.some((kind) => SIMULATED.has(kind))
      ? 'simulation'
      : 'sensors';
  return { type: 'about', drives: sink.kind !== 'base' || base !== null, shows, recorded };
}
