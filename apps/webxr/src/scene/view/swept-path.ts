/** The floor that a robot sweeps with a constant velocity, in base_link (REP-103): metres, radians. No three.js here. */
import type { FloorPoint } from '../../ground/near-field/around-footprint.ts';

/** What a robot sweeps on an arc, to either side of base_link's way. */
export interface SweptWidth {
  /** Metres to the left of the way, and to its right. */
  left: number;
  right: number;
}

/** Straighter than this, the way is a straight line, 1/m. */
const STRAIGHT = 1e-4;

/** @param curvature of the way, positive to the left, 1/m */
export function sweptWidth(footprint: readonly FloorPoint[], curvature: number): SweptWidth {
  const left = Math.max(...footprint.map(({ y }) => y));
  const right = Math.max(...footprint.map(({ y }) => -y));
  if (Math.abs(curvature) < STRAIGHT) return { left, right };
  // Everything turns around this point, beside base_link.
  const centre = { x: 0, y: 1 / curvature };
  const radius = Math.abs(centre.y);
  const outer = Math.max(...footprint.map(({ x, y }) => Math.hypot(x, y - centre.y)));
  const inner = isInside(footprint, centre) ? 0 : nearest(footprint, centre);
  return curvature > 0
    ? { left: radius - inner, right: outer - radius }
    : { left: outer - radius, right: radius - inner };
}

/** Where base_link is after so many metres of the way, negative backwards. */
export function poseOnArc(curvature: number, metres: number): { x: number; y: number; yaw: number } {
  const yaw = curvature * metres;
  if (Math.abs(curvature) < STRAIGHT) return { x: metres, y: 0, yaw };
  return { x: Math.sin(yaw) / curvature, y: (1 - Math.cos(yaw)) / curvature, yaw };
}

/**
 * Writes the ribbon from `from` to `to` metres of the way as pairs of points, left and right, into x, y, z triples; z stays.
 *
 * @param into 6 numbers for each pair
 */
export function writeRibbon(
  curvature: number,
  { left, right }: SweptWidth,
  from: number,
  to: number,
  into: Float32Array,
): void {
  const last = into.length / 6 - 1;
  for (let i = 0; i <= last; i++) {
    const { x, y, yaw } = poseOnArc(curvature, from + ((to - from) * i) / last);
    const [c, s] = [Math.cos(yaw), Math.sin(yaw)];
    into[6 * i] = x - s * left;
    into[6 * i + 1] = y + c * left;
    into[6 * i + 3] = x + s * right;
    into[6 * i + 4] = y - c * right;
  }
}

/**
 * How far a robot goes before it stands, if it is told so now: what it goes until then, and while it brakes.
 *
 * @param speed m/s
 * @param loopMs from its camera to the driver's eye and back with a command
 * @param brakes m/s²
 */
export function stoppingDistance(speed: number, loopMs: number, brakes: number): number {
  return (Math.abs(speed) * loopMs) / 1000 + (speed * speed) / (2 * brakes);
}

function isInside(corners: readonly FloorPoint[], at: FloorPoint): boolean {
  return corners.every((corner, i) => {
    const next = corners[(i + 1) % corners.length] as FloorPoint;
    return (next.x - corner.x) * (at.y - corner.y) - (next.y - corner.y) * (at.x - corner.x) >= 0;
  });
}

function nearest(corners: readonly FloorPoint[], at: FloorPoint): number {
  return Math.min(
    ...corners.map((corner, i) => {
      const next = corners[(i + 1) % corners.length] as FloorPoint;
      const [dx, dy] = [next.x - corner.x, next.y - corner.y];
      const share = ((at.x - corner.x) * dx + (at.y - corner.y) * dy) / (dx * dx + dy * dy);
      const t = Math.min(Math.max(share, 0), 1);
      return Math.hypot(corner.x + t * dx - at.x, corner.y + t * dy - at.y);
    }),
  );
}
