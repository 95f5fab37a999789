import { computed, effect, signal } from '@preact/signals-core';
import { expect, it, test } from 'vitest';
import { Sampler, steady } from './sampler.ts';

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

it('changes with the value, and not with the object that holds it', () => {
  const source = signal<{ list: number[] } | null>({ list: [1] });
  const seen: unknown[] = [];
  const kept = steady(source);
  effect(() => {
    seen.push(kept.value);
  });
  source.value = { list: [1] };
  source.value = { list: [2] };
  source.value = null;
  source.value = null;
  expect(seen).toEqual([{ list: [1] }, { list: [2] }, null]);
});
