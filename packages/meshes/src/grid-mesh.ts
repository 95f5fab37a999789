import { type GridMesh, MESH_STEPS } from '@farpoint/protocol';
import type { IndexedMesh } from './indexed-mesh.ts';
import { MeshFault } from './mesh-fault.ts';

/** Puts a mesh, in metres, on the grid on which it is sent. @throws {MeshFault} `empty` if no triangle is left */
export function onGrid({ positions, triangles }: IndexedMesh): GridMesh {
  const min: [number, number, number] = [Infinity, Infinity, Infinity];
  let side = 0;
  for (let axis = 0; axis < 3; axis++) {
    let most = -Infinity;
    for (let i = axis; i < positions.length; i += 3) {
      const at = positions[i] as number;
      if (at < (min[axis] as number)) min[axis] = at;
      if (at > most) most = at;
    }
    side = Math.max(side, most - (min[axis] as number));
  }
  if (!(side > 0)) throw new MeshFault('empty', 'it is a point');
  const step = side / MESH_STEPS;
  const cells = positions.map((at, i) =>
    Math.min(MESH_STEPS, Math.round((at - (min[i % 3] as number)) / step)),
  );
  // Vertices of one cell become one, in the order in which triangles need them.
  const numbers = new Map<number, number>();
  const vertices: number[] = [];
  const kept: number[] = [];
  const cellOf = (vertex: number) => {
    const [x, y, z] = cells.subarray(3 * vertex, 3 * vertex + 3) as unknown as [number, number, number];
    return (x * (MESH_STEPS + 1) + y) * (MESH_STEPS + 1) + z;
  };
  for (let i = 0; i < triangles.length; i += 3) {
    const corners = [triangles[i], triangles[i + 1], triangles[i + 2]] as [number, number, number];
    const [a, b, c] = corners.map(cellOf);
    if (a === b || b === c || c === a) continue;
    for (const vertex of corners) {
      const cell = cellOf(vertex);
      let number = numbers.get(cell);
      if (number === undefined) {
        number = numbers.size;
        numbers.set(cell, number);
        vertices.push(...cells.subarray(3 * vertex, 3 * vertex + 3));
      }
      kept.push(number);
    }
  }
  if (kept.length === 0) throw new MeshFault('empty', 'its triangles are too small');
  return { min, step, vertices: Uint16Array.from(vertices), triangles: Uint16Array.from(kept) };
}
