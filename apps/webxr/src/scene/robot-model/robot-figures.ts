/**
 * The robot's model where the robot was last reported, and as a ghost where it is predicted to be. Neither is drawn where it
 * would cover what the operator looks at: from the robot's own eyes, and while the eyes are inside it.
 */
import type { RobotModel } from '@farpoint/operator';
import {
  type Box3,
  type Camera,
  DirectionalLight,
  Group,
  HemisphereLight,
  type Material,
  Mesh,
  MeshLambertMaterial,
  type Object3D,
  Quaternion,
  Vector3,
} from 'three';
import { type FigureParts, figureParts, readPlace } from './figure-parts.ts';

/** A link that moves, and where it is while its joint is at 0. */
interface Joint {
  node: Group;
  position: Vector3;
  turn: Quaternion;
  axis: Vector3;
  slides: boolean;
}

/** The robot's model in the scene, with its joints where they are. */
class RobotFigure {
  /** At base_link, in the axes of REP-103. */
  readonly object = new Group();
  readonly #material: Material;
  readonly #moved = new Quaternion();
  #joints: Joint[] = [];

  constructor(material: Material) {
    this.#material = material;
  }

  /** Shows another model; the geometries stay their owner's. */
  set parts({ links, geometries }: FigureParts) {
    this.object.clear();
    const nodes = [this.object];
    const draw = (node: Group, link: number) => {
      const geometry = geometries[link];
      if (geometry) node.add(new Mesh(geometry, this.#material));
    };
    draw(this.object, 0);
    this.#joints = links.map(({ parent, place, axis, moves }) => {
      const [node, position, turn] = [new Group(), new Vector3(), new Quaternion()];
      readPlace(place, position, turn);
      (nodes[parent] as Group).add(node);
      draw(node, nodes.length);
      nodes.push(node);
      return { node, position, turn, axis: new Vector3(...axis).normalize(), slides: moves === 'slides' };
    });
    this.pose([]);
  }

  /** Allocates nothing. @param positions of the moving links: radians or metres; 0 where there is none */
  pose(positions: readonly number[]): void {
    const moved = this.#moved;
    for (let i = 0; i < this.#joints.length; i++) {
      const { node, position, turn, axis, slides } = this.#joints[i] as Joint;
      const at = positions[i] ?? 0;
      node.position.copy(position);
      node.quaternion.copy(turn);
      if (slides) node.translateOnAxis(axis, at);
      else node.quaternion.multiply(moved.setFromAxisAngle(axis, at));
    }
  }
}

/** In the colour of the ghost's outline, and behind what it coincides with. */
const GHOST = {
  color: 0xc9b8ff,
  transparent: true,
  opacity: 0.3,
  depthWrite: false,
  polygonOffset: true,
  polygonOffsetFactor: 2,
  polygonOffsetUnits: 8,
};
/**
 * Eyes that are nearer to the model than this see into it, metres. Chosen: twice the nearest that is drawn
 * (stage.ts).
 */
const NEAR_M = 0.1;

export class RobotFigures {
  readonly #solid = new RobotFigure(new MeshLambertMaterial({ vertexColors: true }));
  readonly #ghost = new RobotFigure(new MeshLambertMaterial(GHOST));
  readonly #lights = new Group();
  readonly #eye = new Vector3();
  #model: RobotModel | null = null;
  #changes = -1;
  #disposed: (() => void) | null = null;
  #bounds: Box3 | null = null;
  #positions: readonly number[] = [];

  /**
   * @param body where the robot was reported: it carries the model
   * @param predicted where it is predicted to be: it carries the ghost
   * @param world gets the lights, which light nothing but the model
   */
  constructor(body: Object3D, predicted: Object3D, world: Object3D) {
    body.add(this.#solid.object);
    predicted.add(this.#ghost.object);
    const sun = new DirectionalLight(0xffffff, 1.6);
    sun.position.set(-1, 1.5, 3);
    this.#lights.add(new HemisphereLight(0xffffff, 0x707a86, 1.7), sun);
    // The sky of three.js is at y, that of the robot's world at z.
    this.#lights.children[0]?.position.set(0, 0, 1);
    world.add(this.#lights);
    this.#isDrawn = false;
  }

  /** Whether there is a model to draw. */
  get known(): boolean {
    return this.#bounds !== null;
  }

  /** What is drawn: moving links, shapes, where the joints are, and whether it is hidden at present. */
  get shown(): { links: number; shapes: number; positions: readonly number[]; drawn: boolean } {
    const { links = [], shapes = [] } = this.known ? (this.#model ?? {}) : {};
    return {
      links: links.length,
      shapes: shapes.length,
      positions: this.#positions,
      drawn: this.#solid.object.visible,
    };
  }

  /** Shows this model, with its joints where they are; `null`: none. Cheap while only joints have moved. */
  show(model: RobotModel | null): void {
    if (model !== this.#model || (model?.changes ?? 0) !== this.#changes) this.#build(model);
    const positions = model?.positions ?? [];
    if (positions === this.#positions) return;
    this.#positions = positions;
    this.#solid.pose(positions);
    this.#ghost.pose(positions);
  }

  /** Allocates nothing. @param isFromRobot whether the operator looks from the robot's own eyes */
  place(isFromRobot: boolean, camera: Camera): void {
    this.#isDrawn = this.known && !isFromRobot && !this.#isInside(camera);
  }

  set #isDrawn(drawn: boolean) {
    this.#solid.object.visible = drawn;
    this.#ghost.object.visible = drawn;
    this.#lights.visible = drawn;
  }

  #isInside(camera: Camera): boolean {
    const eye = camera.getWorldPosition(this.#eye);
    this.#solid.object.worldToLocal(eye);
    return this.#bounds !== null && this.#bounds.distanceToPoint(eye) < NEAR_M;
  }

  #build(model: RobotModel | null): void {
    this.#model = model;
    this.#changes = model?.changes ?? 0;
    this.#disposed?.();
    const parts = figureParts(model ?? { links: [], shapes: [] });
    this.#disposed = () => {
      for (const geometry of parts.geometries) geometry?.dispose();
    };
    this.#solid.parts = parts;
    this.#ghost.parts = parts;
    this.#bounds = parts.bounds.isEmpty() ? null : parts.bounds;
    this.#positions = [];
  }
}
