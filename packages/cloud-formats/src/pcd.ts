/** Decodes PCD files to frames: positions and colours, from fields in any order, type and size. */
import { intensityColour, intensityScale } from './intensity.ts';
import { decompressLzf, LzfError } from './lzf.ts';
import { packedColour } from './packed-colour.ts';
import { PcdError, type PcdField, type PcdHeader, parsePcdHeader } from './pcd-header.ts';

export { PcdError, type PcdErrorCode, type PcdHeader, parsePcdHeader } from './pcd-header.ts';

export interface PcdCloud {
  header: PcdHeader;
  /** 4 words per point: x, y, z as floats in the file's own axes, metres, and the bytes R, G, B, 255. */
  points: Float32Array;
}

/** Light grey, for a cloud with neither colour nor intensity. */
const NO_COLOUR = 0xffc8c8c8;

/** LZF makes at most 264 bytes from 3. */
const MAX_LZF_RATIO = 88;

/** Reads element 0 of a field of point `index`. */
type Reader = (index: number) => number;

/** @throws {PcdError} naming the line, the field or the byte */
export function decodePcd(file: Uint8Array): PcdCloud {
  const header = parsePcdHeader(file);
  const reader = header.data === 'ascii' ? asciiReader(file, header) : binaryReader(file, header);
  const find = (name: string) => header.fields.find((field) => field.name === name);
  const coordinate = (name: string): Reader => {
    const field = find(name);
    if (field === undefined) throw new PcdError('unsupported', `field ${name}`, 'the file has none');
    return reader(field, false);
  };
  const axes = [coordinate('x'), coordinate('y'), coordinate('z')] as const;
  const points = new Float32Array(header.points * 4);
  const words = new Uint32Array(points.buffer);
  const colour = colourOf(header, find, reader);
  for (let i = 0; i < header.points; i++) {
    points[i * 4] = axes[0](i);
    points[i * 4 + 1] = axes[1](i);
    points[i * 4 + 2] = axes[2](i);
    words[i * 4 + 3] = colour(i);
  }
  return { header, points };
}

/**
 * The unscaled intensities of a file whose points have no colour; null if there are none.
 *
 * @throws {PcdError}
 */
export function pcdIntensity(file: Uint8Array): Float32Array | null {
  const header = parsePcdHeader(file);
  const names = new Map(header.fields.map((field) => [field.name, field]));
  const field = names.get('intensity') ?? names.get('i');
  if (field === undefined || ['rgb', 'rgba', 'r'].some((name) => names.has(name))) return null;
  const reader = header.data === 'ascii' ? asciiReader(file, header) : binaryReader(file, header);
  return Float32Array.from({ length: header.points }, (_, i) => i).map(reader(field, false));
}

/** @returns R in the lowest byte, then G, B and 255 */
function colourOf(
  header: PcdHeader,
  find: (name: string) => PcdField | undefined,
  reader: (field: PcdField, asBits: boolean) => Reader,
): Reader {
  const packed = find('rgb') ?? find('rgba');
  if (packed !== undefined) {
    if (packed.size !== 4) {
      throw new PcdError('unsupported', `field ${packed.name}`, `${packed.size} bytes, 4 needed`);
    }
    const bits = reader(packed, true);
    return (i) => {
      const argb = bits(i);
      return (((argb >>> 16) & 0xff) | (argb & 0xff00) | ((argb & 0xff) << 16) | 0xff00_0000) >>> 0;
    };
  }
  const [r, g, b] = [find('r'), find('g'), find('b')];
  if (r !== undefined && g !== undefined && b !== undefined) {
    const channels = [reader(r, false), reader(g, false), reader(b, false)] as const;
    const byte = (value: number) => Math.min(Math.max(Math.round(value), 0), 255) || 0;
    return (i) =>
      (byte(channels[0](i)) | (byte(channels[1](i)) << 8) | (byte(channels[2](i)) << 16) | 0xff00_0000) >>> 0;
  }
  const intensity = find('intensity') ?? find('i');
  if (intensity === undefined) return () => NO_COLOUR;
  const value = reader(intensity, false);
  const scale = intensityScale(value, header.points);
  return (i) => intensityColour(value(i) * scale);
}

/** Each field is at `start(field) + index × step(field)`. */
function binaryReader(file: Uint8Array, header: PcdHeader): (field: PcdField, asBits: boolean) => Reader {
  const { points, pointBytes, dataOffset } = header;
  const bytes = points * pointBytes;
  if (header.data === 'binary') {
    if (file.byteLength < dataOffset + bytes) {
      throw new PcdError(
        'truncated',
        `byte ${file.byteLength}`,
        `${points} points need ${bytes} bytes of data`,
      );
    }
    const view = new DataView(file.buffer, file.byteOffset + dataOffset, bytes);
    return (field, asBits) => elementReader(view, field, field.offset, pointBytes, asBits);
  }
  const data = decompress(file, dataOffset, bytes);
  const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
  // Compressed files store one field of all points after the other.
  return (field, asBits) =>
    elementReader(view, field, field.offset * points, field.size * field.count, asBits);
}

function decompress(file: Uint8Array, offset: number, bytes: number): Uint8Array {
  if (file.byteLength < offset + 8)
    throw new PcdError('truncated', `byte ${file.byteLength}`, 'no compressed sizes');
  const view = new DataView(file.buffer, file.byteOffset + offset);
  const compressed = view.getUint32(0, true);
  const uncompressed = view.getUint32(4, true);
  if (uncompressed !== bytes) {
    throw new PcdError('bad-data', `byte ${offset + 4}`, `${uncompressed} bytes announced, ${bytes} needed`);
  }
  if (bytes > compressed * MAX_LZF_RATIO) {
    throw new PcdError('bad-data', `byte ${offset}`, `${compressed} bytes cannot hold ${bytes}`);
  }
  if (file.byteLength < offset + 8 + compressed) {
    throw new PcdError('truncated', `byte ${file.byteLength}`, `${compressed} compressed bytes announced`);
  }
  try {
    return decompressLzf(file.subarray(offset + 8, offset + 8 + compressed), bytes);
  } catch (error) {
    if (!(error instanceof LzfError)) throw error;
    throw new PcdError('bad-data', `byte ${offset + 8 + error.offset}`, error.message);
  }
}

function elementReader(
  view: DataView,
  field: PcdField,
  start: number,
  step: number,
  asBits: boolean,
): Reader {
  if (asBits) return (i) => view.getUint32(start + i * step, true);
  switch (`${field.type}${field.size}`) {
    case 'F4':
      return (i) => view.getFloat32(start + i * step, true);
    case 'F8':
      return (i) => view.getFloat64(start + i * step, true);
    case 'I1':
      return (i) => view.getInt8(start + i * step);
    case 'I2':
      return (i) => view.getInt16(start + i * step, true);
    case 'I4':
      return (i) => view.getInt32(start + i * step, true);
    case 'U1':
      return (i) => view.getUint8(start + i * step);
    case 'U2':
      return (i) => view.getUint16(start + i * step, true);
    case 'U4':
      return (i) => view.getUint32(start + i * step, true);
    case 'I8':
      return (i) => Number(view.getBigInt64(start + i * step, true));
    default:
      return (i) => Number(view.getBigUint64(start + i * step, true));
  }
}

function asciiReader(file: Uint8Array, header: PcdHeader): (field: PcdField, asBits: boolean) => Reader {
  const { points, fields, dataOffset, dataLine } = header;
  const columns = fields.reduce((sum, field) => sum + field.count, 0);
  // A value takes at least two bytes: allocates no memory for points that cannot exist.
  if (points * columns > file.byteLength) {
    throw new PcdError(
      'truncated',
      `byte ${file.byteLength}`,
      `${points} points of ${columns} values cannot be here`,
    );
  }
  const values = new Float64Array(points * columns);
  const lines = new TextDecoder('latin1').decode(file.subarray(dataOffset)).split('\n');
  let point = 0;
  lines.forEach((line, index) => {
    const words = line.trim().split(/\s+/);
    if (words[0] === '') return;
    const where = `line ${dataLine + index}`;
    if (point >= points) throw new PcdError('bad-data', where, `more than ${points} points`);
    if (words.length !== columns)
      throw new PcdError('bad-data', where, `${words.length} values, ${columns} needed`);
    words.forEach((word, column) => {
      const value = /^[+-]?nan$/i.test(word)
        ? Number.NaN
        : Number(word.replace(/^([+-]?)inf$/i, '$1Infinity'));
      if (Number.isNaN(value) && !/nan$/i.test(word)) {
        throw new PcdError('bad-data', where, `'${word.slice(0, 40)}' is not a number`);
      }
      values[point * columns + column] = value;
    });
    point++;
  });
  if (point < points)
    throw new PcdError('truncated', `line ${dataLine + lines.length - 1}`, `${point} of ${points} points`);
  return (field, asBits) => {
    let column = 0;
    for (const other of fields) {
      if (other === field) break;
      column += other.count;
    }
    if (!asBits) return (i) => values[i * columns + column] as number;
    return (i) => {
      const value = values[i * columns + column] as number;
      return packedColour(value, field.type === 'F') ?? NO_COLOUR;
    };
  };
}
