/** The text header of a PCD file (Point Cloud Library, version 0.7). */
import { MAX_POINTS_PER_FRAME, type Pose } from '@farpoint/protocol';

export type PcdErrorCode =
  | 'not-pcd' // no PCD header
  | 'bad-header' // a header line is missing, duplicated or contradicts another
  | 'unsupported' // valid, but not supported
  | 'too-large' // more points than a frame may have
  | 'truncated' // ends before all its points
  | 'bad-data'; // a value or the compressed data is unreadable

/** Thrown for every unreadable PCD file. */
export class PcdError extends Error {
  override readonly name = 'PcdError';
  readonly code: PcdErrorCode;
  /** For example `line 7`, `field rgb`, `byte 1024`. */
  readonly where: string;

  constructor(code: PcdErrorCode, where: string, detail: string) {
    super(`PCD, ${where}: ${detail}`);
    this.code = code;
    this.where = where;
  }
}

export interface PcdField {
  name: string;
  /** Bytes of one element: 1, 2, 4 or 8. */
  size: number;
  type: 'F' | 'I' | 'U';
  /** Number of elements. */
  count: number;
  /** Byte offset within one point. */
  offset: number;
}

export interface PcdHeader {
  fields: PcdField[];
  width: number;
  /** 1 for a cloud without a grid. */
  height: number;
  points: number;
  /** Bytes of one point. */
  pointBytes: number;
  /** The sensor's pose in a world whose axes the format does not define; identity if the file states none. */
  viewpoint: Pose;
  data: 'ascii' | 'binary' | 'binary_compressed';
  /** Byte at which the points begin. */
  dataOffset: number;
  /** Number of the first line after the header, counted from 1. */
  dataLine: number;
}

const KEYWORDS = [
  'VERSION',
  'FIELDS',
  'SIZE',
  'TYPE',
  'COUNT',
  'WIDTH',
  'HEIGHT',
  'VIEWPOINT',
  'POINTS',
  'DATA',
];
/** Chosen: a header of ten lines with this many fields fits with room to spare, and a file that is none is given up soon. */
const MAX_HEADER_BYTES = 16_384;
const MAX_FIELDS = 64;
/** Values of one field. Chosen: above the 308 of the longest usual descriptor (VFH). */
const MAX_COUNT = 4096;
const DATA_KINDS = ['ascii', 'binary', 'binary_compressed'] as const;
const SIZES: Readonly<Record<string, readonly number[]>> = { F: [4, 8], I: [1, 2, 4, 8], U: [1, 2, 4, 8] };

interface Line {
  number: number;
  words: string[];
}

/**
 * Some programs leave out VERSION, COUNT, VIEWPOINT, or one of WIDTH, HEIGHT and POINTS that follows from the others.
 *
 * @param mostPoints a file with more is refused
 * @throws {PcdError}
 */
export function parsePcdHeader(file: Uint8Array, mostPoints = MAX_POINTS_PER_FRAME): PcdHeader {
  const { lines, dataOffset, dataLine } = headerLines(file);
  const take = (keyword: string): Line => {
    const line = lines.get(keyword);
    if (line === undefined) throw new PcdError('bad-header', 'header', `no ${keyword} line`);
    return line;
  };
  const version = lines.get('VERSION');
  if (version !== undefined && !['.7', '0.7'].includes(version.words[0] ?? '')) {
    throw new PcdError(
      'unsupported',
      `line ${version.number}`,
      `version ${shown(version.words[0])}, not 0.7`,
    );
  }
  const fields = parseFields(take, lines.get('COUNT'));
  const pointsLine = lines.get('POINTS') ?? take('WIDTH');
  const lengthOf = (line: Line | undefined) => (line === undefined ? null : wholeNumber(line));
  const height = lengthOf(lines.get('HEIGHT')) ?? 1;
  const width = lengthOf(lines.get('WIDTH')) ?? wholeNumber(pointsLine) / Math.max(height, 1);
  const points = lengthOf(lines.get('POINTS')) ?? width * height;
  if (points !== width * height) {
    throw new PcdError(
      'bad-header',
      `line ${pointsLine.number}`,
      `${points} points, but ${width} × ${height} is ${width * height}`,
    );
  }
  if (points > mostPoints) {
    throw new PcdError('too-large', `line ${pointsLine.number}`, `${points} points, at most ${mostPoints}`);
  }
  const dataLineWords = take('DATA');
  const data = DATA_KINDS.find((kind) => kind === dataLineWords.words[0]);
  if (data === undefined) {
    throw new PcdError(
      'unsupported',
      `line ${dataLineWords.number}`,
      `DATA ${shown(dataLineWords.words[0])}`,
    );
  }
  const last = fields.at(-1) as PcdField;
  return {
    fields,
    width,
    height,
    points,
    pointBytes: last.offset + last.size * last.count,
    viewpoint: parseViewpoint(lines.get('VIEWPOINT')),
    data,
    dataOffset,
    dataLine,
  };
}

function headerLines(file: Uint8Array): { lines: Map<string, Line>; dataOffset: number; dataLine: number } {
  const lines = new Map<string, Line>();
  let offset = 0;
  for (let number = 1; ; number++) {
    const end = file.subarray(0, MAX_HEADER_BYTES).indexOf(10, offset);
    if (end < 0) {
      const code = lines.size === 0 ? 'not-pcd' : 'bad-header';
      throw new PcdError(code, `line ${number}`, 'the header does not end with a DATA line');
    }
    const text = String.fromCharCode(...file.subarray(offset, end)).trim();
    offset = end + 1;
    if (text === '' || text.startsWith('#')) continue;
    const [keyword = '', ...words] = text.split(/\s+/);
    if (!KEYWORDS.includes(keyword)) {
      const code = lines.size === 0 ? 'not-pcd' : 'bad-header';
      throw new PcdError(code, `line ${number}`, `${shown(keyword)} is not a header line`);
    }
    if (lines.has(keyword)) throw new PcdError('bad-header', `line ${number}`, `a second ${keyword} line`);
    lines.set(keyword, { number, words });
    if (keyword === 'DATA') return { lines, dataOffset: offset, dataLine: number + 1 };
  }
}

function parseFields(take: (keyword: string) => Line, counts: Line | undefined): PcdField[] {
  const names = take('FIELDS');
  const sizes = take('SIZE');
  const types = take('TYPE');
  const { words } = names;
  if (words.length === 0 || words.length > MAX_FIELDS) {
    throw new PcdError(
      'bad-header',
      `line ${names.number}`,
      `${words.length} fields, 1 to ${MAX_FIELDS} allowed`,
    );
  }
  for (const line of [sizes, types, ...(counts === undefined ? [] : [counts])]) {
    if (line.words.length !== words.length) {
      throw new PcdError(
        'bad-header',
        `line ${line.number}`,
        `${line.words.length} values for ${words.length} fields`,
      );
    }
  }
  let offset = 0;
  return words.map((name, i) => {
    const type = types.words[i] as string;
    const size = Number(sizes.words[i]);
    const count = counts === undefined ? 1 : Number(counts.words[i]);
    if (type !== 'F' && type !== 'I' && type !== 'U') {
      throw new PcdError(
        'bad-header',
        `line ${types.number}`,
        `field ${shown(name)} has type ${shown(type)}`,
      );
    }
    if (!SIZES[type]?.includes(size)) {
      throw new PcdError(
        'bad-header',
        `line ${sizes.number}`,
        `field ${shown(name)} of type ${type} has size ${shown(sizes.words[i])}`,
      );
    }
    if (!Number.isInteger(count) || count < 1 || count > MAX_COUNT) {
      throw new PcdError(
        'bad-header',
        `line ${counts?.number ?? 0}`,
        `field ${shown(name)} has count ${shown(counts?.words[i])}`,
      );
    }
    const field: PcdField = { name, size, type, count, offset };
    offset += size * count;
    return field;
  });
}

function parseViewpoint(line: Line | undefined): Pose {
  const [x = 0, y = 0, z = 0, qw = 1, qx = 0, qy = 0, qz = 0] = (line?.words ?? []).map(Number);
  const numbers = [x, y, z, qw, qx, qy, qz];
  const norm = Math.hypot(qw, qx, qy, qz);
  if (line !== undefined && (line.words.length !== 7 || !numbers.every(Number.isFinite) || !(norm > 1e-6))) {
    throw new PcdError('bad-header', `line ${line.number}`, 'VIEWPOINT is not a position and a quaternion');
  }
  return {
    position: { x, y, z },
    orientation: { x: qx / norm, y: qy / norm, z: qz / norm, w: qw / norm },
  };
}

function wholeNumber(line: Line): number {
  const word = line.words[0] ?? '';
  if (line.words.length !== 1 || !/^\d{1,10}$/.test(word)) {
    throw new PcdError(
      'bad-header',
      `line ${line.number}`,
      `${shown(line.words.join(' '))} is not a whole number`,
    );
  }
  return Number(word);
}

function shown(text: string | undefined): string {
  return text === undefined ? 'nothing' : `'${text.slice(0, 40)}'`;
}
