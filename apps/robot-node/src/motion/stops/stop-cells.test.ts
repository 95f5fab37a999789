import { expect, test } from 'vitest';
import { StopCells } from './stop-cells.ts';

test('carries the newest, and counts every stop, to another thread', () => {
  const written = new StopCells();
  const read = new StopCells(written.memory);
  expect(read.read(1000)).toBeNull();
  written.setPublishers(2);
  written.hear(true, 1000.7);
  written.hear(false, 1010);
  expect(read.read(1200)).toEqual({ stops: 1, stop: false, atMs: 1010, publishers: 2 });
});

test('is right when the clock has run for longer than 31 bits of milliseconds', () => {
  const cells = new StopCells();
  const atMs = 2 ** 31 + 5;
  cells.hear(false, atMs);
  expect(cells.read(atMs + 300)).toMatchObject({ atMs });
});
