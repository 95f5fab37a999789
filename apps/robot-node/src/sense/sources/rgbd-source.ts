import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import {
  decodeColourJpeg,
  decodeDepthPng,
  imagesOfRgbd,
  parseIntrinsics,
  parseTrajectoryLog,
} from '@farpoint/cloud-formats';
import type { FrameSource } from '@farpoint/cloud-source';
import { compose, inverse, type Pose } from '@farpoint/protocol';
import { withoutMark } from '@farpoint/service';
import { PlaybackSource, STATIC_CAMERA_POSE } from './playback-source.ts';

export interface RgbdSourceOptions {
  /**
   * A folder of paired `color_*.jpg` and `depth_*.png` (16 bits, millimetres), `camera_primesense.json` or another
   * single `camera*.json`, and optionally `odometry.log` or `trajectory.log`, as laid out by Open3D.
   */
  path: string;
}

/** @throws {Error} naming the file and what is wrong with it */
export function openRgbdSource({ path }: RgbdSourceOptions): FrameSource {
  const names = readdirSync(path).sort();
  const colours = names.filter((name) => /^colou?r_.*\.jpe?g$/i.test(name));
  const depths = names.filter((name) => /^depth_.*\.png$/i.test(name));
  if (depths.length === 0 || colours.length !== depths.length) {
    throw new Error(`${path}: ${colours.length} color_*.jpg and ${depths.length} depth_*.png, not pairs`);
  }
  const cameraFile = names.find((name) => /^camera.*\.json$/i.test(name));
  if (cameraFile === undefined) throw new Error(`${path}: no camera*.json with the intrinsics`);
  const camera = naming(join(path, cameraFile), parseIntrinsics);
  const { fx, fy, cx, cy } = camera;
  const poses = cameraPoses(path, depths.length);
  return new PlaybackSource(
    {
      kind: `rgbd (${depths.length} frames)`,
      width: camera.width,
      height: camera.height,
      capacity: camera.width * camera.height,
      camera: { fx, fy, cx, cy },
      depthMeasure: 'z',
    },
    depths.map((depth, i) => ({
      name: join(path, depth),
      load: () => ({
        form: 'images',
        ...imagesOfRgbd(
          decodeDepthPng(readFileSync(join(path, depth))),
          decodeColourJpeg(readFileSync(join(path, colours[i] as string))),
          camera,
        ),
      }),
      cameraPose: poses[i] as Pose,
    })),
  );
}

/**
 * The files' world has its own axes. It is placed so that the first camera is where a camera without poses would be;
 * the others move relative to it.
 */
function cameraPoses(path: string, count: number): Pose[] {
  const file = ['odometry.log', 'trajectory.log'].map((name) => join(path, name)).find(existsSync);
  if (file === undefined) return Array.from({ length: count }, () => STATIC_CAMERA_POSE);
  const poses = naming(file, parseTrajectoryLog);
  if (poses.length < count) throw new Error(`${file}: ${poses.length} poses for ${count} frames`);
  const fromFirst = inverse(poses[0] as Pose);
  return poses.slice(0, count).map((pose) => compose(STATIC_CAMERA_POSE, compose(fromFirst, pose)));
}

function naming<T>(file: string, parse: (text: string) => T): T {
  try {
    return parse(withoutMark(readFileSync(file, 'utf8')));
  } catch (error) {
    throw new Error(`${file}: ${error instanceof Error ? error.message : String(error)}`, { cause: error });
  }
}
