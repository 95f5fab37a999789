/** Reads the recorded clouds in which the guard is tried. */
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { decodeDepthPng, decodePcd, parseIntrinsics, parseTrajectoryLog } from '@farpoint/cloud-formats';
import { compose, inverse, type Pose } from '@farpoint/protocol';
import { type RecordedCloud, RecordedRoom, transformOf } from './recorded-room.ts';

/** The Kinect's and the Xtion's focal length at 640 pixels. */
const FOCAL = 525;
const CLOUDS = ['kinect-room', 'stereo-table'] as const;
const SEQUENCE = 'rgbd-sequence';

/** @returns the rooms there are, and what was left out and why */
export function readRooms(folder: string): { rooms: RecordedRoom[]; skipped: string[] } {
  const rooms: RecordedRoom[] = [];
  const skipped: string[] = [];
  const add = (name: string, file: string, read: (file: string) => Float32Array) => {
    if (!existsSync(file)) {
      skipped.push(`${name}: not in ${folder}`);
      return;
    }
    const cloud: RecordedCloud = { name, points: read(file), focal: FOCAL, width: 640 };
    const room = RecordedRoom.of(cloud);
    if (room === null) skipped.push(`${name}: it shows no floor to stand on`);
    else rooms.push(room);
  };
  add(SEQUENCE, join(folder, SEQUENCE), readSequence);
  for (const name of CLOUDS) {
    add(name, join(folder, `${name}.pcd`), (file) => decodePcd(readFileSync(file)).points.slice());
  }
  return { rooms, skipped };
}

/** All frames of an RGB-D recording, in the first one's frame. */
function readSequence(folder: string): Float32Array {
  const text = (name: string) => readFileSync(join(folder, name), 'utf8');
  const camera = parseIntrinsics(text('camera_primesense.json'));
  const poses = parseTrajectoryLog(text('odometry.log'));
  const names = readdirSync(folder)
    .filter((name) => /^depth_.*\.png$/.test(name))
    .sort();
  const clouds = names.map((name, i) => {
    const { millimetres } = decodeDepthPng(readFileSync(join(folder, name)));
    const toFirst = compose(inverse(poses[0] as Pose), poses[i] as Pose);
    const points = new Float32Array(millimetres.length * 4).fill(Number.NaN);
    const toWorld = transformOf(toFirst);
    for (let pixel = 0; pixel < millimetres.length; pixel++) {
      const z = (millimetres[pixel] as number) / 1000;
      if (z === 0) continue;
      const x = (((pixel % camera.width) - camera.cx) / camera.fx) * z;
      const y = ((Math.floor(pixel / camera.width) - camera.cy) / camera.fy) * z;
      toWorld(x, y, z, points, pixel * 4);
    }
    return points;
  });
  const together = new Float32Array(clouds.reduce((sum, { length }) => sum + length, 0));
  let offset = 0;
  for (const cloud of clouds) {
    together.set(cloud, offset);
    offset += cloud.length;
  }
  return together;
}
