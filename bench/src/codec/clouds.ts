/** The clouds of the codec benchmark: PCD files, a folder of RGB-D images, or the simulated camera's frames. */
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import {
  decodeColourJpeg,
  decodeDepthPng,
  decodePcd,
  parseIntrinsics,
  pcdIntensity,
  pointsOfRgbd,
} from '@farpoint/cloud-formats';
import { zeroTwist } from '@farpoint/protocol';
import { Simulation } from '@farpoint/sim';
import type { BenchCloud } from './adapter.ts';

/** @throws Error naming the file */
export function pcdCloud(file: string): BenchCloud {
  if (!existsSync(file)) throw new Error(`${file}: there is no such file`);
  const bytes = readFileSync(file);
  try {
    const { header, points } = decodePcd(bytes);
    const organised = header.height > 1;
    const intensity = pcdIntensity(bytes);
    if (intensity !== null) writeIntensity(intensity, points);
    return withValid({
      name: basename(file, '.pcd'),
      width: header.width,
      height: header.height,
      intrinsics: null,
      frame: points,
      attribute: intensity === null ? 'colour' : 'intensity',
      depth: organised ? 'z' : 'range',
    });
  } catch (error) {
    throw new Error(`${file}: ${error instanceof Error ? error.message : String(error)}`, { cause: error });
  }
}

/** Keeps ranges 0…1 and 0…255; otherwise scales the largest value to 255. */
function writeIntensity(intensity: Float32Array, points: Float32Array): void {
  const words = new Uint32Array(points.buffer, points.byteOffset, points.length);
  let most = 0;
  for (const value of intensity) if (Number.isFinite(value) && value > most) most = value;
  const scale = most <= 1 ? 255 : most <= 255 ? 1 : 255 / most;
  intensity.forEach((value, i) => {
    words[i * 4 + 3] = Number.isFinite(value) ? Math.min(255, Math.max(0, Math.round(value * scale))) : 0;
  });
}

/**
 * A folder as laid out by Open3D: `color_*.jpg`, `depth_*.png`, `camera*.json`.
 *
 * @throws Error naming what is missing
 */
export function rgbdClouds(folder: string, most = 5): BenchCloud[] {
  if (!existsSync(folder)) throw new Error(`${folder}: there is no such folder`);
  const names = readdirSync(folder).sort();
  const colours = names.filter((name) => /^colou?r_.*\.jpe?g$/i.test(name));
  const depths = names.filter((name) => /^depth_.*\.png$/i.test(name));
  const camera = names.find((name) => /^camera.*\.json$/i.test(name));
  if (camera === undefined || depths.length === 0 || colours.length !== depths.length) {
    throw new Error(`${folder}: not pairs of color_*.jpg and depth_*.png with a camera*.json`);
  }
  const intrinsics = parseIntrinsics(readFileSync(join(folder, camera), 'utf8'));
  return depths.slice(0, most).map((depth, i) =>
    withValid({
      name: `${basename(folder)}/${basename(depth, '.png').replace(/^depth_/, '')}`,
      width: intrinsics.width,
      height: intrinsics.height,
      intrinsics,
      frame: pointsOfRgbd(
        decodeDepthPng(readFileSync(join(folder, depth))),
        decodeColourJpeg(readFileSync(join(folder, colours[i] as string))),
        intrinsics,
      ),
      attribute: 'colour',
      depth: 'z',
    }),
  );
}

/**
 * What the simulated robot sees as it drives.
 *
 * @param size side of the image in pixels
 */
export async function simulatedClouds(count = 3, size = 480): Promise<BenchCloud[]> {
  const simulation = await Simulation.create({ seed: 1, camera: { width: size, height: size } });
  const command = zeroTwist();
  command.linear.x = 0.5;
  command.angular.z = 0.3;
  const clouds: BenchCloud[] = [];
  for (let i = 0; i < count; i++) {
    for (let step = 0; step < 40; step++) {
      simulation.setCommand(command);
      simulation.step(1 / 30);
    }
    const { points } = simulation.renderFrame();
    // Copied as bytes, because copying floats might change the colours' bits.
    const bytes = Uint8Array.from(new Uint8Array(points.buffer, points.byteOffset, points.byteLength));
    const { width, height } = simulation.intrinsics;
    clouds.push(
      withValid({
        name: `simulated office ${i + 1}`,
        width,
        height,
        intrinsics: simulation.intrinsics,
        frame: new Float32Array(bytes.buffer),
        attribute: 'colour',
        depth: 'z',
      }),
    );
  }
  simulation.close();
  return clouds;
}

function withValid(cloud: Omit<BenchCloud, 'valid'>): BenchCloud {
  const { frame, depth } = cloud;
  const valid: number[] = [];
  for (let i = 0; i < frame.length / 4; i++) {
    const [x, y, z] = [frame[i * 4], frame[i * 4 + 1], frame[i * 4 + 2]] as [number, number, number];
    const measured = depth === 'z' ? z : Math.hypot(x, y, z);
    if (Number.isFinite(x + y + z) && measured > 1e-3) valid.push(i);
  }
  return { ...cloud, valid: Uint32Array.from(valid) };
}
