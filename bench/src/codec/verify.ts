/** Compares a decoder's output point by point with the input. */
import type { BenchCloud, DecodedCloud } from './adapter.ts';

export interface Verified {
  /** Largest |depth error| / depth², millimetres per square metre. */
  depthErrorMmPerZ2: number;
  /** Largest |depth error|, millimetres. */
  depthErrorMm: number;
  /** Largest distance of a point from its original position, metres. */
  worstM: number;
  /** Over all received points; null if they cannot be matched. Exact colours count as 99 dB. */
  colorPsnrDb: number | null;
  /** Points further from their source than allowed. */
  wrong: number;
}

/** @param allowedM distance beyond which a point counts as wrong; default: none does */
export function verify(cloud: BenchCloud, decoded: DecodedCloud, allowedM = Infinity): Verified {
  const { frame } = cloud;
  const bytes = new Uint8Array(frame.buffer, frame.byteOffset, frame.byteLength);
  const sources = decoded.source ?? nearest(cloud, decoded);
  let [perZ2, depthError, worst, squares, wrong] = [0, 0, 0, 0, 0];
  for (let i = 0; i < decoded.points; i++) {
    const source = sources[i] as number;
    const dx = at(decoded.metres, i * 3) - at(frame, source * 4);
    const dy = at(decoded.metres, i * 3 + 1) - at(frame, source * 4 + 1);
    const dz = at(decoded.metres, i * 3 + 2) - at(frame, source * 4 + 2);
    const distance = Math.hypot(dx, dy, dz);
    if (!(distance <= allowedM)) wrong++;
    worst = Math.max(worst, distance);
    const depth = depthOf(cloud, frame, source * 4);
    const error = Math.abs(depthOf(cloud, decoded.metres, i * 3) - depth) * 1000;
    depthError = Math.max(depthError, error);
    // A point at the sensor itself is not part of the cloud, though some files have one.
    if (depth > 1e-3) perZ2 = Math.max(perZ2, error / (depth * depth));
    for (let channel = 0; channel < 3; channel++) {
      const byte = source * 16 + 12 + (cloud.attribute === 'colour' ? channel : 0);
      squares += ((decoded.rgb[i * 3 + channel] as number) - (bytes[byte] as number)) ** 2;
    }
  }
  const mean = squares / Math.max(1, decoded.points * 3);
  const psnr = Math.min(99, 10 * Math.log10(255 ** 2 / mean));
  return {
    depthErrorMmPerZ2: perZ2,
    depthErrorMm: depthError,
    worstM: worst,
    colorPsnrDb: decoded.points === 0 || decoded.source === null ? null : psnr,
    wrong,
  };
}

function at(values: ArrayLike<number>, index: number): number {
  return values[index] as number;
}

function depthOf(cloud: BenchCloud, values: ArrayLike<number>, index: number): number {
  if (cloud.depth === 'z') return at(values, index + 2);
  return Math.hypot(at(values, index), at(values, index + 1), at(values, index + 2));
}

const CELL_M = 0.05;

/**
 * The nearest point of the cloud for each decoded one, within 5 to 10 cm; beyond that, any point, whose error is then
 * visible.
 */
function nearest(cloud: BenchCloud, decoded: DecodedCloud): Uint32Array {
  const { frame } = cloud;
  const cells = new Map<number, number[]>();
  // 2^16 cells per axis: ±1600 m.
  const key = (x: number, y: number, z: number) =>
    ((x + 32_768) * 65_536 + (y + 32_768)) * 65_536 + (z + 32_768);
  const cell = (metres: number) => Math.floor(metres / CELL_M);
  for (let index = 0; index < frame.length / 4; index++) {
    if (!Number.isFinite(at(frame, index * 4) + at(frame, index * 4 + 1) + at(frame, index * 4 + 2)))
      continue;
    const place = key(
      cell(at(frame, index * 4)),
      cell(at(frame, index * 4 + 1)),
      cell(at(frame, index * 4 + 2)),
    );
    const there = cells.get(place);
    if (there === undefined) cells.set(place, [index]);
    else there.push(index);
  }
  const found = new Uint32Array(decoded.points);
  for (let i = 0; i < decoded.points; i++) {
    const [x, y, z] = [0, 1, 2].map((axis) => at(decoded.metres, i * 3 + axis)) as [number, number, number];
    let [best, least] = [0, Infinity];
    for (let dx = -1; dx <= 1; dx++) {
      for (let dy = -1; dy <= 1; dy++) {
        for (let dz = -1; dz <= 1; dz++) {
          for (const index of cells.get(key(cell(x) + dx, cell(y) + dy, cell(z) + dz)) ?? []) {
            const square =
              (at(frame, index * 4) - x) ** 2 +
              (at(frame, index * 4 + 1) - y) ** 2 +
              (at(frame, index * 4 + 2) - z) ** 2;
            if (square < least) [best, least] = [index, square];
          }
        }
      }
    }
    found[i] = best;
  }
  return found;
}
