/** The links and joints of a robot description, which form a tree. */
import { MAX_MODEL_LINKS, type Pose, type Vector3 } from '@farpoint/protocol';
import { UrdfFault } from './urdf-fault.ts';
import { attribute, axisOf, childOf, faultAt, numbers, originOf } from './urdf-values.ts';
import type { XmlElement } from './xml.ts';

/** Links of a description. Chosen: many have no shape, and only those with one are drawn; above any robot’s. */
const MAX_LINKS = 2048;

/** URDF's types of joints. Those that move in several ways are drawn where they begin, and have no axis that counts. */
const MOVES = {
  revolute: 'turns',
  continuous: 'turns',
  prismatic: 'slides',
  fixed: null,
  floating: null,
  planar: null,
} as const;

/** A joint that follows another: its position is `multiplier` times the other's, and `offset`. */
export interface Mimic {
  joint: string;
  multiplier: number;
  /** Radians or metres. */
  offset: number;
}

export interface UrdfJoint {
  name: string;
  parent: string;
  child: string;
  /** Of the child in the parent, while the joint is at 0. */
  origin: Pose;
  /** `null`: not in a way that is shown. */
  moves: { how: 'turns' | 'slides'; axis: Vector3 } | null;
  mimic: Mimic | null;
}

/** Links from the root on, each after its parent. */
export interface UrdfTree {
  /** @param joint by which it hangs on its parent; `null`: the root */
  links: { name: string; element: XmlElement; joint: UrdfJoint | null }[];
}

/** @throws {UrdfFault} */
export function treeOf(robot: XmlElement): UrdfTree {
  const links = new Map<string, XmlElement>();
  for (const element of robot.children.filter(({ name }) => name === 'link')) {
    const name = attribute(element, 'name');
    if (links.has(name)) throw faultAt(element, `the link ${name} is there twice`);
    links.set(name, element);
  }
  if (links.size > MAX_LINKS) throw new UrdfFault('too-many', `there are more than ${MAX_LINKS} links`);
  const joints = jointsOf(robot, links);
  const roots = [...links.keys()].filter((name) => !joints.has(name));
  const [root] = roots;
  if (root === undefined || roots.length > 1)
    throw new UrdfFault(
      'not-a-tree',
      root === undefined ? 'no link is the root' : `${root} and ${roots[1]} have no parent`,
    );
  const children = new Map<string, UrdfJoint[]>();
  for (const joint of joints.values()) {
    const siblings = children.get(joint.parent) ?? [];
    siblings.push(joint);
    children.set(joint.parent, siblings);
  }
  const ordered: UrdfTree['links'] = [{ name: root, element: links.get(root) as XmlElement, joint: null }];
  // The list grows while it is walked: each link appends its children.
  for (const { name } of ordered)
    for (const joint of children.get(name) ?? [])
      ordered.push({ name: joint.child, element: links.get(joint.child) as XmlElement, joint });
  if (ordered.length < links.size) throw new UrdfFault('not-a-tree', 'joints form a ring');
  return { links: ordered };
}

/** By the links that hang on them. */
function jointsOf(robot: XmlElement, links: ReadonlyMap<string, XmlElement>): Map<string, UrdfJoint> {
  const byChild = new Map<string, UrdfJoint>();
  const names = new Set<string>();
  let moving = 0;
  for (const element of robot.children) {
    if (element.name !== 'joint') continue;
    const joint = jointOf(element);
    const { name, parent, child } = joint;
    if (names.has(name)) throw faultAt(element, `the joint ${name} is there twice`);
    names.add(name);
    for (const link of [parent, child])
      if (!links.has(link)) throw new UrdfFault('unknown-name', `there is no link ${link}`, element.line);
    if (byChild.has(child)) throw new UrdfFault('not-a-tree', `${child} has two parents`, element.line);
    byChild.set(child, joint);
    if (joint.moves !== null) moving++;
  }
  if (moving > MAX_MODEL_LINKS)
    throw new UrdfFault('too-many', `more than ${MAX_MODEL_LINKS} joints can move`);
  return byChild;
}

function jointOf(element: XmlElement): UrdfJoint {
  const linkOf = (end: string) => {
    const child = childOf(element, end);
    if (child === undefined) throw faultAt(element, `the joint has no ${end}`);
    return attribute(child, 'link');
  };
  const type = attribute(element, 'type');
  if (!Object.hasOwn(MOVES, type)) throw faultAt(element, 'URDF has no joints of this type');
  const how = MOVES[type as keyof typeof MOVES];
  const axis = how === null ? null : axisOf(element);
  const mimic = childOf(element, 'mimic');
  const factor = (of: XmlElement, key: string, otherwise: number) =>
    of.attributes.has(key) ? (numbers(of, key, 1)[0] as number) : otherwise;
  return {
    name: attribute(element, 'name'),
    parent: linkOf('parent'),
    child: linkOf('child'),
    origin: originOf(element),
    moves: how === null || axis === null ? null : { how, axis },
    mimic:
      mimic === undefined
        ? null
        : {
            joint: attribute(mimic, 'joint'),
            multiplier: factor(mimic, 'multiplier', 1),
            offset: factor(mimic, 'offset', 0),
          },
  };
}
