/** Clouds for measurements. */
import { Random } from '@farpoint/network-sim';

export interface SceneCloud {
  /** x, y, z in metres and colour bits of each point, as the encoder takes them. */
  frame: Float32Array;
  points: number;
}

/**
 * A depth camera's view along a hall with pillars: `points` points in rows of 480, at depths of 0.6 to 16 m. One
 * point in twenty is missing (NaN), as is usual with such cameras.
 */
export function hallCloud(points: number, seed = 1): SceneCloud {
  const uniform = new Random(seed, 0);
  const width = Math.min(480, points);
  const height = Math.ceil(points / width);
  const frame = new Float32Array(points * 4);
  const bits = new Uint32Array(frame.buffer);
  for (let i = 0; i < points; i++) {
    // Rays of a camera with a field of view of 80° in both directions, 1.2 m above the floor.
    const x = (((i % width) + 0.5) / width - 0.5) * 1.68;
    const y = ((Math.floor(i / width) + 0.5) / height - 0.5) * 1.68;
    const floor = y > 0 ? 1.2 / y : Infinity;
    const ceiling = y < 0 ? 1.8 / -y : Infinity;
    const wall = 3 / Math.abs(x);
    let z = Math.min(floor, ceiling, wall, 16);
    const pillars: [number, number][] = [
      [-1.1, 2.2],
      [1.4, 4.5],
      [-1.6, 8],
      [0.4, 11],
    ];
    for (const [centre, depth] of pillars) if (Math.abs(x * depth - centre) < 0.25) z = Math.min(z, depth);
    z *= 1 + (uniform.next() - 0.5) * 0.004 * z;
    if (uniform.next() < 0.05) z = Number.NaN;
    frame.set([x * z, y * z, z], i * 4);
    bits[i * 4 + 3] = (uniform.next() * 2 ** 32) >>> 0;
  }
  return { frame, points };
}

/** The depths (z) of the points that can be sent, and their indices in the frame. */
export function validDepths({ frame, points }: SceneCloud): { depths: Float64Array; indices: Uint32Array } {
  const depths: number[] = [];
  const indices: number[] = [];
  for (let i = 0; i < points; i++) {
    const [x, y, z] = frame.subarray(i * 4, i * 4 + 3) as unknown as [number, number, number];
    if (!Number.isFinite(x + y + z) || z < 1e-6) continue;
    if (Math.max(Math.abs(x), Math.abs(y), z) > Math.fround(32.767)) continue;
    depths.push(z);
    indices.push(i);
  }
  return { depths: Float64Array.from(depths), indices: Uint32Array.from(indices) };
}
