/**
 * The remembered world as PCD 0.7 ("The PCD (Point Cloud Data) file format", pointclouds.org), binary or as text: x, y, z in
 * metres (REP-103), `rgb` as 24 bits, and `age`, the seconds since a point was last seen when the file was written. Read
 * back by name; other fields are skipped. The viewpoint is not applied, as other programs do not.
 */
import {
  type PcdColumn,
  PcdError,
  type PcdHeader,
  parsePcdHeader,
  pcdPointReader,
} from '@farpoint/cloud-formats/pcd';
import { TICKS_PER_S } from './memory-layout.ts';
import {
  eachKeptPoint,
  FilePoints,
  keptPoints,
  MAX_HEADER,
  MAX_POINTS,
  NO_COLOUR,
  PointFileError,
  SAVED,
} from './point-file.ts';
import type { SurfelStore } from './surfel-store.ts';

/** Bytes of a point that is written. */
const POINT_BYTES = 5 * 4;
/** Text is encoded in pieces of so many points. */
const POINTS_AT_ONCE = 10_000;
/** When a memory was saved, in a comment. */
const SAVED_LINE = new RegExp(`^#[ \\t]+${SAVED}[ \\t]+(\\S+)`, 'm');
const NO_COLOURS = (NO_COLOUR << 16) | (NO_COLOUR << 8) | NO_COLOUR;

/** @param ticks now, on the memory's clock @param savedAt now, ISO 8601 */
export function writePcd(
  store: SurfelStore,
  data: 'ascii' | 'binary',
  ticks: number,
  savedAt: string,
): ArrayBuffer {
  const points = keptPoints(store);
  const encoder = new TextEncoder();
  const header = encoder.encode(
    [
      '# .PCD v0.7 - Point Cloud Data file format',
      `# ${SAVED} ${savedAt}`,
      'VERSION 0.7',
      'FIELDS x y z rgb age',
      'SIZE 4 4 4 4 4',
      'TYPE F F F U F',
      'COUNT 1 1 1 1 1',
      `WIDTH ${points}`,
      'HEIGHT 1',
      'VIEWPOINT 0 0 0 1 0 0 0',
      `POINTS ${points}`,
      `DATA ${data}\n`,
    ].join('\n'),
  );
  const ageOf = (seen: number) => Math.max(ticks - seen, 0) / TICKS_PER_S;
  if (data === 'ascii') {
    const pieces = [header];
    let lines: string[] = [];
    const encode = () => {
      pieces.push(encoder.encode(lines.join('')));
      lines = [];
    };
    eachKeptPoint(store, (x, y, z, rgb, seen) => {
      lines.push(`${x.toFixed(4)} ${y.toFixed(4)} ${z.toFixed(4)} ${rgb} ${ageOf(seen).toFixed(1)}\n`);
      if (lines.length === POINTS_AT_ONCE) encode();
    });
    encode();
    return joined(pieces);
  }
  const buffer = new ArrayBuffer(header.length + points * POINT_BYTES);
  new Uint8Array(buffer).set(header);
  const view = new DataView(buffer);
  let at = header.length;
  eachKeptPoint(store, (x, y, z, rgb, seen) => {
    view.setFloat32(at, x, true);
    view.setFloat32(at + 4, y, true);
    view.setFloat32(at + 8, z, true);
    view.setUint32(at + 12, rgb, true);
    view.setFloat32(at + 16, ageOf(seen), true);
    at += POINT_BYTES;
  });
  return buffer;
}

function joined(pieces: readonly Uint8Array[]): ArrayBuffer {
  const whole = new Uint8Array(pieces.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const piece of pieces) {
    whole.set(piece, at);
    at += piece.length;
  }
  return whole.buffer;
}

/** Whether a file looks like PCD. */
export function isPcd(bytes: Uint8Array): boolean {
  return /^(?:#.*\r?\n)*(?:VERSION|FIELDS)\s/.test(headOf(bytes));
}

/** @throws {PointFileError} says what is wrong */
export function readPcd(bytes: Uint8Array): FilePoints {
  if (!isPcd(bytes)) throw new PointFileError('this is no PCD file');
  try {
    return readPoints(bytes, parsePcdHeader(bytes, MAX_POINTS));
  } catch (error) {
    if (error instanceof PcdError) throw new PointFileError(error.message, { cause: error });
    throw error;
  }
}

function headOf(bytes: Uint8Array): string {
  return new TextDecoder('latin1').decode(bytes.subarray(0, MAX_HEADER));
}

/** @throws {PcdError} */
function readPoints(bytes: Uint8Array, header: PcdHeader): FilePoints {
  const find = (name: string) => header.fields.find((field) => field.name === name);
  const [x, y, z] = [find('x'), find('y'), find('z')];
  if (x === undefined || y === undefined || z === undefined)
    throw new PointFileError(`a point has no ${x === undefined ? 'x' : y === undefined ? 'y' : 'z'}`);
  const colour = find('rgb') ?? find('rgba');
  const age = find('age');
  const isKnown = colour?.size === 4;
  const columns: PcdColumn[] = [{ field: x }, { field: y }, { field: z }];
  if (colour !== undefined && isKnown) columns.push({ field: colour, isColour: true });
  if (age !== undefined) columns.push({ field: age });
  const read = pcdPointReader(bytes, header);
  const [, savedAt = null] = SAVED_LINE.exec(headOf(bytes)) ?? [];
  const file = new FilePoints(header.points, savedAt);
  read(columns, (values) => {
    const [px = Number.NaN, py = Number.NaN, pz = Number.NaN] = values;
    const bits = isKnown ? (values[3] as number) : Number.NaN;
    const rgb = Number.isNaN(bits) ? NO_COLOURS : bits;
    const ageS = age === undefined ? Number.NaN : (values.at(-1) as number);
    file.add(px, py, pz, (rgb >>> 16) & 255, (rgb >>> 8) & 255, rgb & 255, ageS);
  });
  return file;
}
