import { expect, it } from 'vitest';
import { figureAt } from './beside.ts';

it('finds the number at a path, and says so where there is none', () => {
  const result = { mtpMs: { p50: 52.1 }, list: [{ p50: 3 }], name: 'mtp' };
  expect(figureAt(result, 'mtpMs.p50')).toBe(52.1);
  expect(figureAt(result, 'list.0.p50')).toBe(3);
  for (const path of ['mtpMs', 'mtpMs.p95', 'name', 'mtpMs.p50.x'])
    expect(() => figureAt(result, path)).toThrow(path);
});
