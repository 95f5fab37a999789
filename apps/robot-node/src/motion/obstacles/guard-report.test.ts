import { expect, test } from 'vitest';
import { type GuardReport, guardHealth } from './guard-report.ts';

const camera = { name: 'Camera', ageMs: 31.234, silent: false, isExpected: true, grids: 9, lastMs: 1.21 };
const report: GuardReport = {
  ...{ state: 'on', driven: true, sensors: [camera], odometryAgeMs: 12, reason: null },
  ...{ collision: null, restarts: 0 },
};

test('tells each sensor, odometry, and why the motion is bounded', () => {
  const silent = { ...camera, name: '/scan', ageMs: Number.POSITIVE_INFINITY, silent: true };
  const { ok, detail } = guardHealth({
    ...report,
    ...{ sensors: [camera, silent], reason: 'sensor-silent', collision: 'free', restarts: 2 },
  });
  expect(ok).toBe(false);
  expect(detail).toEqual({
    ...{ state: 'on', reason: 'sensor-silent', odometryAgeMs: 12, collision: 'free', restarts: 2 },
    sensors: [
      { name: 'Camera', says: 'live', ageMs: 31.23, lastMs: 1.21 },
      { name: '/scan', says: 'silent', ageMs: null, lastMs: 1.21 },
    ],
  });
});

test('is well while every sensor that should gives something, and while the collision topic is heard', () => {
  expect(guardHealth(report).ok).toBe(true);
  const resting = { ...camera, silent: true, isExpected: false };
  expect(guardHealth({ ...report, driven: false, sensors: [resting] }).ok).toBe(true);
  for (const collision of ['free', 'bounded', 'silent'] as const)
    expect(guardHealth({ ...report, collision }).ok).toBe(collision !== 'silent');
});
