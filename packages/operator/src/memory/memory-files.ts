/** Writes a memory as the file of a point cloud, and adds what is in such a file to a memory. */
import { TICKS_PER_S } from './memory-layout.ts';
import { isPcd, readPcd, writePcd } from './pcd.ts';
import { readPly, writePly } from './ply.ts';
import type { PointFileFormat } from './point-file.ts';
import type { SurfelStore } from './surfel-store.ts';
import type { WorldMap } from './world-map.ts';

/** @param now ticks @param savedAt ISO 8601 */
export function writeMemory(
  store: SurfelStore,
  format: PointFileFormat,
  now: number,
  savedAt: string,
): ArrayBuffer {
  if (format === 'ply') return writePly(store, now, savedAt);
  return writePcd(store, format === 'pcd' ? 'binary' : 'ascii', now, savedAt);
}

/**
 * Adds the points of a PLY or PCD file.
 *
 * @param now ticks
 * @param agoS since the file was written
 * @returns how many were not remembered before
 * @throws {PointFileError}
 */
export function readIntoMemory(map: WorldMap, bytes: ArrayBuffer, now: number, agoS: number): number {
  const whole = new Uint8Array(bytes);
  const file = isPcd(whole) ? readPcd(whole) : readPly(whole);
  let points = 0;
  for (let i = 0; i < file.count; i++) {
    const [x, y, z] = [file.places[i * 3], file.places[i * 3 + 1], file.places[i * 3 + 2]];
    const ticks = Math.max(now - Math.round(((file.agesS[i] as number) + agoS) * TICKS_PER_S), 0);
    const isNew = map.restore(x as number, y as number, z as number, file.colours[i] as number, ticks);
    points += Number(isNew);
  }
  return points;
}
