/** A grid on the floor that gives the eye a reference. */
import { BufferGeometry, Color, Float32BufferAttribute, LineSegments, ShaderMaterial } from 'three';

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
/**
 * Share of the way to the ground's height that one step goes, until it is as near as this, metres. Chosen by
 * eye: it glides, and rests.
 */
const APPROACH = 0.5;
const SETTLED_M = 0.02;

/** The grid's lines, around its centre: x and z of both ends. Far away, where lines run together, there are fewer. */
export function gridLines(): [x0: number, z0: number, x1: number, z1: number][] {
  const offsets = Array.from({ length: 2 * HALF_M + 1 }, (_, i) => i - HALF_M);
  return offsets.flatMap((at) => {
    const reach = REACHES.find(([every]) => at % every === 0)?.[1] ?? 0;
    if (Math.abs(at) > reach) return [];
    return [
      [at, -reach, at, reach],
      [-reach, at, reach, at],
    ] as [number, number, number, number][];
  });
}

/**
 * Colours as they are, with each line cut off where it would pass behind the camera. A software renderer drops a whole line if
 * one of its ends is there; many short lines instead would take it a millisecond of each display frame.
 */
function lineMaterial(): ShaderMaterial {
  return new ShaderMaterial({
    vertexColors: true,
    vertexShader: `
      attribute vec3 otherEnd;
      varying vec3 vColour;
      void main() {
        mat4 toClip = projectionMatrix * modelViewMatrix;
        vec4 own = toClip * vec4(position, 1.0);
        vec4 other = toClip * vec4(otherEnd, 1.0);
        float inFront = own.z + own.w;
        float otherInFront = other.z + other.w;
        vColour = color;
        gl_Position = inFront < 0.0 && otherInFront > 0.0
          ? mix(own, other, 1.0001 * inFront / (inFront - otherInFront))
          : own;
      }`,
    fragmentShader: `
      varying vec3 vColour;
      void main() {
        gl_FragColor = vec4(vColour, 1.0);
        #include <colorspace_fragment>
      }`,
  });
}

/**
 * In three.js axes. Follows the robot in steps, so that the grid appears to stand still and to have no end.
 */
export class GroundGrid {
  readonly object: LineSegments;

  constructor() {
    const lines = gridLines();
    const [middle, others] = [new Color(MIDDLE), new Color(OTHERS)];
    const attribute = (numbers: number[]) => new Float32BufferAttribute(numbers, 3);
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', attribute(lines.flatMap(([x0, z0, x1, z1]) => [x0, 0, z0, x1, 0, z1])));
    geometry.setAttribute('otherEnd', attribute(lines.flatMap(([x0, z0, x1, z1]) => [x1, 0, z1, x0, 0, z0])));
    geometry.setAttribute(
      'color',
      attribute(
        lines.flatMap(([x0, z0, x1, z1]) => {
          const { r, g, b } = (x0 === 0 && x1 === 0) || (z0 === 0 && z1 === 0) ? middle : others;
          return [r, g, b, r, g, b];
        }),
      ),
    );
    this.object = new LineSegments(geometry, lineMaterial());
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
