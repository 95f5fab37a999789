import { existsSync, readdirSync, readFileSync, statSync } from 'node:fs';
import { join } from 'node:path';
import {
  decodeColourJpeg,
  decodeDepthPng,
  decodePcd,
  imagesOfRgbd,
  type PcdHeader,
  parseIntrinsics,
  parsePcdHeader,
  parseTrajectoryLog,
} from '@farpoint/cloud-formats';
import type { FrameSource, Mounted } from '@farpoint/cloud-source';
import { compose, inverse, type Pose } from '@farpoint/protocol';
import { withoutMark } from '@farpoint/service';
import { monotonicMs } from '../../ground/clock.ts';
import { type GraphOptions, openGraph } from '../../ground/ros/open-graph.ts';
import { wallNs } from '../../ground/wall-clock.ts';
import { type CloudShmOptions, CloudShmSource } from './cloud-shm-source.ts';
import { PlaybackSource, STATIC_CAMERA_POSE } from './playback-source.ts';
import { RecordingSource, type RecordingSourceOptions } from './recording-source.ts';
import { type ReferenceShmOptions, ReferenceShmSource } from './reference-shm-source.ts';
import { RosSource, type RosSourceOptions } from './ros-source.ts';
import { SimLidarSource, type SimLidarSourceOptions } from './sim-lidar-source.ts';
import { SimSource, type SimSourceOptions } from './sim-source.ts';
import { TriggeredSource } from './triggered-source.ts';

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

/** The axes of the file's points (REP-103): optical (z forward, x right, y down) or body (x forward, y left, z up). */
export type PcdFrame = 'optical' | 'body';

export interface PcdSourceOptions {
  /** A `.pcd` file, or a folder of them, played in name order. */
  path: string;
  /** `auto`: optical if the first cloud is a grid, as from a depth camera, otherwise body, as from a LiDAR. */
  frame: PcdFrame | 'auto';
}

/** @throws {Error} naming the file and what is wrong with it */
export function openPcdSource({ path, frame }: PcdSourceOptions): FrameSource {
  const files = statSync(path).isDirectory()
    ? readdirSync(path)
        .filter((name) => name.toLowerCase().endsWith('.pcd'))
        .sort()
        .map((name) => join(path, name))
    : [path];
  if (files.length === 0) throw new Error(`${path}: no .pcd file in this folder`);
  const headers = files.map(readHeader);
  const first = headers[0] as PcdHeader;
  const axes = frame === 'auto' ? (first.height > 1 ? 'optical' : 'body') : frame;
  const capacity = Math.max(...headers.map((header) => header.points), 1);
  const sameGrid = headers.every(({ width, height }) => width === first.width && height === first.height);
  return new PlaybackSource(
    {
      kind: `pcd (${axes} frame, ${files.length} ${files.length === 1 ? 'file' : 'files'})`,
      width: sameGrid ? Math.max(first.width, 1) : capacity,
      height: sameGrid ? Math.max(first.height, 1) : 1,
      capacity,
      camera: null,
      depthMeasure: axes === 'body' ? 'range' : 'z',
    },
    files.map((file) => ({
      name: file,
      load: () => {
        const { points } = decodePcd(readFileSync(file));
        if (axes === 'body') bodyToOptical(points);
        return { form: 'points', points, count: points.length / 4 };
      },
      cameraPose: STATIC_CAMERA_POSE,
    })),
  );
}

/** Converts the points in place: x_optical = −y, y_optical = −z, z_optical = x. */
export function bodyToOptical(points: Float32Array): void {
  for (let i = 0; i < points.length; i += 4) {
    const x = points[i] as number;
    points[i] = -(points[i + 1] as number);
    points[i + 1] = -(points[i + 2] as number);
    points[i + 2] = x;
  }
}

function readHeader(file: string): PcdHeader {
  try {
    return parsePcdHeader(readFileSync(file));
  } catch (error) {
    throw new Error(`${file}: ${error instanceof Error ? error.message : String(error)}`, { cause: error });
  }
}

/** Which source to open. Plain data, so that it can be passed to the worker. */
export type SourceOptions =
  | ({ kind: 'sim' } & SimSourceOptions)
  | ({ kind: 'sim-lidar' } & SimLidarSourceOptions)
  | (RealSourceOptions & Mounted);

/** Sources whose sensors sit where nobody but the configuration may know. */
type RealSourceOptions =
  | ({ kind: 'pcd' } & PcdSourceOptions)
  | ({ kind: 'rgbd' } & RgbdSourceOptions)
  | ({ kind: 'recording' } & RecordingSourceOptions)
  | ({ kind: 'ros'; graph: GraphOptions } & RosSourceOptions)
  | ({ kind: 'shm'; layout: 'farpoint' } & CloudShmOptions)
  | ({ kind: 'shm'; layout: 'reference' } & ReferenceShmOptions);

/** @throws {Error} naming what could not be opened and why */
export async function openSource(options: SourceOptions): Promise<FrameSource> {
  switch (options.kind) {
    case 'sim': {
      const source = await SimSource.create(options);
      const { triggerPerS } = options;
      return triggerPerS === undefined ? source : new TriggeredSource(source, triggerPerS);
    }
    case 'sim-lidar':
      return SimLidarSource.create(options);
    case 'pcd':
      return openPcdSource(options);
    case 'rgbd':
      return openRgbdSource(options);
    case 'recording':
      return RecordingSource.open(options, monotonicMs);
    case 'ros':
      return RosSource.open(await openGraph(options.graph, 'capture'), options, { now: monotonicMs, wallNs });
    case 'shm':
      return options.layout === 'reference'
        ? ReferenceShmSource.open(options, monotonicMs)
        : CloudShmSource.open(options, monotonicMs);
  }
}
