/** Where the robot's cameras are and how far they see to the sides, as thin lines in the robot's world. */
import type { CloudView } from '@farpoint/cloud-view';
import { BufferGeometry, Float32BufferAttribute, Group, LineBasicMaterial, LineSegments } from 'three';

/** How far ahead of a camera its picture is drawn, metres. Chosen by eye, as the two that follow. */
const DEPTH_M = 0.5;
/** A sensor that sees wider than this sees all around: its picture at 1 m would have this side, metres. */
const WIDEST_M = 3.5;
/** Of the circle in place of a frustum, metres. */
const CIRCLE_M = 0.3;
const CIRCLE_PARTS = 32;

/** What is drawn of a sensor's view. */
export type SeenFrom = Pick<CloudView, 'cameraOrientation' | 'cameraPosition' | 'hasPoints' | 'imageExtent'>;

export class SensorFrusta {
  /** In the axes of the robot's world. */
  readonly object = new Group();
  readonly #material = new LineBasicMaterial({ color: 0x8fb4c9, transparent: true, opacity: 0.75 });
  readonly #frustum = frustum();
  readonly #circle = circle();

  /** Shows these, and no others, until the next call. They follow their sensors. */
  show(views: readonly SeenFrom[]): void {
    this.object.clear();
    for (const view of views) this.object.add(this.#linesOf(view));
  }

  #linesOf(view: SeenFrom): LineSegments {
    const lines = new LineSegments(this.#frustum, this.#material);
    lines.frustumCulled = false;
    const place = () => {
      const isWide = view.imageExtent > WIDEST_M;
      lines.geometry = isWide ? this.#circle : this.#frustum;
      // The stream says how large the picture is, but not its sides' ratio: a square of that size.
      const side = isWide ? 1 : view.imageExtent;
      // Without a pose, there is no place for it.
      const scale = view.hasPoints ? 1 : 0;
      lines.scale.set(side * scale, (isWide ? 1 : side) * scale, scale);
      const { cameraPosition, cameraOrientation } = view;
      lines.position.set(cameraPosition.x, cameraPosition.y, cameraPosition.z);
      const { x, y, z, w } = cameraOrientation;
      lines.quaternion.set(x, y, z, w);
    };
    place();
    lines.onBeforeRender = () => {
      place();
      lines.updateMatrixWorld(true);
    };
    return lines;
  }
}

/** Of a picture with a side of 1 m at a distance of 1 m, in the optical frame: z forward, x right, y down. */
function frustum(): BufferGeometry {
  const half = DEPTH_M / 2;
  const corners = [
    [-half, -half],
    [half, -half],
    [half, half],
    [-half, half],
  ] as const;
  const ends = corners.flatMap(([x, y], i) => {
    const [nextX, nextY] = corners[(i + 1) % corners.length] as readonly [number, number];
    return [0, 0, 0, x, y, DEPTH_M, x, y, DEPTH_M, nextX, nextY, DEPTH_M];
  });
  return lineGeometry(ends);
}

function circle(): BufferGeometry {
  const at = (i: number) => {
    const angle = (2 * Math.PI * i) / CIRCLE_PARTS;
    return [CIRCLE_M * Math.sin(angle), 0, CIRCLE_M * Math.cos(angle)];
  };
  const around = Array.from({ length: CIRCLE_PARTS }, (_, i) => [...at(i), ...at(i + 1)]).flat();
  // Which way is ahead.
  return lineGeometry([...around, 0, 0, 0, 0, 0, CIRCLE_M]);
}

function lineGeometry(ends: readonly number[]): BufferGeometry {
  return new BufferGeometry().setAttribute('position', new Float32BufferAttribute(ends, 3));
}
