/** Where the positions of a model's moving links come from: joints by name, some of which follow others. */
import type { UrdfJoint } from './urdf-tree.ts';

/** A moving link's position: `multiplier` times that of a joint, and `offset`. */
export interface JointSource {
  /** The joint, as joint states name it. */
  name: string;
  moves: 'turns' | 'slides';
  multiplier: number;
  /** Radians or metres. */
  offset: number;
}

/**
 * Of joints that move, in their order. One that follows a joint that does not exist, or in a ring itself, has the
 * position that is told for itself.
 *
 * @param all by name
 */
export function jointSources(
  moving: readonly UrdfJoint[],
  all: ReadonlyMap<string, UrdfJoint>,
): JointSource[] {
  return moving.flatMap((joint) => {
    const { name, moves } = joint;
    return moves === null
      ? []
      : [{ moves: moves.how, ...(followed(joint, all) ?? { name, multiplier: 1, offset: 0 }) }];
  });
}

/** `null` if it ends nowhere. */
function followed(joint: UrdfJoint, all: ReadonlyMap<string, UrdfJoint>): Omit<JointSource, 'moves'> | null {
  let [at, multiplier, offset] = [joint, 1, 0];
  for (let steps = 0; at.mimic !== null; steps++) {
    const { mimic } = at;
    const next = all.get(mimic.joint);
    if (next === undefined || steps > all.size) return null;
    offset += multiplier * mimic.offset;
    multiplier *= mimic.multiplier;
    at = next;
  }
  return Number.isFinite(multiplier) && Number.isFinite(offset)
    ? { name: at.name, multiplier, offset }
    : null;
}
