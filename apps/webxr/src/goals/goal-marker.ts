/** Where the robot is to go, on the floor: a ring, a pole that is seen from afar, and an arrow where it is to look. */
import {
  BufferGeometry,
  CylinderGeometry,
  DoubleSide,
  Float32BufferAttribute,
  Group,
  Mesh,
  MeshBasicMaterial,
  RingGeometry,
} from 'three';
import type { Tone } from '../status/tone.ts';

/** Above the floor, so that its points do not cover it, m. */
const HEIGHT_M = 0.035;
const RING_M = { inner: 0.2, outer: 0.28 };
const POLE_M = { radius: 0.015, height: 0.6 };
const COLOURS: Readonly<Record<Tone, number>> = {
  neutral: 0x6ea8ff,
  good: 0x35c9b5,
  warning: 0xf2b134,
  bad: 0xe5484d,
};

export interface MarkedGoal {
  readonly x: number;
  readonly y: number;
  readonly yaw?: number | undefined;
}

export class GoalMarker {
  /** In the world's axes. */
  readonly object = new Group();
  /** Nothing hides it: a goal behind points is a goal nevertheless. */
  readonly #material = new MeshBasicMaterial({
    ...{ transparent: true, opacity: 0.85, depthWrite: false, depthTest: false, side: DoubleSide },
  });
  readonly #arrow: Mesh;
  #shown: MarkedGoal | null = null;

  constructor() {
    const ring = new Mesh(new RingGeometry(RING_M.inner, RING_M.outer, 40), this.#material);
    const pole = new Mesh(
      new CylinderGeometry(POLE_M.radius, POLE_M.radius, POLE_M.height, 8),
      this.#material,
    );
    pole.rotation.x = Math.PI / 2;
    pole.position.z = POLE_M.height / 2;
    const head = new BufferGeometry();
    const tip = RING_M.outer + 0.22;
    head.setAttribute(
      'position',
      new Float32BufferAttribute([tip, 0, 0, RING_M.outer, 0.14, 0, RING_M.outer, -0.14, 0], 3),
    );
    this.#arrow = new Mesh(head, this.#material);
    for (const mesh of [ring, pole, this.#arrow]) mesh.renderOrder = 10;
    this.object.add(ring, pole, this.#arrow);
    this.object.visible = false;
  }

  /** What is marked; `null` while nothing is. */
  get shown(): MarkedGoal | null {
    return this.#shown;
  }

  /** @param ground height of the robot's ground, m */
  show(goal: MarkedGoal | null, tone: Tone, ground: number): void {
    this.#shown = goal;
    this.object.visible = goal !== null;
    if (goal === null) return;
    this.object.position.set(goal.x, goal.y, ground + HEIGHT_M);
    this.#arrow.visible = goal.yaw !== undefined;
    this.#arrow.rotation.z = goal.yaw ?? 0;
    this.#material.color.set(COLOURS[tone]);
  }
}
