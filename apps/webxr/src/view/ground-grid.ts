/** A grid on the floor that gives the eye a reference. */
import { BufferGeometry, Color, Float32BufferAttribute, LineBasicMaterial, LineSegments } from 'three';

/** Up to this distance on each side, a multiple of {@link STEP_M}. */
const HALF_M = 20;
/** Of the lines that reach so far: it moves by such steps, and appears to stand still. */
const STEP_M = 4;
/** How far lines reach that are a multiple of so many metres from the centre, m; the first that applies. */
const REACHES: readonly [everyM: number, reachM: number][] = [
  [STEP_M, HALF_M],
  [2, 12],
  [1, 8],
];
const MIDDLE = 0x2a3a48;
const OTHERS = 0x1a242e;
/** Slightly below the floor's own points. */
const HEIGHT_M = -0.01;
/** Share of the way to the ground's height that one step goes, until it is as near as this, metres. */
const APPROACH = 0.5;
const SETTLED_M = 0.02;

/** Lengths of segments, m; the first that is short enough for its distance, or the last. */
const LENGTHS = [16, 8, 4, 2, 1];
/** How far the eye may be from the grid's centre, m. */
const OFF_CENTRE_M = STEP_M / 2;

/**
 * Ends of the grid's lines: x and z in turn, both ends of one segment after the other. A software renderer drops a
 * whole segment if one of its ends is behind the camera. A segment no longer than its distance is out of sight in
 * that case. Fewer segments are faster to draw: they are as long as they may be, and far away, where lines run
 * together, there are fewer.
 */
export function gridSegments(): number[] {
  const ends: number[] = [];
  for (let across = -HALF_M; across <= HALF_M; across++) {
    const reach = REACHES.find(([every]) => across % every === 0)?.[1] ?? 0;
    if (Math.abs(across) > reach) continue;
    for (let from = -reach; from < reach; ) {
      const to = from + lengthAt(Math.abs(across), from, reach);
      ends.push(across, from, across, to, from, across, to, across);
      from = to;
    }
  }
  return ends;
}

function lengthAt(across: number, from: number, reach: number): number {
  const fits = (length: number) => {
    const to = from + length;
    const nearest = from < 0 && to > 0 ? 0 : Math.min(Math.abs(from), Math.abs(to));
    return to <= reach && length <= Math.max(across, nearest) - OFF_CENTRE_M;
  };
  return LENGTHS.find(fits) ?? 1;
}

/**
 * In three.js axes. Follows the robot in steps, so that the grid appears to stand still and to have no end.
 */
export class GroundGrid {
  readonly object: LineSegments;

  constructor() {
    const ends = gridSegments();
    const positions = new Float32Array((ends.length / 2) * 3);
    const colours = new Float32Array(positions.length);
    const [middle, others] = [new Color(MIDDLE), new Color(OTHERS)];
    for (let i = 0; i < ends.length / 4; i++) {
      const [x0 = 0, z0 = 0, x1 = 0, z1 = 0] = ends.slice(i * 4, i * 4 + 4);
      positions.set([x0, 0, z0, x1, 0, z1], i * 6);
      const { r, g, b } = (x0 === 0 && x1 === 0) || (z0 === 0 && z1 === 0) ? middle : others;
      colours.set([r, g, b, r, g, b], i * 6);
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new Float32BufferAttribute(positions, 3));
    geometry.setAttribute('color', new Float32BufferAttribute(colours, 3));
    this.object = new LineSegments(
      geometry,
      new LineBasicMaterial({ vertexColors: true, toneMapped: false }),
    );
    this.object.position.y = HEIGHT_M;
  }

  /** Approaches the height of the ground, metres; at once if it is near. Call it a few times a second. */
  approach(ground: number): void {
    const { position } = this.object;
    const off = ground + HEIGHT_M - position.y;
    position.y += Math.abs(off) < SETTLED_M ? off : off * APPROACH;
  }

  centreOn(x: number, z: number): void {
    this.object.position.x = Math.round(x / STEP_M) * STEP_M;
    this.object.position.z = Math.round(z / STEP_M) * STEP_M;
  }
}
