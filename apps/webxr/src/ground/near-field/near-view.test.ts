import { expect, test } from 'vitest';
import { nearView } from './near-view.ts';

const aged = (ageMs: number | null, heard = true) =>
  nearView({ sectors: [], ageMs: () => ageMs } as never, { nowMs: 0, offsetMs: null, heard });

test('what is old is shown as old, and then no longer', () => {
  expect(aged(null)).toBe(null);
  expect(aged(120)).toMatchObject({ stale: false });
  expect(aged(1001)).toMatchObject({ stale: true, ageMs: 1001 });
  expect(aged(3001)).toBe(null);
});
