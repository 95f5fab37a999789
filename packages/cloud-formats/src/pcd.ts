/** Decodes PCD files to frames: positions and colours, from fields in any order, type and size. */
import { intensityColour, intensityScale } from './intensity.ts';
import { PcdError, type PcdHeader, parsePcdHeader } from './pcd-header.ts';
import { type PcdColumn, pcdPointReader } from './pcd-points.ts';

export { PcdError, type PcdErrorCode, type PcdHeader, parsePcdHeader } from './pcd-header.ts';

export interface PcdCloud {
  header: PcdHeader;
  /** 4 words per point: x, y, z as floats in the file's own axes, metres, and the bytes R, G, B, 255. */
  points: Float32Array;
}

/** Light grey, for a cloud with neither colour nor intensity. */
const NO_COLOUR = 0xffc8c8c8;
/** Values of a point before those of its colour. */
const AXES = ['x', 'y', 'z'];

/** @throws {PcdError} naming the line, the field or the byte */
export function decodePcd(file: Uint8Array): PcdCloud {
  const header = parsePcdHeader(file);
  const read = pcdPointReader(file, header);
  const axes = AXES.map((name): PcdColumn => {
    const field = header.fields.find((each) => each.name === name);
    if (field === undefined) throw new PcdError('unsupported', `field ${name}`, 'the file has none');
    return { field };
  });
  const { kind, columns } = colouring(header);
  const points = new Float32Array(header.points * 4);
  const words = new Uint32Array(points.buffer);
  const intensities = new Float64Array(kind === 'intensity' ? header.points : 0);
  read([...axes, ...columns], (values, i) => {
    const [x, y, z, first = Number.NaN, green = 0, blue = 0] = values;
    points[i * 4] = x as number;
    points[i * 4 + 1] = y as number;
    points[i * 4 + 2] = z as number;
    if (kind === 'packed') words[i * 4 + 3] = Number.isNaN(first) ? NO_COLOUR : rgbaOf(first);
    else if (kind === 'channels')
      words[i * 4 + 3] = (byte(first) | (byte(green) << 8) | (byte(blue) << 16) | 0xff00_0000) >>> 0;
    else if (kind === 'intensity') intensities[i] = first;
    else words[i * 4 + 3] = NO_COLOUR;
  });
  if (kind === 'intensity') {
    // How bright is bright is known when all have been read.
    const scale = intensityScale((i) => intensities[i] as number, header.points);
    for (let i = 0; i < header.points; i++)
      words[i * 4 + 3] = intensityColour((intensities[i] as number) * scale);
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
  const read = pcdPointReader(file, header);
  const intensities = new Float32Array(header.points);
  read([{ field }], ([intensity], i) => {
    intensities[i] = intensity as number;
  });
  return intensities;
}

interface Colouring {
  kind: 'packed' | 'channels' | 'intensity' | 'none';
  columns: PcdColumn[];
}

/** Where the colours are. @throws {PcdError} */
function colouring({ fields }: PcdHeader): Colouring {
  const find = (name: string) => fields.find((field) => field.name === name);
  const packed = find('rgb') ?? find('rgba');
  if (packed !== undefined) {
    if (packed.size !== 4) {
      throw new PcdError('unsupported', `field ${packed.name}`, `${packed.size} bytes, 4 needed`);
    }
    return { kind: 'packed', columns: [{ field: packed, isColour: true }] };
  }
  const [r, g, b] = [find('r'), find('g'), find('b')];
  if (r !== undefined && g !== undefined && b !== undefined)
    return { kind: 'channels', columns: [{ field: r }, { field: g }, { field: b }] };
  const intensity = find('intensity') ?? find('i');
  return intensity === undefined
    ? { kind: 'none', columns: [] }
    : { kind: 'intensity', columns: [{ field: intensity }] };
}

/** R in the lowest byte, then G, B and 255. */
function rgbaOf(argb: number): number {
  return (((argb >>> 16) & 0xff) | (argb & 0xff00) | ((argb & 0xff) << 16) | 0xff00_0000) >>> 0;
}

function byte(value: number): number {
  return Math.min(Math.max(Math.round(value), 0), 255) || 0;
}
