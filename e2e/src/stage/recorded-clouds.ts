/** Clouds of real sensors, and of the simulated one, by the robot's own sources and encoders. */
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { repositoryRoot } from '@farpoint/local-stack';
import { encodeSource } from '@farpoint/robot-node/testing/encoded-source';
import type { CloudFile } from '@farpoint/webxr/cloud-file';

/** Recorded clouds that exist beside the repository on some machines. Tests that use them are skipped elsewhere. */
const cloudsFolder = join(repositoryRoot, '..', 'shared', 'data', 'clouds');
/** Why tests with recordings are skipped; `null` where there are some. */
export const noRecordings = existsSync(cloudsFolder) ? null : `no recordings at ${cloudsFolder}`;

const SOURCES: ReadonlyMap<string, Parameters<typeof encodeSource>[0]> = new Map([
  ['kinect-room', { kind: 'pcd', path: join(cloudsFolder, 'kinect-room.pcd'), frame: 'auto' }],
  ['stereo-table', { kind: 'pcd', path: join(cloudsFolder, 'stereo-table.pcd'), frame: 'auto' }],
  ['lidar-street', { kind: 'pcd', path: join(cloudsFolder, 'lidar-street.pcd'), frame: 'auto' }],
  ['rgbd-sequence', { kind: 'rgbd', path: join(cloudsFolder, 'rgbd-sequence') }],
  ['sim-office', { kind: 'sim', seed: 1, size: 480 }],
]);
const FRAMES: Readonly<Record<string, number>> = { 'rgbd-sequence': 5 };

/**
 * @param name of a recording, or with `-points64` at its end what operators get of it that read nothing else
 * @returns `null` if there is none of this name
 */
export async function recordedCloud(name: string): Promise<CloudFile | null> {
  const [, base = '', plain] = /^(.*?)(-points64)?$/.exec(name) ?? [];
  const source = SOURCES.get(base);
  if (source === undefined) return null;
  const { stream, frames } = await encodeSource(source, {
    ...{ mode: plain === undefined ? 'coded' : 'points64', frames: FRAMES[base] ?? 1 },
    ...{ framesPerSecond: 5, bitsPerSecond: 40e6 },
  });
  const base64 = (bytes: Uint8Array) => Buffer.from(bytes).toString('base64');
  return {
    ...(stream === null ? {} : { stream: { format: stream.format, header: base64(stream.header) } }),
    frames: frames.map((packets) => packets.map(base64)),
  };
}
