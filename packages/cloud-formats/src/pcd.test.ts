import { existsSync, readFileSync } from 'node:fs';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { compressLzf } from './lzf-writer.ts';
import { decodePcd, PcdError, parsePcdHeader, pcdIntensity } from './pcd.ts';

interface FieldSpec {
  name: string;
  type: 'F' | 'I' | 'U';
  size: 1 | 2 | 4 | 8;
  count?: number;
  /** Value of element 0 of a point; for `rgb`, the bits. */
  value: (point: number) => number;
}

type Encoding = 'ascii' | 'binary' | 'binary_compressed';

/** An independent writer: field by field, point by point. */
function writePcd(fields: FieldSpec[], width: number, height: number, encoding: Encoding): Uint8Array {
  const points = width * height;
  const header = [
    '# .PCD v0.7',
    'VERSION 0.7',
    `FIELDS ${fields.map((f) => f.name).join(' ')}`,
    `SIZE ${fields.map((f) => f.size).join(' ')}`,
    `TYPE ${fields.map((f) => f.type).join(' ')}`,
    `COUNT ${fields.map((f) => f.count ?? 1).join(' ')}`,
    `WIDTH ${width}`,
    `HEIGHT ${height}`,
    'VIEWPOINT 0 0 0 1 0 0 0',
    `POINTS ${points}`,
    `DATA ${encoding}`,
    '',
  ].join('\n');
  const head = new TextEncoder().encode(header);
  if (encoding === 'ascii') {
    const lines = Array.from({ length: points }, (_, i) =>
      fields
        .flatMap((f) => [asciiOf(f, f.value(i)), ...Array<string>((f.count ?? 1) - 1).fill('0')])
        .join(' '),
    );
    return concat(head, new TextEncoder().encode(`${lines.join('\n')}\n`));
  }
  const columns = fields.map((f) => {
    const bytes = new Uint8Array(points * f.size * (f.count ?? 1));
    const view = new DataView(bytes.buffer);
    for (let i = 0; i < points; i++) write(view, i * f.size * (f.count ?? 1), f, f.value(i));
    return bytes;
  });
  if (encoding === 'binary_compressed') {
    const data = concat(...columns);
    const compressed = compressLzf(data);
    const sizes = new Uint8Array(8);
    new DataView(sizes.buffer).setUint32(0, compressed.length, true);
    new DataView(sizes.buffer).setUint32(4, data.length, true);
    return concat(head, sizes, compressed);
  }
  const rows = Array.from({ length: points }, (_, i) =>
    columns.map((column) => {
      const step = column.length / points;
      return column.subarray(i * step, (i + 1) * step);
    }),
  );
  return concat(head, ...rows.flat());
}

function asciiOf(field: FieldSpec, value: number): string {
  if (!isBits(field) || field.type !== 'F') return String(value);
  const view = new DataView(new ArrayBuffer(4));
  view.setUint32(0, value);
  return String(view.getFloat32(0));
}

const isBits = (field: FieldSpec) => field.name.startsWith('rgb');

function write(view: DataView, at: number, field: FieldSpec, value: number): void {
  const writers: Record<string, () => void> = {
    F4: () => view.setFloat32(at, value, true),
    F8: () => view.setFloat64(at, value, true),
    I1: () => view.setInt8(at, value),
    I2: () => view.setInt16(at, value, true),
    I4: () => view.setInt32(at, value, true),
    I8: () => view.setBigInt64(at, BigInt(value), true),
    U1: () => view.setUint8(at, value),
    U2: () => view.setUint16(at, value, true),
    U4: () => view.setUint32(at, value, true),
    U8: () => view.setBigUint64(at, BigInt(value), true),
  };
  if (isBits(field)) view.setUint32(at, value, true);
  else writers[`${field.type}${field.size}`]?.();
}

function concat(...parts: Uint8Array[]): Uint8Array {
  return Uint8Array.from(Buffer.concat(parts));
}

const ENCODINGS: Encoding[] = ['ascii', 'binary', 'binary_compressed'];
const x: FieldSpec = { name: 'x', type: 'F', size: 4, value: (i) => i + 0.5 };
const y: FieldSpec = { name: 'y', type: 'F', size: 4, value: (i) => -i };
const z: FieldSpec = { name: 'z', type: 'F', size: 4, value: (i) => 2 * i };
const rgb: FieldSpec = { name: 'rgb', type: 'F', size: 4, value: (i) => 0x102030 + i };

describe('decodePcd', () => {
  it.each(ENCODINGS)('reads %s with fields in any order and of any type', (encoding) => {
    const type = fc.constantFrom<[FieldSpec['type'], FieldSpec['size']]>(
      ['F', 4],
      ['F', 8],
      ['I', 2],
      ['I', 4],
      ['I', 8],
      ['U', 2],
      ['U', 4],
      ['U', 8],
    );
    const layout = fc.record({
      types: fc.tuple(type, type, type),
      colourType: fc.constantFrom<FieldSpec['type']>('F', 'U', 'I'),
      colourName: fc.constantFrom('rgb', 'rgba'),
      other: fc.integer({ min: 1, max: 5 }),
      order: fc.shuffledSubarray([0, 1, 2, 3, 4], { minLength: 5 }),
      values: fc.array(fc.integer({ min: 0, max: 30_000 }), { minLength: 1, maxLength: 20 }),
      colours: fc.array(fc.integer({ min: 0, max: 0xffffff }), { minLength: 20, maxLength: 20 }),
    });
    fc.assert(
      fc.property(layout, ({ types, colourType, colourName, other, order, values, colours }) => {
        const axis = (name: string, k: 0 | 1 | 2): FieldSpec => ({
          name,
          type: types[k][0],
          size: types[k][1],
          value: (i) => ((values[i] as number) + k * 7) % 30_000,
        });
        const fields: FieldSpec[] = [
          axis('x', 0),
          axis('y', 1),
          axis('z', 2),
          { name: colourName, type: colourType, size: 4, value: (i) => colours[i] as number },
          { name: 'normal', type: 'F', size: 4, count: other, value: () => 9 },
        ];
        const file = writePcd(
          order.map((k) => fields[k] as FieldSpec),
          values.length,
          1,
          encoding,
        );
        const { points, header } = decodePcd(file);
        const bytes = new Uint8Array(points.buffer);
        expect(header.points).toBe(values.length);
        values.forEach((value, i) => {
          expect([...points.subarray(i * 4, i * 4 + 3)]).toEqual([0, 7, 14].map((k) => (value + k) % 30_000));
          const colour = colours[i] as number;
          expect([...bytes.subarray(i * 16 + 12, i * 16 + 16)]).toEqual([
            colour >> 16,
            (colour >> 8) & 0xff,
            colour & 0xff,
            255,
          ]);
        });
      }),
      { seed: 3, numRuns: 60 },
    );
  });

  it('keeps the grid, the viewpoint, and NaN points', () => {
    const file = writePcd([{ ...x, value: (i) => (i === 1 ? Number.NaN : i) }, y, z], 3, 2, 'ascii');
    const { header, points } = decodePcd(file);
    expect(header).toMatchObject({ width: 3, height: 2, points: 6 });
    expect(header.viewpoint.orientation).toEqual({ x: 0, y: 0, z: 0, w: 1 });
    expect(points[4]).toBeNaN();
    expect(points[8]).toBe(2);
  });

  it('colours intensities from dark to bright, and clouds without either in grey', () => {
    const intensity: FieldSpec = { name: 'intensity', type: 'F', size: 4, value: (i) => i * 10 };
    const bright = (file: Uint8Array, point: number) =>
      [...new Uint8Array(decodePcd(file).points.buffer, point * 16 + 12, 3)].reduce((a, b) => a + b);
    const file = writePcd([x, y, z, intensity], 200, 1, 'binary');
    expect(bright(file, 199)).toBeGreaterThan(bright(file, 100));
    expect(bright(file, 100)).toBeGreaterThan(bright(file, 0));
    expect(bright(writePcd([x, y, z], 1, 1, 'binary'), 0)).toBe(600);
  });

  it.each(['ascii', 'binary', 'binary_compressed'] as const)(
    'returns unscaled intensities (%s)',
    (encoding) => {
      const intensity: FieldSpec = { name: 'intensity', type: 'U', size: 2, value: (i) => i * 300 };
      expect([...(pcdIntensity(writePcd([x, intensity, y, z], 3, 1, encoding)) ?? [])]).toEqual([
        0, 300, 600,
      ]);
      expect(pcdIntensity(writePcd([x, y, z], 3, 1, encoding))).toBeNull();
    },
  );

  const text = (...lines: string[]) => new TextEncoder().encode(lines.join('\n'));
  const good = [
    'VERSION 0.7',
    'FIELDS x y z',
    'SIZE 4 4 4',
    'TYPE F F F',
    'COUNT 1 1 1',
    'WIDTH 1',
    'HEIGHT 1',
  ];
  it('reads files that leave out what follows from the rest', () => {
    const rest = [...good.slice(1, 4), 'POINTS 2', 'DATA ascii', '1 2 3', '4 5 6'];
    expect(decodePcd(text(...rest))).toMatchObject({ header: { width: 2, height: 1, points: 2 } });
    const grid = [...good.slice(1, 4), 'WIDTH 1', 'HEIGHT 2', 'DATA ascii', '1 2 3', '4 5 6'];
    expect(decodePcd(text(...grid)).points[4]).toBe(4);
  });

  const one = (encoding: string, ...lines: string[]) =>
    text(...good, 'POINTS 1', `DATA ${encoding}`, ...lines);
  it.each<[string, Uint8Array, string, string]>([
    ['no header', text('hello world', ''), 'not-pcd', 'line 1'],
    ['nothing at all', new Uint8Array(0), 'not-pcd', 'line 1'],
    [
      'another version',
      text('VERSION 0.6', ...good.slice(1), 'POINTS 1', 'DATA ascii', ''),
      'unsupported',
      'line 1',
    ],
    ['a line twice', text(...good, 'WIDTH 1', ''), 'bad-header', 'line 8'],
    ['no FIELDS', text('VERSION 0.7', 'DATA ascii', ''), 'bad-header', 'header'],
    ['points that contradict the grid', text(...good, 'POINTS 2', 'DATA ascii', ''), 'bad-header', 'line 8'],
    ['an unknown encoding', one('zip', ''), 'unsupported', 'line 9'],
    ['a value too few', one('ascii', '1 2'), 'bad-data', 'line 10'],
    ['a word for a number', one('ascii', '', '1 two 3'), 'bad-data', 'line 11'],
    ['a point too many', one('ascii', '1 2 3', '1 2 3'), 'bad-data', 'line 11'],
    ['a point too few', one('ascii', '', '', '', '', ''), 'truncated', 'line 14'],
    ['binary data cut off', one('binary', '12345678901'), 'truncated', 'byte 108'],
    ['no compressed sizes', one('binary_compressed', '1234'), 'truncated', 'byte 112'],
    [
      'more points than a frame may have',
      text(...good.slice(0, 5), 'WIDTH 4194305', 'HEIGHT 1', 'POINTS 4194305', 'DATA binary', ''),
      'too-large',
      'line 8',
    ],
    [
      'a type without such a size',
      text(
        'VERSION 0.7',
        'FIELDS x',
        'SIZE 2',
        'TYPE F',
        'WIDTH 0',
        'HEIGHT 1',
        'POINTS 0',
        'DATA ascii',
        '',
      ),
      'bad-header',
      'line 3',
    ],
    ['no z', writePcd([x, y], 1, 1, 'binary'), 'unsupported', 'field z'],
    [
      'a wide colour',
      writePcd([x, y, z, { ...rgb, name: 'rgb', size: 8, type: 'F' }], 1, 1, 'binary'),
      'unsupported',
      'field rgb',
    ],
  ])('refuses %s', (_, file, code, where) => {
    expect(() => decodePcd(file)).toThrow(expect.objectContaining({ name: 'PcdError', code, where }));
  });

  it('allocates nothing for compressed data that cannot exist', () => {
    const file = writePcd([x, y, z, { ...rgb, name: 'pad', count: 4096 }], 1, 1, 'binary_compressed');
    const claim = new TextDecoder('latin1')
      .decode(file)
      .replace('WIDTH 1', 'WIDTH 900000')
      .replace('POINTS 1', 'POINTS 900000');
    expect(() => decodePcd(Uint8Array.from(claim, (c) => c.charCodeAt(0)))).toThrow(PcdError);
  });

  it('any input is decoded or throws a PcdError', () => {
    const files = ENCODINGS.map((encoding) => writePcd([x, y, z, rgb], 4, 3, encoding));
    const damage = fc.array(fc.tuple(fc.nat(), fc.nat(255)), { minLength: 1, maxLength: 6 });
    fc.assert(
      fc.property(fc.constantFrom(...files), damage, fc.nat(), fc.boolean(), (file, edits, cut, shorten) => {
        const broken = Uint8Array.from(shorten ? file.subarray(0, cut % file.length) : file);
        for (const [at, value] of edits) if (broken.length > 0) broken[at % broken.length] = value;
        try {
          expect(decodePcd(broken).points.length).toBe(parsePcdHeader(broken).points * 4);
        } catch (error) {
          expect(error).toBeInstanceOf(PcdError);
        }
      }),
      { seed: 4, numRuns: 3000 },
    );
  });
});

const clouds = new URL('../../../../shared/data/clouds/', import.meta.url);
describe.skipIf(!existsSync(clouds))('recorded clouds (skipped without ../shared/data)', () => {
  it.each([
    ['kinect-room.pcd', 640, 480, 0.85],
    ['stereo-table.pcd', 640, 480, 0.68],
    ['lidar-street.pcd', 115_385, 1, 1],
  ])('reads %s', (name, width, height, valid) => {
    const { header, points } = decodePcd(readFileSync(new URL(name, clouds)));
    expect(header).toMatchObject({ width, height });
    let finite = 0;
    for (let i = 0; i < points.length; i += 4) if (Number.isFinite(points[i])) finite++;
    expect(finite / header.points).toBeCloseTo(valid, 1);
  });
});
