import { longProperty } from '@farpoint/network-sim/cases';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { RosFault } from './fault.ts';
import { GREY } from './image.ts';
import type { PointCloud2, PointField } from './messages.ts';
import { PointCloud2Decoder } from './point-cloud2.ts';

const SIZES = [1, 1, 2, 2, 4, 4, 4, 8];

function write(view: DataView, at: number, datatype: number, value: number, little: boolean): void {
  const writers = [
    () => view.setInt8(at, value),
    () => view.setUint8(at, value),
    () => view.setInt16(at, value, little),
    () => view.setUint16(at, value, little),
    () => view.setInt32(at, value, little),
    () => view.setUint32(at, value, little),
    () => view.setFloat32(at, value, little),
    () => view.setFloat64(at, value, little),
  ];
  writers[datatype - 1]?.();
}

interface Spec {
  width: number;
  height: number;
  bigEndian: boolean;
  types: Record<string, number>;
  order: string[];
  gap: number;
  rowPadding: number;
  value: (field: string, point: number) => number;
}

/** An independent writer: point by point, field by field. */
function cloudOf({ width, height, bigEndian, types, order, gap, rowPadding, value }: Spec): PointCloud2 {
  const fields: PointField[] = [];
  let step = gap;
  for (const name of order) {
    fields.push({ name, offset: step, datatype: types[name] as number, count: 1 });
    step += (SIZES[(types[name] as number) - 1] as number) + gap;
  }
  const rowStep = width * step + rowPadding;
  const data = new Uint8Array(rowStep * height);
  const view = new DataView(data.buffer);
  for (let row = 0; row < height; row++) {
    for (let column = 0; column < width; column++) {
      for (const { name, offset, datatype } of fields) {
        const at = row * rowStep + column * step + offset;
        // Packed colours are bits, whatever the field's type says.
        const asBits = name.startsWith('rgb') ? 6 : datatype;
        write(view, at, asBits, value(name, row * width + column), !bigEndian);
      }
    }
  }
  return {
    header: { stamp: { sec: 0, nanosec: 0 }, frame_id: 'lidar' },
    ...{ width, height, fields, data },
    is_bigendian: bigEndian,
    point_step: step,
    row_step: rowStep,
  };
}

const anyLayout = fc.record({
  width: fc.integer({ min: 1, max: 9 }),
  height: fc.integer({ min: 1, max: 4 }),
  bigEndian: fc.boolean(),
  types: fc.record({
    x: fc.integer({ min: 1, max: 8 }),
    y: fc.integer({ min: 1, max: 8 }),
    z: fc.integer({ min: 1, max: 8 }),
    rgb: fc.constantFrom(6, 7),
    extra: fc.integer({ min: 1, max: 8 }),
  }),
  order: fc.shuffledSubarray(['x', 'y', 'z', 'rgb', 'extra'], { minLength: 5 }),
  gap: fc.constantFrom(0, 0, 1, 3, 4),
  rowPadding: fc.constantFrom(0, 0, 5, 8),
});
/** The layout that nearly every driver writes: aligned words, which are read as such. */
const wordLayout = anyLayout.map((spec) => ({
  ...spec,
  bigEndian: false,
  types: { x: 7, y: 7, z: 7, rgb: spec.types.rgb, extra: 7 },
  gap: spec.gap % 4 === 0 ? spec.gap : 0,
  rowPadding: spec.rowPadding % 4 === 0 ? spec.rowPadding : 4,
}));
const layout = fc.oneof(anyLayout, wordLayout);

describe('PointCloud2Decoder', () => {
  it('reads fields in any order, of any type and endianness, in both axes', () => {
    fc.assert(
      fc.property(layout, fc.constantFrom('optical' as const, 'body' as const), (spec, axes) => {
        const value = (field: string, i: number) =>
          ({ x: i % 100, y: (i * 2) % 100, z: (i * 3) % 100 })[field] ?? 0x0a_14_1e + (i % 50);
        const cloud = cloudOf({ ...spec, value });
        const count = spec.width * spec.height;
        const into = new Float32Array(count * 4);
        expect(new PointCloud2Decoder().decode(cloud, axes, into)).toBe(count);
        const words = new Uint32Array(into.buffer);
        for (let i = 0; i < count; i++) {
          const [x, y, z] = [i % 100, (i * 2) % 100, (i * 3) % 100] as [number, number, number];
          const expected = axes === 'optical' ? [x, y, z] : [0 - y, 0 - z, x];
          expect([...into.subarray(i * 4, i * 4 + 3)].map((c) => c + 0)).toEqual(expected);
          const argb = 0x0a_14_1e + (i % 50);
          expect(words[i * 4 + 3]).toBe(
            (((argb >> 16) & 0xff) | (argb & 0xff00) | ((argb & 0xff) << 16) | 0xff00_0000) >>> 0,
          );
        }
      }),
    );
  });

  it('reads unaligned memory like aligned memory', () => {
    const cloud = cloudOf({
      ...{ width: 7, height: 2, bigEndian: false, gap: 0, rowPadding: 0 },
      types: { x: 7, y: 7, z: 7, intensity: 7 },
      order: ['x', 'y', 'z', 'intensity'],
      value: (field, i) => (field === 'intensity' ? i * 3 : i + 0.25),
    });
    const [aligned, shifted] = [new Float32Array(56), new Float32Array(56)];
    new PointCloud2Decoder().decode(cloud, 'optical', aligned);
    const moved = new Uint8Array(cloud.data.length + 1);
    moved.set(cloud.data, 1);
    new PointCloud2Decoder().decode({ ...cloud, data: moved.subarray(1) }, 'optical', shifted);
    expect(new Uint32Array(shifted.buffer)).toEqual(new Uint32Array(aligned.buffer));
    // Intensities become colours of increasing brightness.
    const brightness = Array.from({ length: 14 }, (_, i) => {
      const word = new Uint32Array(aligned.buffer)[i * 4 + 3] as number;
      return (word & 0xff) + ((word >> 8) & 0xff) + ((word >> 16) & 0xff);
    });
    expect(brightness.at(-1)).toBeGreaterThan(brightness[0] as number);
  });

  it('reads a depth camera’s cloud as images, with the same depth and colours', () => {
    fc.assert(
      fc.property(layout, (spec) => {
        const cloud = cloudOf({ ...spec, value: (field, i) => (field === 'z' ? i % 90 : i + 7) });
        const count = spec.width * spec.height;
        const points = new Float32Array(count * 4);
        const [depth, colour] = [new Float32Array(count), new Uint32Array(count)];
        new PointCloud2Decoder().decode(cloud, 'optical', points);
        expect(new PointCloud2Decoder().decodeImages(cloud, depth, colour)).toBe(count);
        expect([...depth]).toEqual(Array.from(depth, (_, i) => points[i * 4 + 2]));
        const words = new Uint32Array(points.buffer);
        expect([...colour]).toEqual(Array.from(colour, (_, i) => words[i * 4 + 3]));
      }),
    );
  });

  it('a packed colour that its point has no room for is none', () => {
    const cloud = cloudOf({
      ...{ width: 2, height: 1, bigEndian: false, gap: 0, rowPadding: 0, order: ['x', 'y', 'z', 'rgb'] },
      ...{ types: { x: 7, y: 7, z: 7, rgb: 7 }, value: (field, i) => (field === 'rgb' ? 0xff0000 : i) },
    });
    const into = new Float32Array(8);
    const fields = cloud.fields.map((each) =>
      each.name === 'rgb' ? { ...each, offset: 13, datatype: 2 } : each,
    );
    new PointCloud2Decoder().decode({ ...cloud, fields }, 'body', into);
    expect([3, 7].map((at) => new Uint32Array(into.buffer)[at])).toEqual([GREY, GREY]);
  });

  it('refuses inconsistent clouds of any size, and never reads beyond the data', () => {
    const wild = fc.record({
      width: fc.oneof(fc.integer({ min: 0, max: 20 }), fc.integer({ min: 0, max: 0xffffffff })),
      height: fc.oneof(fc.integer({ min: 0, max: 4 }), fc.integer({ min: 0, max: 0xffffffff })),
      point_step: fc.integer({ min: 0, max: 40 }),
      row_step: fc.integer({ min: 0, max: 400 }),
      is_bigendian: fc.boolean(),
      fields: fc.array(
        fc.record({
          name: fc.constantFrom('x', 'y', 'z', 'rgb', 'intensity', 'r', 'g', 'b'),
          offset: fc.integer({ min: 0, max: 40 }),
          datatype: fc.integer({ min: 1, max: 8 }),
          count: fc.integer({ min: 0, max: 2 }),
        }),
        { maxLength: 8 },
      ),
      data: fc.uint8Array({ maxLength: 600 }),
    });
    let decoded = 0;
    fc.assert(
      fc.property(wild, fc.boolean(), (fields, asImages) => {
        const cloud = { header: { stamp: { sec: 0, nanosec: 0 }, frame_id: '' }, ...fields };
        try {
          if (asImages)
            new PointCloud2Decoder().decodeImages(cloud, new Float32Array(100), new Uint32Array(100));
          else new PointCloud2Decoder().decode(cloud, 'body', new Float32Array(400));
          decoded++;
        } catch (error) {
          expect(error).toBeInstanceOf(RosFault);
        }
      }),
      longProperty(1, 2000),
    );
    expect(decoded).toBeGreaterThan(0);
  });
});
