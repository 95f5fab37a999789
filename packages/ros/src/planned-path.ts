/** Reads nav_msgs/Path, with a bounded number of points. */
import { MAX_PATH_POINTS, MAX_PLACE_M, type Pose, type Vector3 } from '@farpoint/protocol';
import { pathSchema, stampNs } from './messages.ts';
import { inWorld, type NavigationNews, onFloor } from './navigation-news.ts';

/** Points that leave the path nearer than this to itself are left out, metres. */
const TOLERANCE_M = 0.02;
const CENTIMETRES = 100;

/** A path as its navigator has it, before it is known where its frame is. */
export interface FramedPath {
  frameId: string;
  stampNs: bigint;
  /** In its frame, metres. */
  points: Vector3[];
}

/** @throws {Error} if the message does not match its type */
export function readPath(message: unknown): FramedPath {
  const { header, poses } = pathSchema.parse(message);
  const points = poses.map(({ pose }) => pose.position);
  return {
    frameId: header.frame_id,
    stampNs: stampNs(header.stamp),
    points: tellingPoints(points, MAX_PATH_POINTS, TOLERANCE_M),
  };
}

/** @param framePose of the path's frame in the world; `null` if it is not known */
export function placePath({ frameId, points }: FramedPath, framePose: Pose | null): NavigationNews {
  const refused = { kind: 'refused', of: 'path', frame: frameId } as const;
  if (points.length === 0) return { kind: 'path', points: [] };
  if (framePose === null) return { ...refused, reason: 'unknown-frame' };
  if (onFloor(framePose) === null) return { ...refused, reason: 'not-level' };
  const placed = points.map((point): [number, number] => {
    const { x, y } = inWorld(framePose, point);
    return [Math.round(x * CENTIMETRES) / CENTIMETRES, Math.round(y * CENTIMETRES) / CENTIMETRES];
  });
  const near = placed.every(([x, y]) => Math.abs(x) <= MAX_PLACE_M && Math.abs(y) <= MAX_PLACE_M);
  return near ? { kind: 'path', points: placed } : { ...refused, reason: 'out-of-range' };
}

/**
 * The points that tell most of a line on the floor: its ends, then always the one that is farthest from the line of those
 * chosen so far (Douglas–Peucker, with a bound on the number). Its time is bounded by `most` times their number.
 *
 * @param tolerance the line of the chosen points may pass the others by this much
 */
export function tellingPoints<T extends { x: number; y: number }>(
  points: readonly T[],
  most: number,
  tolerance: number,
): T[] {
  if (points.length <= 2) return [...points];
  const last = points.length - 1;
  const chosen = new Set([0, last]);
  const parts = [farthest(points, 0, last)];
  while (chosen.size < most) {
    let worst = 0;
    for (let i = 1; i < parts.length; i++)
      if ((parts[i] as Part).distance > (parts[worst] as Part).distance) worst = i;
    const part = parts[worst];
    if (part === undefined || part.distance <= tolerance) break;
    chosen.add(part.at);
    parts.splice(worst, 1, farthest(points, part.from, part.at), farthest(points, part.at, part.to));
  }
  return [...chosen].sort((a, b) => a - b).map((index) => points[index] as T);
}

interface Part {
  from: number;
  to: number;
  /** The point between them that is farthest from the straight line. */
  at: number;
  distance: number;
}

function farthest(points: readonly { x: number; y: number }[], from: number, to: number): Part {
  const [a, b] = [points[from], points[to]] as [{ x: number; y: number }, { x: number; y: number }];
  const [dx, dy] = [b.x - a.x, b.y - a.y];
  const squared = dx * dx + dy * dy;
  const part = { from, to, at: from, distance: 0 };
  for (let i = from + 1; i < to; i++) {
    const { x, y } = points[i] as { x: number; y: number };
    const along = squared > 0 ? ((x - a.x) * dx + (y - a.y) * dy) / squared : 0;
    const clamped = Math.min(Math.max(along, 0), 1);
    const distance = Math.hypot(x - a.x - clamped * dx, y - a.y - clamped * dy);
    if (distance > part.distance) Object.assign(part, { at: i, distance });
  }
  return part;
}
