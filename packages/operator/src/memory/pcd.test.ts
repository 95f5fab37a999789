import { casesOf, longProperty } from '@farpoint/network-sim/cases';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { ticksOf } from './memory-layout.ts';
import { isPcd, readPcd, writePcd } from './pcd.ts';
import { PointFileError } from './point-file.ts';
import { type RememberedPlace, rememberedPlaces } from './testing/remembered-places.ts';
import { WorldMap } from './world-map.ts';

function pcd(header: string, data: Uint8Array = new Uint8Array()): Uint8Array {
  return new Uint8Array([...new TextEncoder().encode(header), ...data]);
}

const XYZ = 'FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n';
const NOW = ticksOf(600_000);

describe('readPcd', () => {
  test('reads other programs’ binary files: doubles, padding and counts between, colours as floats', () => {
    const header =
      '# .PCD v.7 - Point Cloud Data file format\r\nVERSION .7\r\nFIELDS x _ y z rgb id\r\nSIZE 8 1 8 8 4 8\r\n' +
      'TYPE F U F F F U\r\nCOUNT 1 3 1 1 1 1\r\nWIDTH 2\r\nHEIGHT 1\r\nVIEWPOINT 0 0 0 1 0 0 0\r\nPOINTS 2\r\nDATA binary\r\n';
    const data = new DataView(new ArrayBuffer(78));
    for (const [at, value] of [
      [0, 1],
      [11, -2],
      [19, 3.5],
    ] as const)
      data.setFloat64(at, value, true);
    data.setUint32(27, 0xffff8000, true);
    data.setFloat64(39, Number.NaN, true);
    const file = readPcd(pcd(header, new Uint8Array(data.buffer)));
    expect(file.count).toBe(1);
    expect([...file.places.subarray(0, 3)]).toEqual([1, -2, 3.5]);
    expect(file.colours[0]).toBe((31 << 11) | (32 << 5));
    expect(file.savedAt).toBe(null);
  });

  test('reads text: colours as whole numbers or as floats of their bits, without a count, with holes', () => {
    const bits = new DataView(new ArrayBuffer(4));
    bits.setUint32(0, 0x0000ff00);
    const header =
      'VERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F F\nWIDTH 2\nHEIGHT 2\nDATA ascii\n';
    const text = `1 2 3 255\n nan nan nan 0\n\n-1.5e0\t0 0.25 ${bits.getFloat32(0)}\r\n0 0 0 4278190335`;
    const file = readPcd(pcd(header + text));
    expect(file.count).toBe(3);
    expect([...file.places.subarray(3, 6)]).toEqual([-1.5, 0, 0.25]);
    expect([...file.colours.subarray(0, 3)]).toEqual([31, 63 << 5, 31]);
    expect([...file.agesS.subarray(0, 3)]).toEqual([0, 0, 0]);
  });

  test('reads compressed files', () => {
    const point = new Uint8Array(Float32Array.of(1, -2, 3.5).buffer);
    // The lengths, packed and not, then a run of 12 bytes as they are.
    const data = Uint8Array.of(13, 0, 0, 0, 12, 0, 0, 0, 11, ...point);
    const file = readPcd(pcd(`${XYZ}POINTS 1\nDATA binary_compressed\n`, data));
    expect([file.count, ...file.places]).toEqual([1, 1, -2, 3.5]);
  });

  test.each([
    ['no PCD', 'ply\n', /no PCD/],
    ['no end', `VERSION 0.7\n${XYZ}POINTS 1\n`, /header does not end/],
    ['compressed data that are none', `${XYZ}POINTS 1\nDATA binary_compressed\n`, /no compressed sizes/],
    ['too short', `${XYZ}POINTS 9\nDATA binary\n1234`, /9 points need 108 bytes/],
    [
      'text that is too short',
      `${XYZ}POINTS 99\nDATA ascii\n1 2 3\n`,
      /99 points of 3 values cannot be here/,
    ],
    ['text with too few lines', `${XYZ}POINTS 2\nDATA ascii\n1.000000 2.000000 3.000000\n`, /1 of 2 points/],
    ['a line that is too short', `${XYZ}POINTS 1\nDATA ascii\n1.0000 2.000\n`, /line 7: 2 values, 3 needed/],
    ['too many', `${XYZ}POINTS 1e15\nDATA ascii\n`, /is not a whole number/],
    ['more than can be kept', `${XYZ}POINTS 16777217\nDATA binary\n`, /at most 16777216/],
    ['no number of points', `${XYZ}DATA ascii\n`, /no WIDTH line/],
    ['no z', 'FIELDS x y\nSIZE 4 4\nTYPE F F\nPOINTS 0\nDATA ascii\n', /no z/],
    [
      'a type',
      `FIELDS x y z\nSIZE 4 4 3\nTYPE F F F\nPOINTS 0\nDATA ascii\n`,
      /field 'z' of type F has size '3'/,
    ],
    ['a count', `${XYZ.replace('1 1 1', '1 0 1')}POINTS 0\nDATA ascii\n`, /field 'y' has count '0'/],
    ['fewer types', 'FIELDS x y z\nSIZE 4 4 4\nTYPE F F\nPOINTS 0\nDATA ascii\n', /2 values for 3 fields/],
  ])('refuses %s', (_, text, message) => {
    expect(() => readPcd(pcd(text))).toThrow(message);
  });

  test('reads anything or says what is wrong', () => {
    const line = fc.constantFrom(
      ...[
        '# .PCD',
        '# saved now',
        'VERSION 0.7',
        'FIELDS x y z',
        'FIELDS x y z rgb age',
        'FIELDS z y x rgba',
      ],
      ...['SIZE 4 4 4', 'SIZE 4 8 4 4 4', 'SIZE 2 2 2 4', 'TYPE F F F', 'TYPE I U I U', 'TYPE F F F U F'],
      ...['COUNT 1 1 1', 'COUNT 1 2 1 1 1', 'WIDTH 2', 'WIDTH -1', 'HEIGHT 2', 'POINTS 3', 'POINTS', ''],
      ...['DATA ascii', 'DATA binary', 'DATA', '1 2 3', '-1 nan 1e9 7 2 1', 'VIEWPOINT 0'],
    );
    const known = fc.tuple(
      fc.constantFrom(XYZ, 'FIELDS x y z rgb age\nSIZE 4 4 4 4 4\nTYPE F F F U F\n'),
      fc.nat(5).map((points) => `POINTS ${points}`),
      fc.constantFrom('DATA ascii', 'DATA binary'),
    );
    const headers = fc.oneof(
      fc.array(line, { maxLength: 14 }),
      fc.tuple(known, fc.array(line, { maxLength: 6 })).map(([lines, rest]) => [...lines, ...rest]),
    );
    let read = 0;
    fc.assert(
      fc.property(headers, fc.uint8Array({ maxLength: 120 }), (lines, data) => {
        try {
          const { count, places, colours, agesS } = readPcd(pcd(`VERSION 0.7\n${lines.join('\n')}\n`, data));
          expect(places.length).toBe(colours.length * 3);
          expect(colours.length).toBeGreaterThanOrEqual(count);
          for (let i = 0; i < count; i++) expect(agesS[i]).toBeGreaterThanOrEqual(0);
          read++;
        } catch (error) {
          expect(error).toBeInstanceOf(PointFileError);
        }
      }),
      longProperty(4, 2000),
    );
    expect(read).toBeGreaterThan(casesOf(50));
  });
});

describe.each(['ascii', 'binary'] as const)('as %s', (data) => {
  test('what is written is read again: places, colours and ages', () => {
    const coordinate = fc.double({ min: -40, max: 40, noNaN: true });
    const place = fc.record({ x: coordinate, y: coordinate, z: fc.double({ min: -2, max: 4, noNaN: true }) });
    const point = fc.record({ place, colour: fc.nat(0xffff), agoTicks: fc.nat(16 * 3600) });
    fc.assert(
      fc.property(fc.array(point, { maxLength: 40 }), (points) => {
        const map = new WorldMap({ pages: 64 });
        for (const { place, colour, agoTicks } of points)
          map.restore(place.x, place.y, place.z, colour, NOW - agoTicks);
        const bytes = new Uint8Array(writePcd(map.store, data, NOW, '2026-01-02T03:04:05.000Z'));
        expect(isPcd(bytes)).toBe(true);
        const file = readPcd(bytes);
        expect(file.savedAt).toBe('2026-01-02T03:04:05.000Z');
        expect(file.count).toBe(map.store.count);
        const loaded = new WorldMap({ pages: 64 });
        for (let i = 0; i < file.count; i++) {
          const [x, y, z] = [...file.places.subarray(i * 3, i * 3 + 3)] as [number, number, number];
          const ticks = NOW - Math.round((file.agesS[i] as number) * 16);
          expect(loaded.restore(x, y, z, file.colours[i] as number, ticks)).toBe(true);
        }
        const sorted = (store: WorldMap['store']) => {
          const order = (a: RememberedPlace, b: RememberedPlace) => a.x - b.x || a.y - b.y || a.z - b.z;
          return rememberedPlaces(store).sort(order);
        };
        expect(sorted(loaded.store)).toEqual(sorted(map.store));
      }),
      longProperty(5, 200),
    );
  });
});
