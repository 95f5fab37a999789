import { intensityColour } from '@farpoint/cloud-formats';
import fc from 'fast-check';
import { Quaternion, Vector3 } from 'three';
import { describe, expect, test } from 'vitest';
import { PointColouring } from './point-colouring.ts';
import { createPointMaterial } from './point-material.ts';
import { intensityOf, turnedZ } from './point-values.ts';

/** An optical frame that looks ahead, 1 m above the world's origin. */
const AHEAD = [-0.5, 0.5, -0.5, 0.5] as const;

function colouringAt(height: number) {
  const { uniforms } = createPointMaterial();
  const colouring = new PointColouring(uniforms);
  uniforms.framePosition.value[0]!.set(0, 0, height, 0);
  uniforms.frameOrientation.value[0]!.set(...AHEAD);
  return { colouring, uniforms };
}

/** Points in the optical frame, metres, as int16 in steps of a millimetre. */
function points(all: readonly (readonly [x: number, y: number, z: number])[]): Int16Array {
  return Int16Array.from(all.flatMap((point) => [...point.map((value) => Math.round(value * 1000)), 0]));
}

describe('PointColouring', () => {
  test('follows the heights above the ground', () => {
    const { colouring, uniforms } = colouringAt(1.5);
    colouring.mode = 'height';
    colouring.ground = 0.5;
    colouring.beginFrame(0, 101, 0);
    // From 1 m above the sensor to 1 m below it; the optical y axis points down.
    colouring.sample(points(Array.from({ length: 101 }, (_, i) => [0.3, -1 + i / 50, 4])), 0, 101, 0);
    colouring.update(0);
    expect(colouring.range.min).toBeCloseTo(0, 1);
    expect(colouring.range.max).toBeCloseTo(2, 1);
    expect(uniforms.colourMode.value).toBe(1);
    expect(uniforms.colourRange.value.y).toBeCloseTo(0.5, 1);
  });

  test('looks at about 200 points of a frame, in whatever packets they come', () => {
    const { colouring } = colouringAt(0);
    colouring.mode = 'distance';
    colouring.beginFrame(0, 20_000, 0);
    const packet = points(Array.from({ length: 150 }, (_, i) => [0, 0, i < 75 ? 2 : 6]));
    for (let i = 0; i < 133; i++) colouring.sample(packet, 0, 150, 0);
    colouring.update(0);
    expect(colouring.range).toEqual({ min: 2, max: 6 });
  });

  test('a fixed range wins; another mode begins a new range', () => {
    const { colouring, uniforms } = colouringAt(0);
    colouring.mode = 'distance';
    colouring.fixedRange = { min: 1, max: 5 };
    colouring.update(0);
    expect(colouring.range).toEqual({ min: 1, max: 5 });
    expect(uniforms.colourRange.value.toArray()).toEqual([1, 0.25]);
    colouring.fixedRange = null;
    colouring.mode = 'intensity';
    colouring.update(1);
    expect(colouring.range).toEqual({ min: 0, max: 1 });
  });

  test('the cut moves with the ground', () => {
    const { colouring, uniforms } = colouringAt(0);
    colouring.update(0);
    expect(uniforms.heightCut.value.x).toBeLessThan(-1e20);
    expect(uniforms.heightCut.value.y).toBeGreaterThan(1e20);
    colouring.cut = { below: -0.25, above: 1.75 };
    colouring.ground = 3;
    colouring.update(1);
    expect(uniforms.heightCut.value.toArray()).toEqual([2.75, 4.75]);
  });

  test('the newest frame does not dim before the next one is due', () => {
    const { colouring, uniforms } = colouringAt(0);
    colouring.mode = 'age';
    for (let frame = 0; frame < 100; frame++) colouring.beginFrame(frame % 2, 1000, frame * 50);
    colouring.update(99 * 50 + 40);
    expect(colouring.range.min).toBeCloseTo(0.05, 3);
    expect(colouring.range.max).toBeCloseTo(0.15, 3);
    expect(uniforms.frameAge.value[1]).toBeCloseTo(0.04, 6);
    expect(uniforms.frameAge.value[0]).toBeCloseTo(0.09, 6);
  });
});

describe('values of points', () => {
  test('the colour that stands for an intensity gives it back, within what 16 bits keep', () => {
    for (let level = 0; level <= 1; level += 1 / 64) {
      const rgb = intensityColour(level);
      const packed =
        (((rgb & 255) >> 2) << 10) | ((((rgb >> 8) & 255) >> 2) << 4) | (((rgb >> 16) & 255) >> 4);
      expect(Math.abs(intensityOf(packed) - level)).toBeLessThan(0.03);
    }
  });

  test('turnedZ is the z of the turned vector', () => {
    const part = fc.double({ min: -1, max: 1, noNaN: true });
    fc.assert(
      fc.property(part, part, part, part, part, (a, b, c, x, y) => {
        const q = new Quaternion(a, b, c, 0.5).normalize();
        expect(turnedZ(q, x, y, 2)).toBeCloseTo(new Vector3(x, y, 2).applyQuaternion(q).z, 9);
      }),
      { seed: 3 },
    );
  });
});
