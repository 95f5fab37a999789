import { compose, type Pose, type Quaternion } from '@farpoint/protocol';

/** Samples kept for each moving transform. */
const HISTORY = 128;
const MOST_FRAMES = 1024;
const MOST_DEPTH = 64;

interface Sample {
  stampNs: bigint;
  pose: Pose;
}

interface Edge {
  parent: string;
  fixed: boolean;
  /** Oldest first. */
  samples: Sample[];
}

/** Transforms between frames over time, as in tf; memory is bounded. */
export class TransformTree {
  readonly #edges = new Map<string, Edge>();

  has(child: string): boolean {
    return this.#edges.has(child);
  }

  /** @returns false if there are too many frames, in which case nothing is stored */
  set(parent: string, child: string, stampNs: bigint, pose: Pose, fixed: boolean): boolean {
    const edge = this.#edges.get(child);
    if (edge === undefined || edge.parent !== parent || fixed) {
      if (edge === undefined && this.#edges.size >= MOST_FRAMES) return false;
      this.#edges.set(child, { parent, fixed, samples: [{ stampNs, pose }] });
      return true;
    }
    const { samples } = edge;
    edge.fixed = false;
    // Samples arrive nearly in order; a late one is inserted in its place.
    let at = samples.length;
    while (at > 0 && (samples[at - 1] as Sample).stampNs > stampNs) at--;
    samples.splice(at, 0, { stampNs, pose });
    if (samples.length > HISTORY) samples.shift();
    return true;
  }

  /**
   * A frame's pose in the root of its tree at a given time: interpolated between two samples, or the nearest sample
   * outside their range.
   *
   * @returns `null` if the frame is unknown
   */
  poseInRoot(frame: string, stampNs: bigint): { root: string; pose: Pose } | null {
    let edge = this.#edges.get(frame);
    if (edge === undefined) return null;
    let pose = poseAt(edge, stampNs);
    let root = edge.parent;
    for (let depth = 0; depth < MOST_DEPTH; depth++) {
      edge = this.#edges.get(root);
      if (edge === undefined) return { root, pose };
      pose = compose(poseAt(edge, stampNs), pose);
      root = edge.parent;
    }
    return null;
  }

  /** Forgets moving transforms, after a jump in time. */
  forgetMoving(): void {
    for (const [child, { fixed }] of this.#edges) if (!fixed) this.#edges.delete(child);
  }
}

function poseAt({ samples }: Edge, stampNs: bigint): Pose {
  let low = 0;
  let high = samples.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((samples[middle] as Sample).stampNs <= stampNs) low = middle + 1;
    else high = middle;
  }
  const after = samples[low];
  const before = samples[low - 1];
  if (before === undefined || after === undefined) return (before ?? after ?? (samples[0] as Sample)).pose;
  const part = Number(stampNs - before.stampNs) / Number(after.stampNs - before.stampNs);
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
