/**
 * A robot's model from its URDF (https://wiki.ros.org/urdf/XML): its moving links and their shapes, in base_link. Links that
 * do not move against each other become one, so that a model is small and quickly drawn.
 */
import {
  compose,
  inverse,
  MAX_MODEL_M,
  MAX_MODEL_SHAPES,
  type ModelPart,
  type ModelPlace,
  type Pose,
} from '@farpoint/protocol';
import { type JointSource, jointSources } from './joint-sources.ts';
import type { LinkMeshes } from './link-meshes.ts';
import { UrdfFault } from './urdf-fault.ts';
import { type LinkShape, type LinkShapes, materialsOf, shapesOf } from './urdf-shapes.ts';
import { treeOf, type UrdfTree } from './urdf-tree.ts';
import { identity } from './urdf-values.ts';
import { readXml } from './xml.ts';

/** In the order in which the robot's pose is looked for (world-state.ts). */
const BASE_LINKS = ['base_link', 'base_footprint'];
/** Tenths of millimetres, and as fine for turns. */
const DIGITS = 4;

/** A model that can be told to operators. */
export interface RobotModel {
  /** The moving links, then the shapes. */
  parts: ModelPart[];
  /** Where the positions of the moving links come from, in their order. */
  joints: JointSource[];
  /** Of the links that have some, in the description's order. */
  meshes: LinkMeshes[];
}

/** @throws {UrdfFault} */
export function readUrdf(text: string): RobotModel {
  const robot = readXml(text);
  if (robot.name !== 'robot')
    throw new UrdfFault('not-urdf', `its root is <${robot.name}>, not <robot>`, robot.line);
  const macro = robot.children.find(({ name }) => name.startsWith('xacro:'));
  if (macro !== undefined)
    throw new UrdfFault('xacro', `<${macro.name}> is a macro: expand the file with xacro first`, macro.line);
  const tree = treeOf(robot);
  const materials = materialsOf(robot);
  const meshes: LinkMeshes[] = [];
  const bodies = bodiesOf(tree);
  const shapes: ModelPart[] = [];
  for (const { name, element } of tree.links) {
    const { body, pose } = bodies.of.get(name) as Placed;
    const drawn = shapesOf(element, materials);
    for (const shape of drawn.shapes) shapes.push(shapePart(body, pose, shape));
    if (drawn.meshes.length + drawn.unknown > 0) meshes.push(linkMeshes(body, pose, drawn, shapes.length));
    if (shapes.length > MAX_MODEL_SHAPES)
      throw new UrdfFault('too-many', `there are more than ${MAX_MODEL_SHAPES} shapes`);
  }
  return { parts: [...bodies.links, ...shapes], joints: jointSources(tree), meshes };
}

/** A link in what moves as one with it. */
interface Placed {
  /** 0: the base. */
  body: number;
  /** In that body. */
  pose: Pose;
}

/** Every link's body and place in it, and the bodies that move. */
function bodiesOf({ links }: UrdfTree): { of: Map<string, Placed>; links: ModelPart[] } {
  const of = new Map<string, Placed>();
  const moving: ModelPart[] = [];
  // The links that do not move against the root come first, so that it is known where base_link is.
  const base = basePose(links);
  for (const { name, joint } of links) {
    if (joint === null) {
      of.set(name, { body: 0, pose: base });
      continue;
    }
    const parent = of.get(joint.parent) as Placed;
    const pose = compose(parent.pose, joint.origin);
    if (joint.moves === null) {
      of.set(name, { body: parent.body, pose });
      continue;
    }
    const { x, y, z } = joint.axis;
    const axis: [number, number, number] = [rounded(x), rounded(y), rounded(z)];
    moving.push({ part: 'link', parent: parent.body, place: placeOf(pose), moves: joint.moves, axis });
    of.set(name, { body: moving.length, pose: identity() });
  }
  return { of, links: moving };
}

/** Of the root in base_link, if that does not move against the root; else none. */
function basePose(links: UrdfTree['links']): Pose {
  const inRoot = new Map<string, Pose>();
  for (const { name, joint } of links) {
    if (joint === null) inRoot.set(name, identity());
    const parent = joint === null || joint.moves !== null ? undefined : inRoot.get(joint.parent);
    if (joint !== null && parent !== undefined) inRoot.set(name, compose(parent, joint.origin));
  }
  const base = BASE_LINKS.map((name) => inRoot.get(name)).find((pose) => pose !== undefined);
  return base === undefined ? identity() : inverse(base);
}

function shapePart(link: number, inBody: Pose, { pose, form, size, colour }: LinkShape): ModelPart {
  const place = placeOf(compose(inBody, pose));
  const metres = size.map((each) => Math.max(rounded(each), 10 ** -DIGITS));
  return { part: 'shape', link, place, form, size: metres, colour };
}

/** @param end behind the link's shapes in those of the model */
function linkMeshes(
  link: number,
  inBody: Pose,
  { meshes, standIns, unknown }: LinkShapes,
  end: number,
): LinkMeshes {
  return {
    link,
    meshes: meshes.map(({ pose, ...mesh }) => ({ ...mesh, place: placeOf(compose(inBody, pose)) })),
    standIns: Array.from({ length: standIns }, (_, i) => end - standIns + i),
    unknown,
  };
}

/** @throws {UrdfFault} */
function placeOf({ position, orientation }: Pose): ModelPlace {
  const { x, y, z } = position;
  if (!(Math.max(Math.abs(x), Math.abs(y), Math.abs(z)) <= MAX_MODEL_M))
    throw new UrdfFault('bad-value', `a part is farther than ${MAX_MODEL_M} m from the base`);
  const { x: qx, y: qy, z: qz, w: qw } = orientation;
  const length = Math.hypot(qx, qy, qz, qw);
  const [a, b, c, d] = [qx, qy, qz, qw].map((share) => rounded(share / length)) as [
    ...[number, number, number, number],
  ];
  return [rounded(x), rounded(y), rounded(z), a, b, c, d];
}

/** Without −0. */
function rounded(number: number): number {
  return Number(number.toFixed(DIGITS)) + 0;
}
