/** The clouds of the sampling plot, from the simulated camera or from a PCD file. */
import { readFile } from 'node:fs/promises';
import { Simulation } from '@farpoint/sim';
import { PCDLoader } from 'three/examples/jsm/loaders/PCDLoader.js';
import type { SceneCloud } from './sampling-scene.ts';

/** What the simulated robot's camera sees at its start. */
export async function simulatedCloud(): Promise<SceneCloud> {
  const simulation = await Simulation.create({ seed: 1 });
  const { points } = simulation.renderFrame();
  // Copied as bytes, because copying floats might change the colours' bits.
  const frame = new Float32Array(
    Uint8Array.from(new Uint8Array(points.buffer, points.byteOffset, points.byteLength)).buffer,
  );
  return { frame, points: points.length / 4 };
}

/**
 * A PCD file (ASCII, binary or compressed). Its coordinates are taken as an optical frame: z forward.
 *
 * @throws Error naming the file
 */
export async function pcdCloud(file: string): Promise<SceneCloud> {
  const bytes = await readFile(file);
  let positions: ArrayLike<number>;
  try {
    const cloud = new PCDLoader().parse(new Uint8Array(bytes).buffer);
    positions = cloud.geometry.getAttribute('position').array;
  } catch (error) {
    throw new Error(
      `${file} is not a PCD file that can be read: ${error instanceof Error ? error.message : error}`,
    );
  }
  const points = positions.length / 3;
  if (points === 0) throw new Error(`${file} has no points with x, y and z`);
  const frame = new Float32Array(points * 4);
  for (let i = 0; i < points; i++) {
    for (let axis = 0; axis < 3; axis++) frame[i * 4 + axis] = positions[i * 3 + axis] as number;
  }
  return { frame, points };
}
