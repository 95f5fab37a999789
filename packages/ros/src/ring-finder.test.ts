import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import type { PointCloud2 } from './messages.ts';
import { PointCloud2Decoder } from './point-cloud2.ts';

const DEGREE = Math.PI / 180;

interface Scan {
  /** By the number that the driver gives a ring, radians. */
  readonly elevations: readonly number[];
  readonly columns?: number;
  /** Name of the field with the ring; `null`: rows are rings. */
  readonly field?: string | null;
  /** Metres by which the frame's origin is above the sensor. */
  readonly raised?: number;
  readonly skip?: readonly number[];
}

/** A turn of a LiDAR in a room of 8 m, in body axes: floats x, y, z, and the ring as a 16-bit number. */
function scan({ elevations, columns = 300, field = 'ring', raised = 0, skip = [] }: Scan): PointCloud2 {
  const rows = elevations.length;
  const step = 16;
  const data = new Uint8Array(rows * columns * step);
  const view = new DataView(data.buffer);
  for (let i = 0; i < rows * columns; i++) {
    // Velodyne's drivers write column by column, row by row it must be without a field.
    const ring = field === null ? Math.floor(i / columns) : i % rows;
    const column = field === null ? i % columns : Math.floor(i / rows);
    const azimuth = (2 * Math.PI * column) / columns;
    const range = skip.includes(ring) ? Number.NaN : 8 + 2 * Math.cos(2 * azimuth);
    const elevation = elevations[ring]!;
    view.setFloat32(i * step, range * Math.cos(elevation) * Math.cos(azimuth), true);
    view.setFloat32(i * step + 4, range * Math.cos(elevation) * Math.sin(azimuth), true);
    view.setFloat32(i * step + 8, range * Math.sin(elevation) - raised, true);
    view.setUint16(i * step + 12, ring, true);
  }
  const xyz = ['x', 'y', 'z'].map((name, i) => ({ name, offset: i * 4, datatype: 7, count: 1 }));
  const [width, height] = field === null ? [columns, rows] : [rows * columns, 1];
  return {
    header: { stamp: { sec: 0, nanosec: 0 }, frame_id: 'lidar' },
    fields: field === null ? xyz : [...xyz, { name: field, offset: 12, datatype: 4, count: 1 }],
    ...{ width, height, data, point_step: step, row_step: width * step, is_bigendian: false },
  };
}

function ringsOf(...clouds: readonly PointCloud2[]): readonly number[] | null {
  const decoder = new PointCloud2Decoder();
  for (const cloud of clouds) decoder.decode(cloud, 'body', new Float32Array(cloud.width * cloud.height * 4));
  return decoder.rings;
}

function expectNear(found: readonly number[] | null, elevations: readonly number[]): void {
  expect(found).toHaveLength(elevations.length);
  for (const [i, elevation] of elevations.entries()) expect(found![i]).toBeCloseTo(elevation, 4);
}

describe('RingFinder', () => {
  test('finds the rings that a field names, ascending, whatever their numbers', () => {
    const elevations = fc
      .uniqueArray(fc.integer({ min: -80, max: 80 }), { minLength: 2, maxLength: 128 })
      .map((halves) => halves.map((half) => (half / 2) * DEGREE));
    fc.assert(
      fc.property(elevations, fc.constantFrom('ring', 'channel'), (each, field) => {
        expectNear(
          ringsOf(scan({ elevations: each, field })),
          [...each].sort((a, b) => a - b),
        );
      }),
      { numRuns: 30 },
    );
  });

  test('finds the rings of an organised cloud by its rows', () => {
    const rows = Array.from({ length: 64 }, (_, row) => (22.5 - (row * 45) / 63) * DEGREE);
    expectNear(ringsOf(scan({ elevations: rows, field: null })), [...rows].reverse());
  });

  test('adds rings that hit nothing at first', () => {
    const elevations = Array.from({ length: 16 }, (_, ring) => (ring * 2 - 15) * DEGREE);
    expectNear(ringsOf(scan({ elevations, skip: [14, 15] })), elevations.slice(0, 14));
    expectNear(ringsOf(scan({ elevations, skip: [14, 15] }), scan({ elevations })), elevations);
  });

  test('finds none in a cloud of another frame, of a camera, or without a word about rings', () => {
    const elevations = Array.from({ length: 32 }, (_, ring) => (ring - 16) * DEGREE);
    expect(ringsOf(scan({ elevations, raised: 0.8 }))).toBeNull();
    const plain = scan({ elevations });
    expect(ringsOf({ ...plain, fields: plain.fields.slice(0, 3) })).toBeNull();
    // The rows of a camera that looks down, on a wall: the elevation changes along each of them.
    const [width, height] = [160, 120];
    const data = new Uint8Array(width * height * 12);
    const view = new DataView(data.buffer);
    for (let i = 0; i < width * height; i++) {
      const [u, v] = [((i % width) - 80) / 90, (Math.floor(i / width) - 20) / 90];
      for (const [axis, value] of [4, -u * 4, -v * 4].entries())
        view.setFloat32(i * 12 + axis * 4, value, true);
    }
    const fields = plain.fields.slice(0, 3);
    const camera = { ...plain, fields, data, width, height, point_step: 12, row_step: width * 12 };
    expect(ringsOf(camera)).toBeNull();
  });

  test('ignores points without a place or a ring', () => {
    const cloud = scan({ elevations: [0, 0.1], skip: [0, 1] });
    expect(ringsOf(cloud)).toBeNull();
    const view = new DataView(cloud.data.buffer);
    for (let i = 0; i < cloud.width; i++) view.setUint16(i * 16 + 12, 300 + i, true);
    expect(ringsOf(cloud)).toBeNull();
  });
});
