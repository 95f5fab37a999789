import type { Twist } from '@farpoint/protocol';
import { MOST_EXTRAPOLATION_MS } from './obstacle-guard-options.ts';
import type { FloorPose } from './sensor-grid.ts';

/** Poses that are kept: a second or two of odometry. Clouds that are older are silent. */
const KEPT = 64;

interface Sample {
  pose: Readonly<FloorPose>;
  twist: Readonly<Twist> | null;
  atMs: number;
}

/** Where base_link was at a time not long ago: what a sensor that sweeps needs to say where it saw something. */
export class PoseTrack {
  /** Oldest first. */
  readonly #samples: Sample[] = [];

  /** Odometry came. One that is not newer than the last is left out. */
  measured(pose: Readonly<FloorPose>, twist: Readonly<Twist> | null, atMs: number): void {
    if (![pose.x, pose.y, pose.yaw, atMs].every(Number.isFinite)) return;
    if (atMs <= (this.#samples.at(-1)?.atMs ?? Number.NEGATIVE_INFINITY)) return;
    this.#samples.push({ pose, twist, atMs });
    if (this.#samples.length > KEPT) this.#samples.shift();
  }

  /** The pose at a time, by the robot's monotonic clock; `null` if nobody can tell. */
  at(timeMs: number): FloorPose | null {
    const samples = this.#samples;
    let after = samples.length;
    while (after > 0 && (samples[after - 1] as Sample).atMs > timeMs) after--;
    const [before, next] = [samples[after - 1], samples[after]];
    if (before !== undefined && next !== undefined) return between(before, next, timeMs);
    const nearest = before ?? next;
    if (nearest === undefined || Math.abs(timeMs - nearest.atMs) > MOST_EXTRAPOLATION_MS) return null;
    return carriedOn(nearest, (timeMs - nearest.atMs) / 1000);
  }
}

function between({ pose: a, atMs }: Sample, { pose: b, atMs: untilMs }: Sample, timeMs: number): FloorPose {
  const share = (timeMs - atMs) / (untilMs - atMs);
  const turn = Math.atan2(Math.sin(b.yaw - a.yaw), Math.cos(b.yaw - a.yaw));
  return {
    x: a.x + (b.x - a.x) * share,
    y: a.y + (b.y - a.y) * share,
    yaw: a.yaw + turn * share,
  };
}

function carriedOn({ pose, twist }: Sample, seconds: number): FloorPose {
  if (twist === null) return { ...pose };
  const { x, y, yaw } = pose;
  const { linear, angular } = twist;
  const heading = yaw + (angular.z * seconds) / 2;
  const [cos, sin] = [Math.cos(heading) * seconds, Math.sin(heading) * seconds];
  return {
    x: x + linear.x * cos - linear.y * sin,
    y: y + linear.x * sin + linear.y * cos,
    yaw: yaw + angular.z * seconds,
  };
}
