import { expect, it } from 'vitest';
import { sensorRows } from './sensor-rows.ts';

const latency = { p50: 40.04, p95: 60, p99: 70, max: 90 };
const NAMED = [{ name: 'Camera' }, { name: 'LiDAR' }];

it('counts what a run added, and shares by packets', () => {
  const before = [{ frames: 100, points: 1e6, packets: 9000, frameLatencyMs: null }];
  const after = [
    { frames: 400, points: 4e6, packets: 12_000, frameLatencyMs: latency },
    { frames: 100, points: 1e6, packets: 1000, frameLatencyMs: latency },
  ];
  expect(sensorRows(NAMED, after, before, 10)).toEqual([
    {
      name: 'Camera',
      pointsPerFrame: 10_000,
      framesPerSecond: 30,
      frameLatencyMs: { ...latency, p50: 40 },
      share: 0.75,
    },
    {
      name: 'LiDAR',
      pointsPerFrame: 10_000,
      framesPerSecond: 10,
      frameLatencyMs: { ...latency, p50: 40 },
      share: 0.25,
    },
  ]);
});

it('begins anew where the session did', () => {
  const before = [{ frames: 100, points: 1e6, packets: 9000, frameLatencyMs: null }];
  const [row] = sensorRows(
    [],
    [{ frames: 50, points: 5000, packets: 10, frameLatencyMs: latency }],
    before,
    10,
  );
  expect(row).toMatchObject({ name: 'Camera', pointsPerFrame: 100, framesPerSecond: 5, share: 1 });
});
