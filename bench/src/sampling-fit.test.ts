import { Points64Encoder } from '@farpoint/wasm-codec';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { describe, expect, test } from 'vitest';
import { chiSquareTail, depthWeights, SamplingFit, type WeightParameters } from './sampling-fit.ts';
import { hallCloud, validDepths } from './sampling-scene.ts';

describe('chiSquareTail', () => {
  test.each([
    // Critical values from standard tables.
    [3.841, 1, 0.05],
    [10.828, 1, 0.001],
    [5.991, 2, 0.05],
    [9.488, 4, 0.05],
    [30.144, 19, 0.05],
    [43.82, 19, 0.001],
  ])('of %d with %d degrees of freedom is %d', (x, degrees, tail) => {
    expect(chiSquareTail(x, degrees) / tail).toBeCloseTo(1, 2);
  });

  test('is 1 at zero and falls to 0', () => {
    expect(chiSquareTail(0, 7)).toBe(1);
    expect(chiSquareTail(1e4, 7)).toBe(0);
  });
});

describe('the WASM sampler on a large cloud', async () => {
  const codec = await loadCodecFromDisk();
  const cloud = hallCloud(60_000);
  const { depths, indices } = validDepths(cloud);
  const positions = new Int32Array(cloud.points);
  indices.forEach((index, position) => {
    positions[index] = position;
  });

  /** Draws with `drawn` weights and compares with `expected` ones. */
  function pValue(drawn: WeightParameters, expected: WeightParameters, count: number): number {
    using encoder = new Points64Encoder(codec, cloud.points);
    encoder.frameBits.set(new Uint32Array(cloud.frame.buffer));
    const fit = new SamplingFit(depths, depthWeights(depths, expected), count);
    for (let seed = 0; seed < 40; seed++) {
      encoder.sample({ points: cloud.points, count, seed, ...drawn });
      fit.add(encoder.chosen.map((index) => positions[index] as number));
    }
    return fit.pValue();
  }

  const paper = { lambda: 3, epsilon: 1e-6, nearDistance: 3.85 };
  test.each([
    [{ ...paper }, 8000],
    [{ ...paper, lambda: 0 }, 8000],
    [{ ...paper, lambda: 9, nearDistance: 0 }, 8000],
    [{ ...paper, lambda: 1.5, nearDistance: 1 }, 30_000],
    [{ ...paper, lambda: 3, nearDistance: 0 }, 45_000],
  ])('draws with %o the distribution it should', (parameters, count) => {
    expect(pValue(parameters, parameters, count)).toBeGreaterThan(0.001);
  });

  test('detects a slightly different distribution', () => {
    const wrong = { ...paper, lambda: 1.1, nearDistance: 0 };
    expect(pValue({ ...wrong, lambda: 1 }, wrong, 8000)).toBeLessThan(1e-4);
  });
});
