import { compose, type Pose, type Quaternion } from '@farpoint/protocol';

/** Samples kept for each moving transform. */
const HISTORY = 128;
const MOST_FRAMES = 1024;
const MOST_DEPTH = 64;
/** A sample that is older than the newest by more is of a clock that was set back: what came before it is forgotten, ms. */
const STEP_BACK_MS = 1000;
/** Frames that localisation moves (REP-105). It may say so rarely, or ahead of time, while odometry carries the robot on. */
const LOCALISED = /(^|\/)(odom|map)$/;

interface Sample {
  timeMs: number;
  pose: Pose;
}

interface Edge {
  parent: string;
  fixed: boolean;
  /** Oldest first. */
  samples: Sample[];
}

/** What became of a transform: `loop` if a frame would be above itself. */
export type TransformVerdict = 'kept' | 'too-many' | 'loop';

export interface PlacedFrame {
  /** The frame that has no parent. */
  root: string;
  pose: Pose;
  /** How far the time is from the nearest sample of what moves, ms; 0 between two of them. */
  offMs: number;
}

/** Whether a frame is moved by localisation, not by the robot's own motion. */
export function isLocalised(frame: string): boolean {
  return LOCALISED.test(frame);
}

/** Transforms between frames over time, as in tf; memory is bounded. All times are of one clock, ms. */
export class TransformTree {
  readonly #edges = new Map<string, Edge>();

  has(child: string): boolean {
    return this.#edges.has(child);
  }

  /**
   * Takes a transform. Nothing is stored, and nothing forgotten, unless it is kept.
   *
   * @param anew whether another source of it takes over, and what was known of it is forgotten
   */
  set(
    parent: string,
    child: string,
    timeMs: number,
    pose: Pose,
    fixed: boolean,
    anew = false,
  ): TransformVerdict {
    const edge = this.#edges.get(child);
    if (edge === undefined || edge.parent !== parent || fixed || anew) {
      if (edge === undefined && this.#edges.size >= MOST_FRAMES) return 'too-many';
      if (this.#isAbove(child, parent)) return 'loop';
      this.#edges.set(child, { parent, fixed, samples: [{ timeMs, pose }] });
      return 'kept';
    }
    const { samples } = edge;
    if (edge.fixed || timeMs < (samples.at(-1) as Sample).timeMs - STEP_BACK_MS) samples.length = 0;
    edge.fixed = false;
    // Samples arrive nearly in order; a late one is inserted in its place. The first of two at one time counts.
    let at = samples.length;
    while (at > 0 && (samples[at - 1] as Sample).timeMs > timeMs) at--;
    if (samples[at - 1]?.timeMs === timeMs) return 'kept';
    samples.splice(at, 0, { timeMs, pose });
    if (samples.length > HISTORY) samples.shift();
    return 'kept';
  }

  /**
   * A frame's pose in the root of its tree at a given time: interpolated between two samples, or the nearest sample
   * outside their range.
   *
   * @returns `null` if the frame is unknown
   */
  poseInRoot(frame: string, timeMs: number): PlacedFrame | null {
    let edge = this.#edges.get(frame);
    if (edge === undefined) return null;
    let child = frame;
    let pose = poseAt(edge, timeMs);
    let offMs = offOf(child, edge, timeMs);
    let root = edge.parent;
    for (let depth = 0; depth < MOST_DEPTH; depth++) {
      child = root;
      edge = this.#edges.get(root);
      if (edge === undefined) return { root, pose, offMs };
      pose = compose(poseAt(edge, timeMs), pose);
      offMs = Math.max(offMs, offOf(child, edge, timeMs));
      root = edge.parent;
    }
    return null;
  }

  /**
   * Since when nothing newer is known of where a frame is, ms: of all that moves it, what was told longest ago. What
   * localisation moves does not count.
   *
   * @returns `null` if nothing moves it
   */
  newestMs(frame: string): number | null {
    let newest: number | null = null;
    let child = frame;
    for (let depth = 0; depth < MOST_DEPTH; depth++) {
      const edge = this.#edges.get(child);
      if (edge === undefined) break;
      const { timeMs } = edge.samples.at(-1) as Sample;
      if (!edge.fixed && !isLocalised(child)) newest = Math.min(newest ?? timeMs, timeMs);
      child = edge.parent;
    }
    return newest;
  }

  /** Forgets moving transforms, after a jump in time. */
  forgetMoving(): void {
    for (const [child, { fixed }] of this.#edges) if (!fixed) this.#edges.delete(child);
  }

  /** Whether a frame is above another, or is the other. */
  #isAbove(frame: string, other: string): boolean {
    let at: string | undefined = other;
    for (let depth = 0; at !== undefined && depth <= MOST_DEPTH; depth++) {
      if (at === frame) return true;
      at = this.#edges.get(at)?.parent;
    }
    return at !== undefined;
  }
}

function offOf(child: string, { fixed, samples }: Edge, timeMs: number): number {
  if (fixed || isLocalised(child)) return 0;
  const [oldest, newest] = [samples[0] as Sample, samples.at(-1) as Sample];
  return Math.max(0, timeMs - newest.timeMs, oldest.timeMs - timeMs);
}

function poseAt({ samples }: Edge, timeMs: number): Pose {
  let low = 0;
  let high = samples.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((samples[middle] as Sample).timeMs <= timeMs) low = middle + 1;
    else high = middle;
  }
  const after = samples[low];
  const before = samples[low - 1];
  if (before === undefined || after === undefined) return (before ?? after ?? (samples[0] as Sample)).pose;
  const part = (timeMs - before.timeMs) / (after.timeMs - before.timeMs);
  return between(before.pose, after.pose, part);
}

/**
 * Interpolates the position linearly and the orientation along the shortest path, accurate to a thousandth for
 * rotations that tf samples.
 */
function between(a: Pose, b: Pose, part: number): Pose {
  const mix = (from: number, to: number) => from + (to - from) * part;
  return {
    position: {
      x: mix(a.position.x, b.position.x),
      y: mix(a.position.y, b.position.y),
      z: mix(a.position.z, b.position.z),
    },
    orientation: nlerp(a.orientation, b.orientation, part),
  };
}

function nlerp(a: Quaternion, b: Quaternion, part: number): Quaternion {
  const sign = a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w < 0 ? -1 : 1;
  const mix = (from: number, to: number) => from + (sign * to - from) * part;
  const mixed = { x: mix(a.x, b.x), y: mix(a.y, b.y), z: mix(a.z, b.z), w: mix(a.w, b.w) };
  const norm = Math.hypot(mixed.x, mixed.y, mixed.z, mixed.w);
  return { x: mixed.x / norm, y: mixed.y / norm, z: mixed.z / norm, w: mixed.w / norm };
}
