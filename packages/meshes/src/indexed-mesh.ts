import { MeshoptSimplifier } from 'meshoptimizer';
import { MeshFault } from './mesh-fault.ts';

/** Triangles that share their corners. */
export interface IndexedMesh {
  /** Three numbers for each vertex. */
  positions: Float32Array;
  /** Three vertices for each triangle. */
  triangles: Uint32Array;
}

/** Joins equal corners, and leaves out triangles that have two of them. @throws {MeshFault} `empty` */
export function joinCorners(corners: Float32Array): IndexedMesh {
  const first = MeshoptSimplifier.generatePositionRemap(corners, 3);
  return compacted(corners, first);
}

/** Reduces it to so many triangles. @throws {MeshFault} `too-many` if it cannot be */
export function reduced(mesh: IndexedMesh, most: number): IndexedMesh {
  const { positions, triangles } = mesh;
  if (triangles.length <= 3 * most) return mesh;
  // What is left is near to the mesh where its surface is one; else corners that are near each other are joined.
  let [left] = MeshoptSimplifier.simplify(triangles, positions, 3, 3 * most, 1);
  if (left.length > 3 * most)
    [left] = MeshoptSimplifier.simplifySloppy(triangles, positions, 3, null, 3 * most, 1);
  if (left.length === 0 || left.length > 3 * most)
    throw new MeshFault('too-many', `its ${triangles.length / 3} triangles cannot be reduced to ${most}`);
  return compacted(positions, left);
}

/** Keeps the vertices that are used. */
function compacted(positions: Float32Array, triangles: Uint32Array): IndexedMesh {
  const kept = new Uint32Array(triangles.length);
  let length = 0;
  for (let i = 0; i < triangles.length; i += 3) {
    const [a, b, c] = triangles.subarray(i, i + 3) as unknown as [number, number, number];
    if (a === b || b === c || c === a) continue;
    kept[length++] = a;
    kept[length++] = b;
    kept[length++] = c;
  }
  if (length === 0) throw new MeshFault('empty', 'it has no triangles');
  const numbers = new Int32Array(positions.length / 3).fill(-1);
  const out = new Float32Array(3 * length);
  let used = 0;
  const renumbered = kept.slice(0, length).map((vertex) => {
    if (numbers[vertex] === -1) {
      out.set(positions.subarray(3 * vertex, 3 * vertex + 3), 3 * used);
      numbers[vertex] = used++;
    }
    return numbers[vertex] as number;
  });
  return { positions: out.slice(0, 3 * used), triangles: renumbered };
}
