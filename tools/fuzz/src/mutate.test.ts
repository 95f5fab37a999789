import { Random } from '@farpoint/network-sim/random';
import { expect, it } from 'vitest';
import { mutate } from './mutate.ts';

const seeds = [new Uint8Array(40).fill(7), Buffer.from('{"type":"x","value":12}'), new Uint8Array(0)];

it('gives the same inputs for the same seed, and others for another', () => {
  const list = (seed: number) => {
    const random = new Random(seed, 0);
    return Array.from({ length: 50 }, () => Buffer.from(mutate(seeds, random, 200)).toString('hex'));
  };
  expect(list(1)).toEqual(list(1));
  expect(list(1)).not.toEqual(list(2));
});

it('respects the limit, leaves the seeds alone, and changes lengths both ways', () => {
  const random = new Random(3, 0);
  const lengths = new Set<number>();
  for (let n = 0; n < 5000; n++) {
    const input = mutate(seeds, random, 64);
    expect(input.length).toBeLessThanOrEqual(64);
    expect(input.byteLength).toBe(input.buffer.byteLength);
    lengths.add(input.length);
  }
  expect(lengths.size).toBe(65);
  expect(seeds[0]).toEqual(new Uint8Array(40).fill(7));
});
