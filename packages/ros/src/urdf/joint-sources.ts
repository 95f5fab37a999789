/** Where the positions of a model's moving links come from: joints by name, some of which follow others. */
import { UrdfFault } from './urdf-fault.ts';
import type { UrdfTree } from './urdf-tree.ts';

/** A moving link's position: `multiplier` times that of a joint, and `offset`. */
export interface JointSource {
  /** The joint, as joint states name it. */
  name: string;
  moves: 'turns' | 'slides';
  multiplier: number;
  /** Radians or metres. */
  offset: number;
}

/** Of the moving links, in the tree's order. @throws {UrdfFault} */
export function jointSources({ links }: UrdfTree): JointSource[] {
  const joints = new Map(
    links.flatMap(({ joint }) => (joint === null ? [] : [[joint.name, joint] as const])),
  );
  return [...joints.values()].flatMap((joint) => {
    const { moves } = joint;
    if (moves === null) return [];
    let [at, multiplier, offset] = [joint, 1, 0];
    for (let followed = 0; at.mimic !== null; followed++) {
      const { mimic } = at;
      const next = joints.get(mimic.joint);
      if (next === undefined) throw new UrdfFault('unknown-name', `there is no joint ${mimic.joint}`);
      if (followed > joints.size) throw new UrdfFault('not-a-tree', `${joint.name} follows itself`);
      offset += multiplier * mimic.offset;
      multiplier *= mimic.multiplier;
      at = next;
    }
    if (!Number.isFinite(multiplier) || !Number.isFinite(offset))
      throw new UrdfFault('bad-value', `${joint.name} follows another too fast`);
    return [{ name: at.name, moves, multiplier, offset }];
  });
}
