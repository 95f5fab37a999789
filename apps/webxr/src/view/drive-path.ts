/** What the robot takes of the floor, where the present command leads it, and where it would come to stand. */
import type { RobotBody } from '@farpoint/protocol';
import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Float32BufferAttribute,
  Group,
  Line,
  LineBasicMaterial,
  LineLoop,
  Mesh,
  MeshBasicMaterial,
} from 'three';
import { poseOnArc, stoppingDistance, sweptWidth, writeRibbon } from './swept-path.ts';

/** How far ahead the way is shown, s, and metres at least. */
const AHEAD_S = 2;
const LEAST_AHEAD_M = 0.3;
/** Steps of a ribbon. */
const STEPS = 24;
/** Above the floor, so that its points do not cover it, m. */
const HEIGHT_M = 0.03;
/** Until the robot has said how old the driver's view is, ms. */
const USUAL_LOOP_MS = 150;

/** How much of the wish the robot lets through. */
export type PathTone = 'free' | 'slower' | 'held';

const COLOURS: Readonly<Record<PathTone, number>> = { free: 0x35c9b5, slower: 0xf2b134, held: 0xe5484d };

export interface DrivenPath {
  /** Velocity that the driver asks for, m/s and rad/s. */
  linear: number;
  angular: number;
  /** Age of the driver's view when the robot takes a command; undefined while unknown. */
  loopMs: number | undefined;
  tone: PathTone;
}

class Ribbon {
  readonly mesh: Mesh<BufferGeometry, MeshBasicMaterial>;
  readonly #positions: Float32Array;
  readonly #attribute: BufferAttribute;

  constructor(opacity: number) {
    this.#positions = new Float32Array((STEPS + 1) * 6);
    for (let i = 2; i < this.#positions.length; i += 3) this.#positions[i] = HEIGHT_M;
    this.#attribute = new BufferAttribute(this.#positions, 3);
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', this.#attribute);
    geometry.setIndex(
      Array.from({ length: STEPS }, (_, i) => 2 * i).flatMap((at) => [
        at,
        at + 1,
        at + 2,
        at + 1,
        at + 3,
        at + 2,
      ]),
    );
    const material = new MeshBasicMaterial({
      transparent: true,
      opacity,
      side: DoubleSide,
      forceSinglePass: true,
      depthWrite: false,
    });
    this.mesh = new Mesh(geometry, material);
    this.mesh.frustumCulled = false;
  }

  /** The last pair of points: x, y, z each. */
  get end(): Float32Array {
    return this.#positions.subarray(-6);
  }

  set(curvature: number, width: { left: number; right: number }, from: number, to: number): void {
    writeRibbon(curvature, width, from, to, this.#positions);
    this.#attribute.needsUpdate = true;
  }
}

export class DrivePath {
  /** In base_link's axes. */
  readonly object = new Group();
  readonly #stop = new Ribbon(0.45);
  readonly #ahead = new Ribbon(0.16);
  readonly #stopLine: Line<BufferGeometry, LineBasicMaterial>;
  readonly #outline: LineLoop<BufferGeometry, LineBasicMaterial>;
  /** The outline where it would stand. */
  readonly #standing: LineLoop<BufferGeometry, LineBasicMaterial>;
  readonly #way = new Group();
  #body: RobotBody | null = null;
  /** What is shown: how far the robot goes before it stands, m, and its tone; `null` while it shows no way. */
  shown: { stopM: number; tone: PathTone } | null = null;
  /** How far the footprint reaches ahead and behind, m. */
  #front = 0;
  #back = 0;

  constructor() {
    const end = new BufferGeometry().setAttribute(
      'position',
      new Float32BufferAttribute(new Float32Array(6), 3),
    );
    this.#stopLine = new Line(end, new LineBasicMaterial({ transparent: true }));
    this.#stopLine.frustumCulled = false;
    this.#outline = new LineLoop(
      new BufferGeometry(),
      new LineBasicMaterial({ color: COLOURS.free, transparent: true }),
    );
    this.#standing = new LineLoop(
      new BufferGeometry(),
      new LineBasicMaterial({ transparent: true, opacity: 0.8 }),
    );
    this.#standing.frustumCulled = false;
    this.#way.add(this.#ahead.mesh, this.#stop.mesh, this.#stopLine, this.#standing);
    this.object.add(this.#outline, this.#way);
    this.object.visible = false;
  }

  /** Whether nearer points do not hide it. */
  set onTop(onTop: boolean) {
    for (const { material } of [...this.#wayParts, this.#outline]) material.depthTest = !onTop;
  }

  /** The robot's outline; `null` while it is not known: then nothing is shown. */
  set body(body: RobotBody | null) {
    if (body === this.#body) return;
    this.#body = body;
    this.object.visible = body !== null;
    if (body === null) return;
    const corners = body.footprint.flatMap(({ x, y }) => [x, y, HEIGHT_M]);
    this.#outline.geometry.dispose();
    this.#outline.geometry = new BufferGeometry().setAttribute(
      'position',
      new Float32BufferAttribute(corners, 3),
    );
    this.#standing.geometry = this.#outline.geometry;
    this.#front = Math.max(...body.footprint.map(({ x }) => x));
    this.#back = Math.min(...body.footprint.map(({ x }) => x));
  }

  /** The way on which the robot is told to go; `null` if nobody here drives it. */
  show(path: DrivenPath | null): void {
    const moves = path !== null && path.linear !== 0;
    this.#way.visible = moves && this.#body !== null;
    this.#outline.material.color.setHex(COLOURS[path?.tone ?? 'free']);
    this.shown = null;
    if (!moves || this.#body === null) return;
    const { linear, angular, loopMs = USUAL_LOOP_MS, tone } = path;
    const curvature = angular / linear;
    const width = sweptWidth(this.#body.footprint, curvature);
    const direction = Math.sign(linear);
    const edge = linear > 0 ? this.#front : this.#back;
    const stopM = stoppingDistance(linear, loopMs, this.#body.decelerationMps2);
    this.shown = { stopM, tone };
    const aheadM = Math.max(stopM, LEAST_AHEAD_M, AHEAD_S * Math.abs(linear));
    this.#stop.set(curvature, width, edge, edge + direction * stopM);
    this.#ahead.set(curvature, width, edge + direction * stopM, edge + direction * aheadM);
    const line = this.#stopLine.geometry.getAttribute('position') as BufferAttribute;
    line.set(this.#stop.end);
    line.needsUpdate = true;
    const stands = poseOnArc(curvature, direction * stopM);
    this.#standing.position.set(stands.x, stands.y, 0);
    this.#standing.rotation.z = stands.yaw;
    for (const { material } of this.#wayParts) material.color.setHex(COLOURS[tone]);
  }

  get #wayParts() {
    return [this.#stop.mesh, this.#ahead.mesh, this.#stopLine, this.#standing];
  }
}
