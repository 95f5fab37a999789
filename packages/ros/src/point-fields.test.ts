/** Clouds with fields that nobody reads, and with colours of any type. */
import { describe, expect, it } from 'vitest';
import { type PointCloud2, pointCloud2Schema } from './messages.ts';
import { checkedCount, PointCloud2Decoder } from './point-cloud2.ts';

const SIZES = [0, 1, 1, 2, 2, 4, 4, 4, 8, 8, 8, 1];
type Values = Record<string, [datatype: number, values: number[]]>;

/** Points with these fields, one after the other. */
function cloudOf(values: Values, shape: Partial<PointCloud2> = {}): PointCloud2 {
  const all: Values = { x: [7, [1, 2]], y: [7, [3, 4]], z: [7, [5, 6]], ...values };
  let step = 0;
  const fields = Object.entries(all).map(([name, [datatype]]) => {
    const field = { name, offset: step, datatype, count: 1 };
    step += SIZES[datatype] ?? 4;
    return field;
  });
  const data = new Uint8Array(2 * step);
  const view = new DataView(data.buffer);
  for (const { name, offset, datatype } of fields)
    for (const [point, value] of (all[name]?.[1] ?? []).entries()) {
      const at = point * step + offset;
      if (datatype === 2 || datatype === 11) view.setUint8(at, value);
      if (datatype === 4) view.setUint16(at, value, true);
      if (datatype === 7) view.setFloat32(at, value, true);
      if (datatype === 8) view.setFloat64(at, value, true);
      if (datatype === 9) view.setBigInt64(at, BigInt(value), true);
      if (datatype === 10) view.setBigUint64(at, BigInt(value), true);
    }
  const header = { stamp: { sec: 0, nanosec: 0 }, frame_id: 'lidar' };
  const sizes = { width: 2, height: 1, point_step: step, row_step: 2 * step };
  return pointCloud2Schema.parse({ header, ...sizes, is_bigendian: false, fields, data, ...shape });
}

function decoded(cloud: PointCloud2, decoder = new PointCloud2Decoder()) {
  const into = new Float32Array(8);
  expect(decoder.decode(cloud, 'optical', into)).toBe(2);
  const words = new Uint32Array(into.buffer);
  return { points: [...into.subarray(0, 3), ...into.subarray(4, 7)], colours: [words[3], words[7]] };
}

const POINTS = [1, 3, 5, 2, 4, 6];
const GREY = decoded(cloudOf({})).colours;
const rgba = (r: number, g: number, b: number) => (r | (g << 8) | (b << 16) | 0xff00_0000) >>> 0;

describe('a field that nobody reads costs nothing', () => {
  it.each([
    ['INT64', { t: [9, [-1, 1]] }],
    ['UINT64', { t: [10, [1, 2]] }],
    ['BOOLEAN', { ground: [11, [1, 0]] }],
    ['of a type that nobody knows', { what: [42, [0, 0]] }],
    ['without a type', { what: [0, [0, 0]] }],
  ] as [string, Values][])('%s', (_, values) => {
    expect(decoded(cloudOf(values)).points).toEqual(POINTS);
  });

  it('outside its point', () => {
    const cloud = cloudOf({});
    for (const name of ['t', 'rgb', 'intensity', 'ring', 'r']) {
      const fields = [...cloud.fields, { name, offset: 11, datatype: 7, count: 1 }];
      expect(decoded({ ...cloud, fields })).toEqual({ points: POINTS, colours: GREY });
    }
  });

  it('but one that is read must be there', () => {
    const cloud = cloudOf({});
    const moved = (change: object) => ({
      ...cloud,
      fields: cloud.fields.map((field) => (field.name === 'z' ? { ...field, ...change } : field)),
    });
    expect(() => checkedCount(moved({ offset: 9 }))).toThrow('field z at 9 is outside its point of 12 bytes');
    expect(() => checkedCount(moved({ datatype: 42 }))).toThrow('field z is of the unknown type 42');
  });
});

it('takes coordinates of the newer types', () => {
  const values: Values = { x: [9, [-7, 2]], y: [10, [3, 4]], z: [11, [1, 0]] };
  expect(decoded(cloudOf(values)).points).toEqual([-7, 3, 1, 2, 4, 0]);
});

describe('rows', () => {
  it('without a length have nothing between them', () => {
    expect(decoded(cloudOf({}, { width: 1, height: 2, row_step: 0 })).points).toEqual(POINTS);
    const depth = new Float32Array(2);
    const cloud = cloudOf({ t: [9, [0, 0]] }, { width: 1, height: 2, row_step: 0 });
    new PointCloud2Decoder().decodeImages(cloud, depth, new Uint32Array(2));
    expect([...depth]).toEqual([5, 6]);
  });

  it('that are too short are refused', () => {
    expect(() => checkedCount(cloudOf({}, { width: 1, height: 2, row_step: 4 }))).toThrow('a row of 4 bytes');
  });
});

describe('red, green and blue', () => {
  const coloured = (type: number, ...[r, g, b]: number[][]) =>
    cloudOf({ r: [type, r ?? []], g: [type, g ?? []], b: [type, b ?? []] });
  const dyed = [rgba(255, 51, 0), rgba(0, 102, 153)];

  it.each([
    ['bytes', 2, 255],
    ['16 bits up to 255', 4, 255],
    ['16 bits', 4, 65_535],
    ['floats from 0 to 1', 7, 1],
    ['floats from 0 to 255', 7, 255],
    ['doubles', 8, 1],
  ])('as %s', (_, type, full) => {
    const share = (...shares: number[]) => shares.map((each) => each * full);
    const cloud = coloured(type, share(1, 0), share(0.2, 0.4), share(0, 0.6));
    expect(decoded(cloud)).toEqual({ points: POINTS, colours: dyed });
  });

  it('that are NaN or out of range are black or full', () => {
    const cloud = coloured(7, [Number.NaN, 1], [Number.POSITIVE_INFINITY, 0], [-1, 0]);
    expect(decoded(cloud).colours).toEqual([rgba(0, 255, 0), rgba(255, 0, 0)]);
  });

  it('keep their scale when a cloud is dark', () => {
    const decoder = new PointCloud2Decoder();
    decoded(coloured(7, [255, 0], [0, 0], [0, 0]), decoder);
    expect(decoded(coloured(7, [1, 0], [0, 0], [0, 0]), decoder).colours).toEqual([
      rgba(1, 0, 0),
      rgba(0, 0, 0),
    ]);
  });
});
