/**
 * A robot's model from its URDF (https://wiki.ros.org/urdf/XML): its moving links and their shapes, in the robot's base. Links
 * that do not move against each other become one, so that a model is small and quickly drawn.
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
import { frameName } from '../messages.ts';
import { BASE_FRAMES } from '../world-state.ts';
import { type JointSource, jointSources } from './joint-sources.ts';
import { UrdfFault } from './urdf-fault.ts';
import { type LinkShape, materialsOf, shapesOf } from './urdf-shapes.ts';
import { treeOf, type UrdfJoint, type UrdfTree } from './urdf-tree.ts';
import { identity } from './urdf-values.ts';
import { readXml } from './xml.ts';

/** What xacro may leave behind: it stands for nothing itself. */
const XACRO_DEFINITIONS = ['xacro:arg', 'xacro:macro', 'xacro:property'];
/** Tenths of millimetres, and as fine for turns. */
const DIGITS = 4;

/** A model that can be told to operators. */
export interface RobotModel {
  /** The moving links, then the shapes. */
  parts: ModelPart[];
  /** Where the positions of the moving links come from, in their order. */
  joints: JointSource[];
  /** Meshes for which their links' collision shapes stand, and meshes for which nothing is drawn. */
  meshes: { replaced: number; missing: number };
  /** Shapes that are not drawn: their values are none, or they are too large or too far away. */
  undrawn: number;
}

/**
 * @param base the frame of the robot's base, with or without the prefix of its robot; `null`: the usual one
 * @throws {UrdfFault}
 */
export function readUrdf(text: string, base: string | null = null): RobotModel {
  const robot = readXml(text);
  if (robot.name !== 'robot')
    throw new UrdfFault('not-urdf', `its root is <${robot.name}>, not <robot>`, robot.line);
  const macro = robot.children.find(
    ({ name }) => name.startsWith('xacro:') && !XACRO_DEFINITIONS.includes(name),
  );
  if (macro !== undefined)
    throw new UrdfFault('xacro', `<${macro.name}> is a macro: expand the file with xacro first`, macro.line);
  const tree = treeOf(robot);
  const materials = materialsOf(robot);
  const meshes = { replaced: 0, missing: 0 };
  const bodies = bodiesOf(tree, baseLinks(base));
  const shapes: ModelPart[] = [];
  let undrawn = 0;
  for (const { name, element } of tree.links) {
    const drawn = shapesOf(element, materials);
    meshes.replaced += drawn.replaced;
    meshes.missing += drawn.missing;
    undrawn += drawn.unread;
    const placed = bodies.of.get(name);
    for (const shape of drawn.shapes) {
      const part = placed === undefined ? null : shapePart(placed, shape);
      if (part === null) undrawn++;
      else shapes.push(part);
    }
    if (shapes.length > MAX_MODEL_SHAPES)
      throw new UrdfFault('too-many', `there are more than ${MAX_MODEL_SHAPES} shapes`);
  }
  const all = new Map(tree.links.flatMap(({ joint }) => (joint === null ? [] : [[joint.name, joint]])));
  return { parts: [...bodies.links, ...shapes], joints: jointSources(bodies.joints, all), meshes, undrawn };
}

/** A link in what moves as one with it. */
interface Placed {
  /** 0: the base. */
  body: number;
  /** In that body. */
  pose: Pose;
}

interface Bodies {
  /** Every link's place in a body; without those beyond a joint that is too far away. */
  of: ReadonlyMap<string, Placed>;
  /** The bodies that move, and the joints by which they do. */
  links: ModelPart[];
  joints: UrdfJoint[];
}

function bodiesOf({ links }: UrdfTree, bases: readonly string[]): Bodies {
  const of = new Map<string, Placed>();
  const moving: ModelPart[] = [];
  const joints: UrdfJoint[] = [];
  // The links that do not move against the root come first, so that it is known where the base is.
  const base = basePose(links, bases);
  for (const { name, joint } of links) {
    if (joint === null) {
      of.set(name, { body: 0, pose: base });
      continue;
    }
    const parent = of.get(joint.parent);
    if (parent === undefined) continue;
    const pose = compose(parent.pose, joint.origin);
    if (joint.moves === null) {
      of.set(name, { body: parent.body, pose });
      continue;
    }
    const place = placeOf(pose);
    if (place === null) continue;
    const { how, axis } = joint.moves;
    const along: [number, number, number] = [rounded(axis.x), rounded(axis.y), rounded(axis.z)];
    moving.push({ part: 'link', parent: parent.body, place, moves: how, axis: along });
    joints.push(joint);
    of.set(name, { body: moving.length, pose: identity() });
  }
  return { of, links: moving, joints };
}

/** A description has no prefix where its frames have one. */
function baseLinks(base: string | null): readonly string[] {
  if (base === null) return BASE_FRAMES;
  const name = frameName(base);
  return [name, name.split('/').at(-1) ?? name, ...BASE_FRAMES];
}

/** Of the root in the base, if that does not move against the root; else none. */
function basePose(links: UrdfTree['links'], bases: readonly string[]): Pose {
  const inRoot = new Map<string, Pose>();
  for (const { name, joint } of links) {
    if (joint === null) inRoot.set(name, identity());
    const parent = joint === null || joint.moves !== null ? undefined : inRoot.get(joint.parent);
    if (joint !== null && parent !== undefined) inRoot.set(name, compose(parent, joint.origin));
  }
  const base = bases.map((name) => inRoot.get(name)).find((pose) => pose !== undefined);
  return base === undefined ? identity() : inverse(base);
}

/** `null` if it is too far away. */
function shapePart(
  { body, pose: inBody }: Placed,
  { pose, form, size, colour }: LinkShape,
): ModelPart | null {
  const place = placeOf(compose(inBody, pose));
  const metres = size.map((each) => Math.max(rounded(each), 10 ** -DIGITS));
  return place === null ? null : { part: 'shape', link: body, place, form, size: metres, colour };
}

/** `null` if it is too far away. */
function placeOf({ position, orientation }: Pose): ModelPlace | null {
  const { x, y, z } = position;
  if (!(Math.max(Math.abs(x), Math.abs(y), Math.abs(z)) <= MAX_MODEL_M)) return null;
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

/** What a description says: a model, or why there is none. */
export type ModelNews = { kind: 'model'; model: RobotModel } | { kind: 'refused'; fault: UrdfFault };

/** Where joints are, by their names: radians or metres. */
export type JointNews = readonly (readonly [name: string, position: number])[];
