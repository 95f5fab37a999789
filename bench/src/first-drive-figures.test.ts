import type { DriveRow } from '@farpoint/webxr/drive-record';
import { expect, test } from 'vitest';
import { driveFigures } from './first-drive-figures.ts';

const row = (atMs: number, more: Partial<DriveRow> = {}): DriveRow => ({
  ...{ atMs, x: atMs / 1000, y: 0, drive: 'driving', factor: 1, reasons: [], seenMs: 80, viewMs: 80 },
  ...{ held: true, paused: false, letGoFirst: false },
  ...more,
});

test('what a guard holds counts for nothing, and every other stop is named', () => {
  const rows = [
    ...[row(0), row(100), row(200)],
    row(300, { reasons: ['obstacle-near'], factor: 0.5 }),
    row(400, { reasons: ['obstacle'], factor: 0, drive: 'blocked' }),
    row(500, { reasons: ['view-late', 'obstacle-near'], factor: 0.5, seenMs: 380 }),
    row(600, { drive: 'watchdog' }),
    row(700, { drive: 'idle', paused: true }),
    row(800, { held: false, drive: 'idle', seenMs: null }),
  ];
  expect(driveFigures({ rows, gripsLost: ['late-reading'], refusals: [] })).toEqual({
    ...{ metres: 0.8, heldS: 0.7, guardedS: 0.2, obeyedShare: 0.4, gripsLost: 1, refusals: 0 },
    viewAgeMs: { p50: 80, p95: 275 },
    whyNotS: { 'view-late': 0.1, watchdog: 0.1, 'grip-not-read': 0.1 },
  });
});
