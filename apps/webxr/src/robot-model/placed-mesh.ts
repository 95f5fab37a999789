/** A mesh of the robot's model in its place, as triangles that each have their own normal: edges stay edges. */
import type { GridMesh } from '@farpoint/operator';
import { type Matrix4, Vector3 } from 'three';
import type { PlacedTriangles } from './placed-triangles.ts';

const at = new Vector3();

/** Written without objects for each vertex: 20,000 triangles come at once, between two display frames. */
export function placedMesh({ min, step, vertices, triangles }: GridMesh, place: Matrix4): PlacedTriangles {
  const placed = new Float32Array(vertices.length);
  for (let i = 0; i < vertices.length; i += 3) {
    const [x, y, z] = [vertices[i], vertices[i + 1], vertices[i + 2]] as [number, number, number];
    at.set(min[0] + step * x, min[1] + step * y, min[2] + step * z);
    at.applyMatrix4(place).toArray(placed, i);
  }
  const positions = new Float32Array(3 * triangles.length);
  const normals = new Float32Array(3 * triangles.length);
  for (let corner = 0; corner < triangles.length; corner++) {
    const vertex = 3 * (triangles[corner] as number);
    for (let axis = 0; axis < 3; axis++) positions[3 * corner + axis] = placed[vertex + axis] as number;
  }
  for (let i = 0; i < positions.length; i += 9) writeNormal(positions, normals, i);
  return { positions, normals };
}

/** Of the triangle whose first corner is at `i`, for its three corners. */
function writeNormal(positions: Float32Array, normals: Float32Array, i: number): void {
  const side = (corner: number, axis: number) =>
    (positions[i + 3 * corner + axis] as number) - (positions[i + axis] as number);
  const [ax, ay, az, bx, by, bz] = [side(1, 0), side(1, 1), side(1, 2), side(2, 0), side(2, 1), side(2, 2)];
  const [x, y, z] = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
  const length = Math.hypot(x, y, z) || 1;
  for (let corner = i; corner < i + 9; corner += 3) {
    normals[corner] = x / length;
    normals[corner + 1] = y / length;
    normals[corner + 2] = z / length;
  }
}
