import { effect, signal } from '@preact/signals-core';
import { expect, it } from 'vitest';
import { steady } from './steady.ts';

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
