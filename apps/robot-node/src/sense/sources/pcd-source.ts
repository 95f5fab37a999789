import { readdirSync, readFileSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { decodePcd, type PcdHeader, parsePcdHeader } from '@farpoint/cloud-formats';
import type { FrameSource } from '@farpoint/cloud-source';
import { PlaybackSource, STATIC_CAMERA_POSE } from './playback-source.ts';

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
