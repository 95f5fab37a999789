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

  test('sees every ring of a LiDAR, whose points come column by column', () => {
    const { colouring } = colouringAt(0);
    const revolution = points(Array.from({ length: 3200 }, (_, i) => [0, 0, 1 + (i % 16)]));
    for (let frame = 0; frame < 4; frame++) {
      colouring.beginFrame(0, 3200, frame * 200);
      colouring.sample(revolution, 0, 3200, 0);
    }
    colouring.update(1000);
    expect(colouring.scene.extent).toBe(16);
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

  test('lit and captured colours stand for no value, so no point is looked at', () => {
    const { colouring, uniforms } = colouringAt(0);
    colouring.mode = 'lit';
    colouring.beginFrame(0, 50, 0);
    colouring.sample(points(Array.from({ length: 50 }, () => [0, 0, 7])), 0, 50, 0);
    colouring.update(0);
    expect(uniforms.colourMode.value).toBe(6);
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

describe('rings', () => {
  /** A turn of a LiDAR: a wall all around, at a distance that changes with the direction. */
  function turn(elevations: readonly number[], columns: number): Int16Array {
    return points(
      elevations.flatMap((elevation) =>
        Array.from({ length: columns }, (_, column) => {
          const azimuth = (2 * Math.PI * column) / columns;
          const range = 6 + 3 * Math.sin(3 * azimuth);
          const across = range * Math.cos(elevation);
          return [
            across * Math.sin(azimuth),
            -range * Math.sin(elevation),
            across * Math.cos(azimuth),
          ] as const;
        }),
      ),
    );
  }
  const SIXTEEN = Array.from({ length: 16 }, (_, i) => ((i * 2 - 15) * Math.PI) / 180);

  test('are those that the robot knows', () => {
    const { colouring, uniforms } = colouringAt(1);
    colouring.mode = 'ring';
    colouring.update(0);
    expect(colouring.rings).toBeNull();
    expect(uniforms.ringScale.value.y).toBe(0);
    colouring.knownRings = SIXTEEN;
    colouring.update(1);
    expect(colouring.rings).toEqual({ elevations: SIXTEEN, from: 'robot' });
    expect(uniforms.colourMode.value).toBe(5);
    expect(uniforms.ringScale.value.x).toBeCloseTo((-16 * Math.PI) / 180, 9);
    expect(uniforms.ringMap.value.version).toBe(1);
    colouring.update(2);
    expect(uniforms.ringMap.value.version).toBe(1);
    colouring.knownRings = null;
    expect(colouring.rings).toBeNull();
  });

  test('of which the robot says nothing are found in the points, and keep their colours', () => {
    const { colouring, uniforms } = colouringAt(1);
    colouring.mode = 'ring';
    const cloud = turn(SIXTEEN, 900);
    const show = (turns: number) => {
      for (let i = 0; i < turns; i++) {
        colouring.beginFrame(0, cloud.length / 4, i * 100);
        colouring.sample(cloud, 0, cloud.length / 4, 0);
        colouring.update(i * 100);
      }
    };
    show(20);
    expect(colouring.rings?.from).toBe('points');
    expect(colouring.rings?.elevations).toHaveLength(16);
    for (const [i, elevation] of colouring.rings!.elevations.entries())
      expect(Math.abs(elevation - SIXTEEN[i]!)).toBeLessThan(0.001);
    const { version } = uniforms.ringMap.value;
    show(40);
    expect(uniforms.ringMap.value.version).toBe(version);
    colouring.forget();
    colouring.update(1);
    expect(colouring.rings).toBeNull();
  });

  test('are not sought in points too near for their coordinates', () => {
    const { colouring } = colouringAt(1);
    colouring.mode = 'ring';
    // 0.1 m away, in steps of a millimetre.
    const near = turn(SIXTEEN, 900).map((value, i) => (i % 4 === 3 ? 0 : Math.round(value / 60)));
    for (let i = 0; i < 40; i++) {
      colouring.beginFrame(0, near.length / 4, i);
      colouring.sample(near, 0, near.length / 4, 0);
    }
    colouring.update(1);
    expect(colouring.rings).toBeNull();
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
