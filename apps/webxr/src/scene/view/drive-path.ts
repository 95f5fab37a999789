/** What the robot takes of the floor, where the present command leads it, and where it would come to stand. */
import type { RobotBody } from '@farpoint/protocol';
import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  DynamicDrawUsage,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
} from 'three';
import { poseOnArc, type SweptWidth, stoppingDistance, sweptWidth, writeRibbon } from './swept-path.ts';

/**
 * How far ahead the way is shown, s, and metres at least. Chosen: above the time of a slow loop and the way
 * to stand; slow driving still shows a direction.
 */
const AHEAD_S = 2;
const LEAST_AHEAD_M = 0.3;
/** Steps of a ribbon, and pairs of points between them. */
const STEPS = 24;
const PAIRS = STEPS + 1;
/** How strongly each part is drawn, 0–1. */
const STRENGTHS = { stop: 0.45, ahead: 0.16, outline: 1, standing: 0.8, stopLine: 1 } as const;
/** Above the floor, so that its points do not cover it, m. */
const HEIGHT_M = 0.03;
/**
 * Until the robot has said how old the driver's view is, ms. Chosen: as on the link that prediction is
 * measured with (docs/prediction.md).
 */
const USUAL_LOOP_MS = 150;

/** How much of the wish the robot lets through. */
export type PathTone = 'free' | 'slower' | 'held';

const COLOURS: Readonly<Record<PathTone, number>> = { free: 0x35c9b5, slower: 0xf2b134, held: 0xe5484d };

export interface DrivenPath {
  /** Velocity that the driver asks for, m/s and rad/s. */
  linear: number;
  /** To the left; left out: 0. */
  lateral?: number;
  angular: number;
  /** Age of the driver's view when the robot takes a command; undefined while unknown. */
  loopMs: number | undefined;
  tone: PathTone;
}

/** Floor to where the robot would stand, and beyond: two ribbons as one object, because each object takes a display frame time. */
class Ribbons {
  readonly mesh: Mesh<BufferGeometry, MeshBasicMaterial>;
  readonly #stop: Float32Array;
  readonly #ahead: Float32Array;
  readonly #positions: BufferAttribute;

  constructor() {
    const positions = new Float32Array(2 * PAIRS * 6);
    for (let i = 2; i < positions.length; i += 3) positions[i] = HEIGHT_M;
    this.#stop = positions.subarray(0, PAIRS * 6);
    this.#ahead = positions.subarray(PAIRS * 6);
    this.#positions = movingAttribute(positions);
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', this.#positions);
    geometry.setAttribute(
      'color',
      strengthAttribute([
        [STRENGTHS.stop, 2 * PAIRS],
        [STRENGTHS.ahead, 2 * PAIRS],
      ]),
    );
    const steps = Array.from({ length: STEPS }, (_, i) => 2 * i);
    const quads = [...steps, ...steps.map((at) => at + 2 * PAIRS)];
    geometry.setIndex(quads.flatMap((at) => [at, at + 1, at + 2, at + 1, at + 3, at + 2]));
    const material = new MeshBasicMaterial({
      vertexColors: true,
      transparent: true,
      depthWrite: false,
      side: DoubleSide,
      forceSinglePass: true,
    });
    this.mesh = new Mesh(geometry, material);
    this.mesh.frustumCulled = false;
  }

  /** The last pair of points of the floor to where the robot would stand: x, y, z each. */
  get end(): Float32Array {
    return this.#stop.subarray(-6);
  }

  /** @param edge where the ribbons begin, and then end, metres of the way */
  set(
    curvature: number,
    width: SweptWidth,
    [edge, standing, ahead]: readonly [edge: number, standing: number, ahead: number],
  ): void {
    writeRibbon(curvature, width, edge, standing, this.#stop);
    writeRibbon(curvature, width, standing, ahead, this.#ahead);
    this.#positions.needsUpdate = true;
  }
}

/** The robot's outline where it is, where it would stand, and the line up to which it would drive, as one object. */
class Outlines {
  readonly lines: LineSegments<BufferGeometry, LineBasicMaterial>;
  #corners: RobotBody['footprint'] = [];

  constructor() {
    const material = new LineBasicMaterial({ vertexColors: true, transparent: true });
    this.lines = new LineSegments(new BufferGeometry(), material);
    this.lines.frustumCulled = false;
  }

  set corners(corners: RobotBody['footprint']) {
    this.#corners = corners;
    const { length } = corners;
    const positions = new Float32Array((2 * length + 1) * 6);
    for (let i = 2; i < positions.length; i += 3) positions[i] = HEIGHT_M;
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', movingAttribute(positions));
    geometry.setAttribute(
      'color',
      strengthAttribute([
        [STRENGTHS.outline, 2 * length],
        [STRENGTHS.standing, 2 * length],
        [STRENGTHS.stopLine, 2],
      ]),
    );
    this.lines.geometry.dispose();
    this.lines.geometry = geometry;
    this.#write(0, { x: 0, y: 0, yaw: 0 });
    this.hideWay();
  }

  hideWay(): void {
    this.lines.geometry.setDrawRange(0, 2 * this.#corners.length);
  }

  /** @param end the points between which the line lies up to which the robot would drive */
  showWay(stands: { x: number; y: number; yaw: number }, end: Float32Array): void {
    const { length } = this.#corners;
    this.#write(2 * length, stands);
    this.#positions.set(end, 4 * length * 3);
    this.lines.geometry.setDrawRange(0, 4 * length + 2);
  }

  get #positions(): BufferAttribute {
    return this.lines.geometry.getAttribute('position') as BufferAttribute;
  }

  /** Writes the outline from a vertex on. */
  #write(first: number, { x, y, yaw }: { x: number; y: number; yaw: number }): void {
    const positions = this.#positions;
    const [c, s] = [Math.cos(yaw), Math.sin(yaw)];
    const { length } = this.#corners;
    for (let i = 0; i < length; i++) {
      const corner = this.#corners[i] as RobotBody['footprint'][number];
      const [u, v] = [x + c * corner.x - s * corner.y, y + s * corner.x + c * corner.y];
      // Each corner ends one side and begins the next.
      positions.setXY(first + 2 * i, u, v);
      positions.setXY(first + ((2 * i + 2 * length - 1) % (2 * length)), u, v);
    }
    positions.needsUpdate = true;
  }
}

function movingAttribute(numbers: Float32Array): BufferAttribute {
  return new BufferAttribute(numbers, 3).setUsage(DynamicDrawUsage);
}

/** White vertices of these strengths: the material gives them their colour. */
function strengthAttribute(
  runs: readonly (readonly [strength: number, vertices: number])[],
): BufferAttribute {
  const numbers = runs.flatMap(([strength, vertices]) => Array.from({ length: vertices }, () => strength));
  return new BufferAttribute(new Float32Array(numbers.flatMap((strength) => [1, 1, 1, strength])), 4);
}

export class DrivePath {
  /** In base_link's axes. */
  readonly object = new Group();
  readonly #ribbons = new Ribbons();
  readonly #outlines = new Outlines();
  #body: RobotBody | null = null;
  /** What is shown: how far the robot goes before it stands, m, and its tone; `null` while it shows no way. */
  shown: { stopM: number; tone: PathTone } | null = null;
  #path: DrivenPath | null = null;

  constructor() {
    this.#ribbons.mesh.visible = false;
    this.object.add(this.#ribbons.mesh, this.#outlines.lines);
    this.object.visible = false;
  }

  /** Whether nearer points do not hide it. */
  set onTop(onTop: boolean) {
    for (const material of this.#materials) material.depthTest = !onTop;
  }

  /** The robot's outline; `null` while it is not known: then nothing is shown. */
  set body(body: RobotBody | null) {
    if (body === this.#body) return;
    this.#body = body;
    this.object.visible = body !== null;
    if (body === null) return;
    this.#outlines.corners = body.footprint;
    this.#draw();
  }

  /** The way on which the robot is told to go; `null` if nobody here drives it. */
  show(path: DrivenPath | null): void {
    const before = this.#path;
    this.#path = path;
    if (!isSame(path, before)) this.#draw();
  }

  #draw(): void {
    const path = this.#path;
    for (const material of this.#materials) material.color.setHex(COLOURS[path?.tone ?? 'free']);
    this.shown = null;
    const shows = path !== null && (path.linear !== 0 || (path.lateral ?? 0) !== 0) && this.#body !== null;
    this.#ribbons.mesh.visible = shows;
    if (!shows || this.#body === null) {
      this.#outlines.hideWay();
      return;
    }
    const { loopMs = USUAL_LOOP_MS, tone } = path;
    const { speed, heading, footprint } = this.#course(path, this.#body.footprint);
    const curvature = path.angular / speed;
    const direction = Math.sign(speed);
    const along = footprint.map(({ x }) => x);
    const edge = speed > 0 ? Math.max(...along) : Math.min(...along);
    const stopM = stoppingDistance(speed, loopMs, this.#body.decelerationMps2);
    this.shown = { stopM, tone };
    const aheadM = Math.max(stopM, LEAST_AHEAD_M, AHEAD_S * Math.abs(speed));
    const ends = [edge, edge + direction * stopM, edge + direction * aheadM] as const;
    this.#ribbons.set(curvature, sweptWidth(footprint, curvature), ends);
    this.#ribbons.mesh.rotation.z = heading;
    const stands = poseOnArc(curvature, direction * stopM);
    this.#outlines.showWay(
      { ...stands, ...turned(stands, heading) },
      turnedTriples(this.#ribbons.end, heading),
    );
  }

  /** The way of a robot that goes sideways is drawn along its motion, and turned: a heading of 0 is that of its x axis. */
  #course({ linear, lateral = 0 }: DrivenPath, footprint: RobotBody['footprint']) {
    if (lateral === 0) return { speed: linear, heading: 0, footprint };
    const heading = Math.atan2(lateral, linear);
    return {
      speed: Math.hypot(linear, lateral),
      heading,
      footprint: footprint.map((corner) => turned(corner, -heading)),
    };
  }

  get #materials() {
    return [this.#ribbons.mesh.material, this.#outlines.lines.material];
  }
}

function turned({ x, y }: { x: number; y: number }, by: number): { x: number; y: number } {
  const [c, s] = [Math.cos(by), Math.sin(by)];
  return { x: c * x - s * y, y: s * x + c * y };
}

/** @param triples x, y and z of each point */
function turnedTriples(triples: Float32Array, by: number): Float32Array {
  if (by === 0) return triples;
  const into = triples.slice();
  for (let at = 0; at + 2 < into.length; at += 3) {
    const { x, y } = turned({ x: into[at] ?? 0, y: into[at + 1] ?? 0 }, by);
    [into[at], into[at + 1]] = [x, y];
  }
  return into;
}

function isSame(a: DrivenPath | null, b: DrivenPath | null): boolean {
  if (a === null || b === null) return a === b;
  return (
    a.linear === b.linear &&
    (a.lateral ?? 0) === (b.lateral ?? 0) &&
    a.angular === b.angular &&
    a.loopMs === b.loopMs &&
    a.tone === b.tone
  );
}
