import { expect, it } from 'vitest';
import { ReportedLimit } from './reported-limit.ts';

it('is the largest of the last 16 reports, in bits on the wire; the first three give no limit', () => {
  const limit = new ReportedLimit(1280);
  expect([1, 2, 3].map((report) => limit.add(report))).toEqual([null, null, null]);
  expect(limit.add(1200)).toBe(1280);
  for (let i = 0; i < 15; i++) expect(limit.add(600)).toBe(1280);
  expect(limit.add(600)).toBe(640);
});

it('does not sink if an operator reports what it was sent, frame by frame', () => {
  // As the reference system's bridge does: a frame's points over the time until the next frame began.
  const limit = new ReportedLimit(1280);
  let target = 10e6;
  for (let frame = 0; frame < 600; frame++) {
    const jitter = [0.9, 1.1, 1, 0.95, 1.05][frame % 5] as number;
    const points = target * (1200 / 1280) * jitter;
    target = limit.add(Math.min(points, 80e6)) ?? target;
  }
  expect(target).toBeGreaterThan(9e6);
});
