/**
 * The remembered world as PCD 0.7 ("The PCD (Point Cloud Data) file format", pointclouds.org), binary or as text: x, y, z in
 * metres (REP-103), `rgb` as 24 bits, and `age`, the seconds since a point was last seen when the file was written. Read
 * back by name; other fields are skipped. The viewpoint is not applied, as other programs do not.
 */
import { packedColour } from '@farpoint/cloud-formats/packed-colour';
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
      ...['# .PCD v0.7 - Point Cloud Data file format', `# ${SAVED} ${savedAt}`, 'VERSION 0.7'],
      ...['FIELDS x y z rgb age', 'SIZE 4 4 4 4 4', 'TYPE F F F U F', 'COUNT 1 1 1 1 1'],
      ...[`WIDTH ${points}`, 'HEIGHT 1', 'VIEWPOINT 0 0 0 1 0 0 0', `POINTS ${points}`, `DATA ${data}\n`],
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

const TYPES = ['F4', 'F8', 'I1', 'I2', 'I4', 'I8', 'U1', 'U2', 'U4', 'U8'] as const;
type PcdType = (typeof TYPES)[number];

/** One of a point's values. */
interface Field {
  readonly type: PcdType;
  /** Bytes from the beginning of the point's, and values before it. */
  readonly at: number;
  readonly column: number;
}

interface Header {
  readonly points: number;
  readonly fields: ReadonlyMap<string, Field>;
  /** Bytes of a point, and its values. */
  readonly stride: number;
  readonly columns: number;
  readonly data: string;
  readonly dataAt: number;
  readonly savedAt: string | null;
}

/** Whether a file looks like PCD. */
export function isPcd(bytes: Uint8Array): boolean {
  return /^(?:#.*\r?\n)*(?:VERSION|FIELDS)\s/.test(headOf(bytes));
}

/** @throws {PointFileError} says what is wrong */
export function readPcd(bytes: Uint8Array): FilePoints {
  const header = readHeader(bytes);
  switch (header.data) {
    case 'ascii':
      return readText(bytes, header);
    case 'binary':
      return readBinary(bytes, header);
    default:
      throw new PointFileError(`the data are ${header.data}; only ascii and binary can be read`);
  }
}

function headOf(bytes: Uint8Array): string {
  return new TextDecoder('latin1').decode(bytes.subarray(0, MAX_HEADER));
}

function readHeader(bytes: Uint8Array): Header {
  const text = headOf(bytes);
  if (!isPcd(bytes)) throw new PointFileError('this is no PCD file');
  const end = /^DATA[ \t]+(\S+)[ \t]*\r?\n/m.exec(text);
  if (end === null) throw new PointFileError(`the header does not end within ${MAX_HEADER} bytes`);
  const values = new Map<string, string[]>();
  let savedAt: string | null = null;
  for (const line of text.slice(0, end.index).split(/\r?\n/)) {
    const [word, ...rest] = line.trim().split(/\s+/) as [string, ...string[]];
    if (word === '#' && rest[0] === SAVED) savedAt = rest[1] ?? null;
    if (!word.startsWith('#')) values.set(word, rest);
  }
  const numberOf = (name: string) => {
    const [value] = values.get(name) ?? [];
    return value === undefined ? null : Number(value);
  };
  const points = numberOf('POINTS') ?? (numberOf('WIDTH') ?? Number.NaN) * (numberOf('HEIGHT') ?? 1);
  if (!(Number.isInteger(points) && points >= 0 && points <= MAX_POINTS))
    throw new PointFileError(`${points} is no number of points from 0 to ${MAX_POINTS}`);
  return {
    ...{ points, savedAt, data: end[1] as string, dataAt: end.index + end[0].length },
    ...readFields(values),
  };
}

function readFields(values: ReadonlyMap<string, string[]>): Pick<Header, 'fields' | 'stride' | 'columns'> {
  const names = values.get('FIELDS') ?? [];
  const [sizes, types] = [values.get('SIZE') ?? [], values.get('TYPE') ?? []];
  const counts = values.get('COUNT') ?? names.map(() => '1');
  if ([sizes, types, counts].some(({ length }) => length !== names.length))
    throw new PointFileError('SIZE, TYPE and COUNT do not fit FIELDS');
  const fields = new Map<string, Field>();
  let [stride, columns] = [0, 0];
  for (const [i, name] of names.entries()) {
    const wanted = `${types[i]}${sizes[i]}`;
    const type = TYPES.find((each) => each === wanted);
    const count = Number(counts[i]);
    if (type === undefined) throw new PointFileError(`${name} has the type ${types[i]} of ${sizes[i]} bytes`);
    if (!(Number.isInteger(count) && count >= 1 && count <= MAX_HEADER))
      throw new PointFileError(`${counts[i]} is no count of ${name}`);
    if (!fields.has(name)) fields.set(name, { type, at: stride, column: columns });
    stride += Number(sizes[i]) * count;
    columns += count;
  }
  for (const name of ['x', 'y', 'z']) {
    if (!fields.has(name)) throw new PointFileError(`a point has no ${name}`);
  }
  return { fields, stride, columns };
}

/** What is read of each point. */
function knownFields({ fields }: Header) {
  const colour = fields.get('rgb') ?? fields.get('rgba');
  const [x, y, z] = ['x', 'y', 'z'].map((name) => fields.get(name)) as [Field, Field, Field];
  return { x, y, z, age: fields.get('age'), colour: colour?.type.endsWith('4') ? colour : undefined };
}

function readBinary(bytes: Uint8Array, header: Header): FilePoints {
  const { points, stride, dataAt, savedAt } = header;
  if (bytes.length - dataAt < points * stride)
    throw new PointFileError(`the file ends before its ${points} points do`);
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const { x, y, z, age, colour } = knownFields(header);
  const file = new FilePoints(points, savedAt);
  for (let point = 0; point < points; point++) {
    const from = dataAt + point * stride;
    addPoint(
      file,
      ...([numberAt(view, from, x), numberAt(view, from, y), numberAt(view, from, z)] as const),
      // A float of these bits, too, stands for the bits.
      colour === undefined ? NO_COLOURS : view.getUint32(from + colour.at, true),
      age === undefined ? Number.NaN : numberAt(view, from, age),
    );
  }
  return file;
}

function readText(bytes: Uint8Array, header: Header): FilePoints {
  const { points, columns, dataAt, savedAt } = header;
  // A digit, and a space or the end of the line.
  if (bytes.length - dataAt < points * columns * 2 - 1)
    throw new PointFileError(`the file ends before its ${points} points do`);
  const { x, y, z, age, colour } = knownFields(header);
  const file = new FilePoints(points, savedAt);
  const decoder = new TextDecoder('latin1');
  let at = dataAt;
  for (let point = 0; point < points; ) {
    if (at >= bytes.length) throw new PointFileError(`the file ends after ${point} of its ${points} points`);
    const found = bytes.indexOf(10, at);
    const end = found < 0 ? bytes.length : found;
    const line = decoder.decode(bytes.subarray(at, end)).trim();
    at = end + 1;
    if (line === '') continue;
    const words = line.split(/\s+/);
    if (words.length < columns)
      throw new PointFileError(`point ${point + 1} has ${words.length} of ${columns} values`);
    const wordOf = ({ column }: Field) => Number(words[column]);
    addPoint(
      file,
      ...([wordOf(x), wordOf(y), wordOf(z)] as const),
      (colour === undefined ? null : packedColour(wordOf(colour), colour.type === 'F4')) ?? NO_COLOURS,
      age === undefined ? Number.NaN : wordOf(age),
    );
    point++;
  }
  return file;
}

function addPoint(file: FilePoints, x: number, y: number, z: number, rgb: number, ageS: number): void {
  file.add(x, y, z, (rgb >> 16) & 255, (rgb >> 8) & 255, rgb & 255, ageS);
}

function numberAt(view: DataView, from: number, { type, at }: Field): number {
  const place = from + at;
  switch (type) {
    case 'F4':
      return view.getFloat32(place, true);
    case 'F8':
      return view.getFloat64(place, true);
    case 'I1':
      return view.getInt8(place);
    case 'I2':
      return view.getInt16(place, true);
    case 'I4':
      return view.getInt32(place, true);
    case 'I8':
      return Number(view.getBigInt64(place, true));
    case 'U1':
      return view.getUint8(place);
    case 'U2':
      return view.getUint16(place, true);
    case 'U4':
      return view.getUint32(place, true);
    case 'U8':
      return Number(view.getBigUint64(place, true));
  }
}
