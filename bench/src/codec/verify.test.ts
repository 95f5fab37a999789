import { describe, expect, it } from 'vitest';
import type { BenchCloud } from './adapter.ts';
import { measureLoss } from './loss.ts';
import { verify } from './verify.ts';

function cloud(): BenchCloud {
  const frame = new Float32Array(100 * 4);
  const words = new Uint32Array(frame.buffer);
  for (let i = 0; i < 100; i++) {
    frame.set([i * 0.3, 0, 2], i * 4);
    words[i * 4 + 3] = 0xff00_0000 | i;
  }
  const valid = Uint32Array.from({ length: 100 }, (_, i) => i);
  return {
    name: 'line',
    width: 100,
    height: 1,
    intrinsics: null,
    frame,
    attribute: 'colour',
    depth: 'z',
    valid,
  };
}

function decoded(source: Uint32Array | null, shift = 0) {
  const metres = new Float64Array(300);
  const rgb = new Uint8Array(300);
  for (let i = 0; i < 100; i++) {
    metres.set([i * 0.3, 0, 2 + (i === 7 ? shift : 0)], i * 3);
    rgb[i * 3] = i;
  }
  return { points: 100, metres, rgb, source };
}

describe('verify', () => {
  it('finds no error in a copy, matched by identity or by position', () => {
    for (const source of [cloud().valid, null]) {
      const { worstM, colorPsnrDb, wrong } = verify(cloud(), decoded(source), 1e-4);
      expect(worstM).toBeLessThan(1e-5);
      expect([colorPsnrDb, wrong]).toEqual([source === null ? null : 99, 0]);
    }
  });

  it('finds a single wrong point, in millimetres and per square of its depth', () => {
    const result = verify(cloud(), decoded(cloud().valid, 0.02), 0.01);
    expect(result.depthErrorMm).toBeCloseTo(20, 6);
    expect(result.depthErrorMmPerZ2).toBeCloseTo(5, 6);
    expect(result.wrong).toBe(1);
  });

  it('measures colour noise', () => {
    const off = decoded(cloud().valid);
    off.rgb.forEach((value, i) => {
      off.rgb[i] = value + 1;
    });
    expect(verify(cloud(), off).colorPsnrDb).toBeCloseTo(20 * Math.log10(255), 6);
  });
});

describe('measureLoss', () => {
  it('loses a blob with any of its packets, and otherwise only what was in the lost packets', () => {
    const all = decoded(cloud().valid);
    let got = all;
    const run = {
      codec: 'test',
      setting: '',
      blob: false,
      encode() {},
      packetBytes: () => new Array<number>(100).fill(10),
      decode(packets: readonly number[]) {
        const metres = Float64Array.from(packets.flatMap((i) => [...all.metres.subarray(i * 3, i * 3 + 3)]));
        got = {
          points: packets.length,
          metres,
          rgb: new Uint8Array(packets.length * 3),
          source: Uint32Array.from(packets),
        };
      },
      decoded: () => got,
      [Symbol.dispose]() {},
    };
    const apart = measureLoss(cloud(), run, 100, 1e-4);
    expect(apart['20'].pointsLost).toBeGreaterThan(0.1);
    expect(apart['20'].pointsLost).toBeLessThan(0.3);
    expect(apart['20'].pointsWrong).toBe(0);
    const blob = measureLoss(cloud(), { ...run, blob: true }, 100, 1e-4);
    expect(blob['20'].pointsLost).toBe(1);
    expect(blob['1'].pointsLost).toBeCloseTo(1 - 0.99 ** 100, 0);
  });
});
