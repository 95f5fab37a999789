/**
 * The remembered world as PLY (binary, little endian; "The PLY Polygon File Format", Turk 1994), which point cloud tools
 * read: one vertex per surfel with x, y, z in metres (REP-103), red, green, blue, and `age`, the seconds since it was last
 * seen when the file was written. Read back by name; other properties are skipped.
 */
import { CHUNK_M, CHUNK_STEPS, PAGE_SURFELS, TICKS_PER_S } from './memory-layout.ts';
import type { SurfelStore } from './surfel-store.ts';

/** Bytes of a vertex that is written. */
const VERTEX_BYTES = 3 * 4 + 3 + 4;
/** No header of a point cloud is longer. */
const MAX_HEADER = 4096;
/** Files with more are refused, before anything is allocated. */
const MAX_VERTICES = 1 << 24;
const SAVED = 'saved';

/** Why a file is refused. */
export class PlyError extends Error {
  override readonly name = 'PlyError';
}

/** What was read. */
export interface PlyPoints {
  count: number;
  /** x, y, z of each, metres. */
  places: Float32Array;
  /** 5-6-5 bits, R highest. */
  colours: Uint16Array;
  /** Seconds since it was last seen, when the file was written; 0 where the file does not say. */
  agesS: Float32Array;
  /** When it was written, ISO 8601; `null` if the file does not say. */
  savedAt: string | null;
}

/** @param ticks now, on the memory's clock @param savedAt now, ISO 8601 */
export function writePly(store: SurfelStore, ticks: number, savedAt: string): ArrayBuffer {
  let vertices = 0;
  for (let surfel = 0; surfel < store.sightings.length; surfel++) vertices += Number(isKept(store, surfel));
  const header = new TextEncoder().encode(
    [
      ...['ply', 'format binary_little_endian 1.0', `comment ${SAVED} ${savedAt}`],
      ...[`element vertex ${vertices}`, 'property float x', 'property float y', 'property float z'],
      ...['property uchar red', 'property uchar green', 'property uchar blue', 'property float age'],
      'end_header\n',
    ].join('\n'),
  );
  const buffer = new ArrayBuffer(header.length + vertices * VERTEX_BYTES);
  new Uint8Array(buffer).set(header);
  const view = new DataView(buffer);
  let at = header.length;
  for (let surfel = 0; surfel < store.sightings.length; surfel++) {
    if (!isKept(store, surfel)) continue;
    const chunk = store.pageChunks[Math.floor(surfel / PAGE_SURFELS)] as number;
    const place = store.places[surfel] as number;
    const metres = (corner: number, steps: number) => (corner + (steps + 0.5) / CHUNK_STEPS) * CHUNK_M;
    view.setFloat32(at, metres(store.chunkX[chunk] as number, place & 1023), true);
    view.setFloat32(at + 4, metres(store.chunkY[chunk] as number, (place >>> 10) & 1023), true);
    view.setFloat32(at + 8, metres(store.chunkZ[chunk] as number, place >>> 20), true);
    const colour = store.colours[surfel] as number;
    view.setUint8(at + 12, Math.round(((colour >> 11) * 255) / 31));
    view.setUint8(at + 13, Math.round((((colour >> 5) & 63) * 255) / 63));
    view.setUint8(at + 14, Math.round(((colour & 31) * 255) / 31));
    view.setFloat32(at + 15, Math.max(ticks - (store.seen[surfel] as number), 0) / TICKS_PER_S, true);
    at += VERTEX_BYTES;
  }
  return buffer;
}

function isKept(store: SurfelStore, surfel: number): boolean {
  const page = Math.floor(surfel / PAGE_SURFELS);
  const inUse =
    (store.pageChunks[page] as number) >= 0 && surfel % PAGE_SURFELS < (store.pageCounts[page] as number);
  return inUse && (store.sightings[surfel] as number) > 1;
}

const SIZES = {
  ...{ char: 1, uchar: 1, int8: 1, uint8: 1, short: 2, ushort: 2, int16: 2, uint16: 2 },
  ...{ int: 4, uint: 4, int32: 4, uint32: 4, float: 4, float32: 4, double: 8, float64: 8 },
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

/** @throws {PlyError} says what is wrong */
export function readPly(bytes: Uint8Array): PlyPoints {
  const { vertices, properties, stride, savedAt, dataAt } = readHeader(bytes);
  if (bytes.length - dataAt < vertices * stride)
    throw new PlyError(`the file ends before its ${vertices} vertices do`);
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const position = ['x', 'y', 'z'].map((name) => properties.get(name));
  const rgb = ['red', 'green', 'blue'].map((name) => properties.get(name));
  const age = properties.get('age');
  const places = new Float32Array(vertices * 3);
  const colours = new Uint16Array(vertices);
  const agesS = new Float32Array(vertices);
  let count = 0;
  for (let vertex = 0; vertex < vertices; vertex++) {
    const from = dataAt + vertex * stride;
    const [x, y, z] = position.map((property) => numberAt(view, from, property)) as [number, number, number];
    if (!Number.isFinite(x + y + z)) continue;
    places.set([x, y, z], count * 3);
    const [red, green, blue] = rgb.map((property) =>
      property === undefined ? 160 : byteAt(view, from, property),
    );
    colours[count] =
      (((red as number) >> 3) << 11) | (((green as number) >> 2) << 5) | ((blue as number) >> 3);
    const seconds = age === undefined ? 0 : numberAt(view, from, age);
    agesS[count] = Number.isFinite(seconds) ? Math.max(seconds, 0) : 0;
    count++;
  }
  return { count, places, colours, agesS, savedAt };
}

function readHeader(bytes: Uint8Array): Header {
  const text = new TextDecoder('latin1').decode(bytes.subarray(0, MAX_HEADER));
  const end = /^end_header\r?\n/m.exec(text);
  if (!/^ply\r?\n/.test(text)) throw new PlyError('this is no PLY file');
  if (end === null) throw new PlyError(`the header does not end within ${MAX_HEADER} bytes`);
  const properties = new Map<string, Property>();
  let [vertices, stride, savedAt, inVertex]: [number, number, string | null, boolean] = [-1, 0, null, false];
  for (const line of text.slice(0, end.index).split(/\r?\n/).slice(1)) {
    const [word, ...rest] = line.trim().split(/\s+/);
    if (word === 'format' && rest[0] !== 'binary_little_endian')
      throw new PlyError(`the format is ${rest[0]}; only binary_little_endian can be read`);
    if (word === 'comment' && rest[0] === SAVED) savedAt = rest[1] ?? null;
    if (word === 'element') {
      // Vertices must come first: what lies before them could not be skipped.
      if (vertices < 0 && rest[0] !== 'vertex') throw new PlyError(`${rest[0]} comes before the vertices`);
      inVertex = rest[0] === 'vertex';
      if (inVertex) vertices = Number(rest[1]);
    }
    if (word !== 'property' || !inVertex) continue;
    const [type, name] = rest;
    if (type === undefined || name === undefined || !(type in SIZES))
      throw new PlyError(`a vertex has a property of the type ${type}`);
    properties.set(name, { type: type as PlyType, at: stride });
    stride += SIZES[type as PlyType];
  }
  if (!(Number.isInteger(vertices) && vertices >= 0 && vertices <= MAX_VERTICES))
    throw new PlyError(`${vertices} is no number of vertices from 0 to ${MAX_VERTICES}`);
  for (const name of ['x', 'y', 'z']) {
    if (!properties.has(name)) throw new PlyError(`a vertex has no ${name}`);
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
function byteAt(view: DataView, from: number, property: Property): number {
  const value = numberAt(view, from, property);
  const byte = FRACTIONS.has(property.type) ? value * 255 : value;
  return Number.isFinite(byte) ? Math.min(Math.max(Math.round(byte), 0), 255) : 0;
}
