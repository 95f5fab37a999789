import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { CLOUD_FORMATS } from './cloud-format.ts';
import type { Quaternion, Vector3 } from './geometry.ts';
import {
  copyPlacement,
  emptyPlacement,
  type Placement,
  type PlacementFault,
  readPlacement,
  writePlacement,
} from './placement.ts';
import { readVectors } from './testing/vectors.ts';

interface PlacementVector extends Omit<Placement, 'pose'> {
  position: Vector3;
  orientation: Quaternion;
}
interface Vector {
  name: string;
  hex: string;
  placement?: PlacementVector;
  fault?: PlacementFault;
}
const vectors = readVectors<{
  read: Vector[];
  write: Vector[];
}>('placement');

function toPlacement({ position, orientation, ...rest }: PlacementVector): Placement {
  return { pose: { position, orientation }, ...rest };
}

function viewOf(bytes: Uint8Array): DataView {
  return new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
}

test('a copy has every value and shares no object', () => {
  const from: Placement = {
    pose: { position: { x: 1, y: 2, z: 3 }, orientation: { x: 0.1, y: 0.2, z: 0.3, w: 0.9 } },
    captureTimeUs: 4,
    latencyTest: true,
    saturated: true,
    sensor: 5,
    format: 'organised',
  };
  const into = emptyPlacement();
  const { pose } = into;
  copyPlacement(from, into);
  expect(into).toEqual(from);
  from.pose.position.x = 9;
  from.pose.orientation.w = 9;
  expect(into.pose).toBe(pose);
  expect([pose.position.x, pose.orientation.w]).toEqual([1, 0.9]);
});

describe('conformance vectors', () => {
  test.each(vectors.read)('read: $name', ({ hex, placement, fault }) => {
    const into = emptyPlacement();
    expect(readPlacement(viewOf(Buffer.from(hex, 'hex')), into)).toBe(fault ?? null);
    if (placement !== undefined) expect(into).toEqual(toPlacement(placement));
  });

  test.each(vectors.write)('write: $name', ({ hex, placement }) => {
    const bytes = new Uint8Array(30).fill(0xaa);
    writePlacement(viewOf(bytes), 1, toPlacement(placement as PlacementVector));
    expect(Buffer.from(bytes).toString('hex')).toBe(`aa${hex}aa`);
  });
});

test('the written pose is accurate to a float32 and half a quaternion step', () => {
  const component = fc.double({ min: -1, max: 1, noNaN: true });
  const metres = fc.double({ min: -1e5, max: 1e5, noNaN: true });
  fc.assert(
    fc.property(
      fc.tuple(metres, metres, metres),
      fc.tuple(component, component, component, component).filter((q) => Math.hypot(...q) > 0.1),
      fc.integer({ min: 0, max: 0xffffffff }),
      fc.boolean(),
      fc.boolean(),
      fc.nat(255),
      fc.constantFrom(...CLOUD_FORMATS),
      ([x, y, z], q, captureTimeUs, latencyTest, saturated, sensor, format) => {
        const norm = Math.hypot(...q);
        const [qx, qy, qz, qw] = q.map((c) => c / norm) as [number, number, number, number];
        const pose = { position: { x, y, z }, orientation: { x: qx, y: qy, z: qz, w: qw } };
        const bytes = new Uint8Array(28);
        writePlacement(viewOf(bytes), 0, { pose, captureTimeUs, latencyTest, saturated, sensor, format });
        const into = emptyPlacement();
        expect(readPlacement(viewOf(bytes), into)).toBeNull();
        expect(into).toMatchObject({ captureTimeUs, latencyTest, saturated, sensor, format });
        expect(into.pose.position).toEqual({ x: Math.fround(x), y: Math.fround(y), z: Math.fround(z) });
        for (const axis of ['x', 'y', 'z', 'w'] as const) {
          const error = Math.abs(into.pose.orientation[axis] - pose.orientation[axis]);
          expect(error).toBeLessThanOrEqual(0.5 / 32_767 + 1e-12);
        }
      },
    ),
    { seed: 1, numRuns: 300 },
  );
});

test('a clock beyond 71.6 minutes wraps', () => {
  const bytes = new Uint8Array(28);
  writePlacement(viewOf(bytes), 0, { ...emptyPlacement(), captureTimeUs: 2 ** 32 + 5.9 });
  const into = emptyPlacement();
  readPlacement(viewOf(bytes), into);
  expect(into.captureTimeUs).toBe(5);
});

test('any bytes give a usable pose or a fault', () => {
  let accepted = 0;
  fc.assert(
    fc.property(
      fc.uint8Array({ maxLength: 40, size: 'max' }),
      fc.boolean(),
      fc.boolean(),
      (bytes, format, upright) => {
        if (format && bytes.length > 0) bytes[bytes.length - 1] = 1;
        if (upright && bytes.length >= 28) bytes.set([0, 0, 0, 0, 0, 0, 0xff, 0x7f], bytes.length - 16);
        const into = emptyPlacement();
        if (readPlacement(viewOf(bytes), into) !== null) return;
        accepted++;
        const { position, orientation } = into.pose;
        expect(Object.values(position).every(Number.isFinite)).toBe(true);
        expect(Math.hypot(...Object.values(orientation))).toBeCloseTo(1, 1);
      },
    ),
    { seed: 2, numRuns: 2000 },
  );
  expect(accepted).toBeGreaterThan(50);
});
