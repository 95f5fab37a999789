import { computed, effect } from '@preact/signals-core';
import { expect, test } from 'vitest';
import { Sampler } from './sampler.ts';

test('reads its sources at each sample, also at two samples with the same time', () => {
  const samples = new Sampler();
  let kept = 'a';
  const seen: string[] = [];
  const value = samples.of((atMs) => `${kept} ${atMs}`);
  effect(() => {
    seen.push(value.value);
  });
  kept = 'b';
  expect(value.value).toBe('a 0');
  samples.take(5);
  kept = 'c';
  samples.take(5);
  expect(seen).toEqual(['a 0', 'b 5', 'c 5']);
  expect(samples.atMs.value).toBe(5);
});

test('notifies readers only of changes, and reads nothing without a reader', () => {
  const samples = new Sampler();
  let reads = 0;
  const value = samples.of(() => {
    reads++;
    return 'same';
  });
  samples.take(1);
  expect(reads).toBe(0);
  let runs = 0;
  const long = computed(() => value.value.length);
  effect(() => {
    runs += long.value > 0 ? 1 : 0;
  });
  samples.take(2);
  samples.take(3);
  expect([reads, runs]).toEqual([3, 1]);
});
