/**
 * The remembered world as PLY (binary, little endian; "The PLY Polygon File Format", Turk 1994), which point cloud tools
 * read: one vertex per surfel with x, y, z in metres (REP-103), red, green, blue, and `age`, the seconds since it was last
 * seen when the file was written. Read back by name; other properties are skipped.
 */
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

/** Bytes of a vertex that is written. */
const VERTEX_BYTES = 3 * 4 + 3 + 4;

/** @param ticks now, on the memory's clock @param savedAt now, ISO 8601 */
export function writePly(store: SurfelStore, ticks: number, savedAt: string): ArrayBuffer {
  const vertices = keptPoints(store);
  const header = new TextEncoder().encode(
    [
      'ply',
      'format binary_little_endian 1.0',
      `comment ${SAVED} ${savedAt}`,
      `element vertex ${vertices}`,
      'property float x',
      'property float y',
      'property float z',
      'property uchar red',
      'property uchar green',
      'property uchar blue',
      'property float age',
      'end_header\n',
    ].join('\n'),
  );
  const buffer = new ArrayBuffer(header.length + vertices * VERTEX_BYTES);
  new Uint8Array(buffer).set(header);
  const view = new DataView(buffer);
  let at = header.length;
  eachKeptPoint(store, (x, y, z, rgb, seen) => {
    view.setFloat32(at, x, true);
    view.setFloat32(at + 4, y, true);
    view.setFloat32(at + 8, z, true);
    view.setUint8(at + 12, rgb >> 16);
    view.setUint8(at + 13, (rgb >> 8) & 255);
    view.setUint8(at + 14, rgb & 255);
    view.setFloat32(at + 15, Math.max(ticks - seen, 0) / TICKS_PER_S, true);
    at += VERTEX_BYTES;
  });
  return buffer;
}

const SIZES = {
  char: 1,
  uchar: 1,
  int8: 1,
  uint8: 1,
  short: 2,
  ushort: 2,
  int16: 2,
  uint16: 2,
  int: 4,
  uint: 4,
  int32: 4,
  uint32: 4,
  float: 4,
  float32: 4,
  double: 8,
  float64: 8,
} as const;
type PlyType = keyof typeof SIZES;

interface Property {
  type: PlyType;
  at: number;
}

interface Header {
  vertices: number;
  properties: Map<string, Property>;
  stride: number;
  savedAt: string | null;
  dataAt: number;
}

/** @throws {PointFileError} says what is wrong */
export function readPly(bytes: Uint8Array): FilePoints {
  const { vertices, properties, stride, savedAt, dataAt } = readHeader(bytes);
  if (bytes.length - dataAt < vertices * stride)
    throw new PointFileError(`the file ends before its ${vertices} vertices do`);
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const [x, y, z, red, green, blue, age] = ['x', 'y', 'z', 'red', 'green', 'blue', 'age'].map((name) =>
    properties.get(name),
  );
  const file = new FilePoints(vertices, savedAt);
  for (let vertex = 0; vertex < vertices; vertex++) {
    const from = dataAt + vertex * stride;
    file.add(
      numberAt(view, from, x),
      numberAt(view, from, y),
      numberAt(view, from, z),
      byteAt(view, from, red),
      byteAt(view, from, green),
      byteAt(view, from, blue),
      numberAt(view, from, age),
    );
  }
  return file;
}

function readHeader(bytes: Uint8Array): Header {
  const text = new TextDecoder('latin1').decode(bytes.subarray(0, MAX_HEADER));
  const end = /^end_header\r?\n/m.exec(text);
  if (!/^ply\r?\n/.test(text)) throw new PointFileError('this is no PLY file');
  if (end === null) throw new PointFileError(`the header does not end within ${MAX_HEADER} bytes`);
  const properties = new Map<string, Property>();
  let [vertices, stride, savedAt, inVertex]: [number, number, string | null, boolean] = [-1, 0, null, false];
  for (const line of text.slice(0, end.index).split(/\r?\n/).slice(1)) {
    const [word, ...rest] = line.trim().split(/\s+/);
    if (word === 'format' && rest[0] !== 'binary_little_endian')
      throw new PointFileError(`the format is ${rest[0]}; only binary_little_endian can be read`);
    if (word === 'comment' && rest[0] === SAVED) savedAt = rest[1] ?? null;
    if (word === 'element') {
      // Vertices must come first: what lies before them could not be skipped.
      if (vertices < 0 && rest[0] !== 'vertex')
        throw new PointFileError(`${rest[0]} comes before the vertices`);
      inVertex = rest[0] === 'vertex';
      if (inVertex) vertices = Number(rest[1]);
    }
    if (word !== 'property' || !inVertex) continue;
    const [type, name] = rest;
    if (type === undefined || name === undefined || !(type in SIZES))
      throw new PointFileError(`a vertex has a property of the type ${type}`);
    properties.set(name, { type: type as PlyType, at: stride });
    stride += SIZES[type as PlyType];
  }
  if (!(Number.isInteger(vertices) && vertices >= 0 && vertices <= MAX_POINTS))
    throw new PointFileError(`${vertices} is no number of vertices from 0 to ${MAX_POINTS}`);
  for (const name of ['x', 'y', 'z']) {
    if (!properties.has(name)) throw new PointFileError(`a vertex has no ${name}`);
  }
  return { vertices, properties, stride, savedAt, dataAt: end.index + end[0].length };
}

function numberAt(view: DataView, from: number, property: Property | undefined): number {
  if (property === undefined) return Number.NaN;
  const at = from + property.at;
  switch (property.type) {
    case 'float':
    case 'float32':
      return view.getFloat32(at, true);
    case 'double':
    case 'float64':
      return view.getFloat64(at, true);
    case 'char':
    case 'int8':
      return view.getInt8(at);
    case 'uchar':
    case 'uint8':
      return view.getUint8(at);
    case 'short':
    case 'int16':
      return view.getInt16(at, true);
    case 'ushort':
    case 'uint16':
      return view.getUint16(at, true);
    case 'int':
    case 'int32':
      return view.getInt32(at, true);
    default:
      return view.getUint32(at, true);
  }
}

const FRACTIONS: ReadonlySet<PlyType> = new Set(['float', 'float32', 'double', 'float64']);

/** A colour's component, 0–255; fractions are shares of 1. */
function byteAt(view: DataView, from: number, property: Property | undefined): number {
  if (property === undefined) return NO_COLOUR;
  const value = numberAt(view, from, property);
  const byte = FRACTIONS.has(property.type) ? value * 255 : value;
  return Number.isFinite(byte) ? Math.min(Math.max(Math.round(byte), 0), 255) : 0;
}
