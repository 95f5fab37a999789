/** The path that the robot's navigator has planned, as a ribbon on the floor, and a ring at its goal. */
import { MAX_PATH_POINTS } from '@farpoint/protocol';
import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Group,
  Mesh,
  MeshBasicMaterial,
  RingGeometry,
} from 'three';
import type { PathView } from '../../ground/navigation/navigation-view.ts';
import { writePathRibbon } from './path-ribbon.ts';

/** Above the floor, under the way of the operator's own command, metres. */
const HEIGHT_M = 0.025;
const HALF_WIDTH_M = 0.05;
const GOAL_M = { inner: 0.12, outer: 0.18 };
const COLOUR = 0x6ea8ff;

export class PlannedPathLine {
  /** In the world's axes. */
  readonly object = new Group();
  readonly #positions = new Float32Array(MAX_PATH_POINTS * 6);
  readonly #attribute = new BufferAttribute(this.#positions, 3);
  readonly #geometry = new BufferGeometry();
  readonly #material = new MeshBasicMaterial({
    color: COLOUR,
    transparent: true,
    opacity: 0.7,
    depthWrite: false,
    side: DoubleSide,
    forceSinglePass: true,
  });
  readonly #goal: Mesh;
  #points: PathView['points'] | null = null;

  constructor() {
    this.#geometry.setAttribute('position', this.#attribute);
    this.#geometry.setIndex(
      Array.from({ length: MAX_PATH_POINTS - 1 }, (_, i) => 2 * i).flatMap((at) => [
        at,
        at + 1,
        at + 2,
        at + 1,
        at + 3,
        at + 2,
      ]),
    );
    const ribbon = new Mesh(this.#geometry, this.#material);
    ribbon.frustumCulled = false;
    this.#goal = new Mesh(new RingGeometry(GOAL_M.inner, GOAL_M.outer, 32), this.#material);
    this.object.add(ribbon, this.#goal);
    this.object.visible = false;
  }

  /** Number of points that are drawn; 0 while none are. */
  get shown(): number {
    return this.object.visible ? (this.#points?.length ?? 0) : 0;
  }

  /** Whether nearer points do not hide it. */
  set onTop(onTop: boolean) {
    this.#material.depthTest = !onTop;
  }

  /** @param points in the world; `null`: nothing is shown @param ground height of the robot's ground, metres */
  show(points: PathView['points'] | null, ground: number): void {
    this.object.visible = points !== null;
    this.object.position.z = ground + HEIGHT_M;
    if (points === null || points === this.#points) return;
    this.#points = points;
    const count = writePathRibbon(points, HALF_WIDTH_M, this.#positions);
    this.#attribute.needsUpdate = true;
    this.#geometry.setDrawRange(0, Math.max(0, count - 1) * 6);
    const [x, y] = points.at(-1) ?? [0, 0];
    this.#goal.position.set(x, y, 0);
  }
}
