/** Reads values of the points of a PCD file, whichever way they are written. */
import { decompressLzf, LzfError } from './lzf.ts';
import { packedColour } from './packed-colour.ts';
import { PcdError, type PcdField, type PcdHeader } from './pcd-header.ts';

/** A value that each point has: element 0 of a field. */
export interface PcdColumn {
  field: PcdField;
  /** A colour, whose bits count: 0xAARRGGBB, or NaN if it is none. */
  isColour?: boolean;
}

/** Gets the values of a point, in the order of the columns; the same array for every point. */
export type PcdSink = (values: Float64Array, point: number) => void;
type Read = (columns: readonly PcdColumn[], take: PcdSink) => void;

/**
 * Checks that the file is long enough for its points, so that nothing is allocated for points that cannot exist. Text is
 * read line by line.
 *
 * @returns reads all points, in order; throws a {@link PcdError} for a line that is wrong
 * @throws {PcdError} naming the line or the byte
 */
export function pcdPointReader(file: Uint8Array, header: PcdHeader): Read {
  return header.data === 'ascii' ? textReader(file, header) : binaryReader(file, header);
}

/** Each field is at `start(field) + point × step(field)`. */
function binaryReader(file: Uint8Array, header: PcdHeader): Read {
  const { points, pointBytes, dataOffset } = header;
  const bytes = points * pointBytes;
  const isPlain = header.data === 'binary';
  if (isPlain && file.byteLength < dataOffset + bytes)
    throw new PcdError(
      'truncated',
      `byte ${file.byteLength}`,
      `${points} points need ${bytes} bytes of data`,
    );
  const data = isPlain ? file.subarray(dataOffset, dataOffset + bytes) : unpacked(file, dataOffset, bytes);
  const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
  return (columns, take) => {
    const elements = columns.map(({ field, isColour }) => ({
      // Compressed files store one field of all points after the other.
      start: isPlain ? field.offset : field.offset * points,
      step: isPlain ? pointBytes : field.size * field.count,
      valueAt: isColour === true ? (at: number) => view.getUint32(at, true) : numberReader(view, field),
    }));
    const values = new Float64Array(columns.length);
    for (let point = 0; point < points; point++) {
      for (let i = 0; i < elements.length; i++) {
        const { start, step, valueAt } = elements[i] as (typeof elements)[number];
        values[i] = valueAt(start + point * step);
      }
      take(values, point);
    }
  };
}

/** LZF makes at most 264 bytes from 3. */
const MAX_LZF_RATIO = 88;

function unpacked(file: Uint8Array, offset: number, bytes: number): Uint8Array {
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

function numberReader(view: DataView, { type, size }: PcdField): (at: number) => number {
  switch (`${type}${size}`) {
    case 'F4':
      return (at) => view.getFloat32(at, true);
    case 'F8':
      return (at) => view.getFloat64(at, true);
    case 'I1':
      return (at) => view.getInt8(at);
    case 'I2':
      return (at) => view.getInt16(at, true);
    case 'I4':
      return (at) => view.getInt32(at, true);
    case 'U1':
      return (at) => view.getUint8(at);
    case 'U2':
      return (at) => view.getUint16(at, true);
    case 'U4':
      return (at) => view.getUint32(at, true);
    case 'I8':
      return (at) => Number(view.getBigInt64(at, true));
    default:
      return (at) => Number(view.getBigUint64(at, true));
  }
}

function textReader(file: Uint8Array, { points, fields, dataOffset, dataLine }: PcdHeader): Read {
  const width = fields.reduce((sum, { count }) => sum + count, 0);
  // A value takes at least a byte: allocates no memory for points that cannot exist.
  if (points * width > file.byteLength)
    throw new PcdError(
      'truncated',
      `byte ${file.byteLength}`,
      `${points} points of ${width} values cannot be here`,
    );
  return (columns, take) => {
    const elements = columns.map(({ field, isColour }) => ({
      column: fields.slice(0, fields.indexOf(field)).reduce((sum, { count }) => sum + count, 0),
      read: isColour === true ? (value: number) => packedColour(value, field.type === 'F') : null,
    }));
    const values = new Float64Array(columns.length);
    const decoder = new TextDecoder('latin1');
    let [at, line, point] = [dataOffset, dataLine, 0];
    for (; at < file.byteLength; line++) {
      const found = file.indexOf(10, at);
      const end = found < 0 ? file.byteLength : found;
      const text = decoder.decode(file.subarray(at, end)).trim();
      at = end + 1;
      if (text === '') continue;
      const words = text.split(/\s+/);
      const where = `line ${line}`;
      if (point >= points) throw new PcdError('bad-data', where, `more than ${points} points`);
      if (words.length !== width)
        throw new PcdError('bad-data', where, `${words.length} values, ${width} needed`);
      for (const word of words) numberOf(word, where);
      for (const [i, { column, read }] of elements.entries()) {
        const value = numberOf(words[column] as string, where);
        values[i] = read === null ? value : (read(value) ?? Number.NaN);
      }
      take(values, point++);
    }
    if (point < points) throw new PcdError('truncated', `line ${line}`, `${point} of ${points} points`);
  };
}

function numberOf(word: string, where: string): number {
  const value = Number(word);
  if (!Number.isNaN(value)) return value;
  if (/^[+-]?nan$/i.test(word)) return Number.NaN;
  const [, sign] = /^([+-]?)inf$/i.exec(word) ?? [];
  if (sign !== undefined) return sign === '-' ? Number.NEGATIVE_INFINITY : Number.POSITIVE_INFINITY;
  throw new PcdError('bad-data', where, `'${word.slice(0, 40)}' is not a number`);
}
