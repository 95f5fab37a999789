import { MeshFault } from './mesh-fault.ts';

/** Triangles that are read from one file. */
export const MAX_FILE_TRIANGLES = 500_000;
/** No coordinate in a file is larger: whatever the unit, a float32 is exact enough below. */
const MOST_COORDINATE = 1e6;

/** Triangles as they come out of a file: each with its own three corners. */
export class TriangleList {
  #corners: Float32Array;
  #length = 0;

  /** @param expected triangles, if that is known */
  constructor(expected = 256) {
    this.#corners = new Float32Array(9 * expected);
  }

  /** Nine numbers for each triangle, counter-clockwise from outside. */
  get corners(): Float32Array {
    return this.#corners.subarray(0, this.#length);
  }

  /** @throws {MeshFault} */
  addCorner(x: number, y: number, z: number): void {
    if (!(Math.abs(x) <= MOST_COORDINATE && Math.abs(y) <= MOST_COORDINATE && Math.abs(z) <= MOST_COORDINATE))
      throw new MeshFault('bad-mesh', 'a vertex is nowhere');
    if (this.#length >= 9 * MAX_FILE_TRIANGLES)
      throw new MeshFault('too-large', `it has more than ${MAX_FILE_TRIANGLES} triangles`);
    if (this.#length + 3 > this.#corners.length) {
      const larger = new Float32Array(Math.max(2 * this.#corners.length, 9));
      larger.set(this.#corners);
      this.#corners = larger;
    }
    this.#corners[this.#length++] = x;
    this.#corners[this.#length++] = y;
    this.#corners[this.#length++] = z;
  }
}
