import { LatencyError, type LatencyFailure, type LatencyReport } from '@farpoint/operator';
import fc from 'fast-check';
import { expect, test } from 'vitest';
import { latencyCsv } from './latency-csv.ts';
import { LatencyLog } from './latency-log.ts';
import { TEST_STAGES, testStages } from './test-stages.ts';

function reportOf(id: number): LatencyReport {
  return {
    ...{
      id,
      startedAtMs: 1000,
      mtpMs: 80,
      firstMs: 60,
      arrivedMs: 65,
      points: 9,
      totalPoints: 9,
      frameNumber: 4,
    },
    robot: {
      ...{ type: 'latencyFrame', id, frameNumber: 4, points: 9 },
      ...{ commandMs: 6015, captureMs: 6030 },
    },
  };
}

/** Runs the steps that the log asks for, one after another. */
class Bench {
  readonly outcomes: (LatencyFailure | null)[] = [];
  started = 0;
  waiting: (() => void) | null = null;
  readonly log = new LatencyLog({
    test: async () => {
      this.started++;
      const failure = this.outcomes.shift() ?? null;
      if (failure !== null) throw new LatencyError(failure);
      return reportOf(this.started);
    },
    offsetMs: () => 5000,
    now: () => 1000,
    epochMs: () => 0,
    after: (_, act) => {
      this.waiting = act;
    },
  });

  async settle(): Promise<void> {
    for (let i = 0; i < 10; i++) await Promise.resolve();
  }

  async pause(): Promise<void> {
    const act = this.waiting;
    this.waiting = null;
    act?.();
    await this.settle();
  }
}

test('a test is split into stages that add up to motion to photon', async () => {
  const { log } = new Bench();
  await log.once(1000);
  expect(log.entries.value.map(({ stages }) => stages)).toEqual([
    { commandMs: 15, waitMs: 15, cloudMs: 35, drawMs: 15 },
  ]);
});

test('stages that cannot be told are unknown, not invented', () => {
  const report = reportOf(1);
  expect(testStages({ ...report, robot: null }, 5000)).toBe(null);
  expect(testStages(report, null)).toBe(null);
  // By this comparison of the clocks the command arrived before it was sent.
  expect(testStages(report, 5100)).toBe(null);
  const ms = fc.double({ min: -1e6, max: 1e6, noNaN: true });
  fc.assert(
    fc.property(ms, ms, ms, ms, ms, (commandMs, captureMs, arrivedMs, mtpMs, offsetMs) => {
      const stages = testStages(
        { ...report, arrivedMs, mtpMs, robot: { ...report.robot!, commandMs, captureMs } },
        offsetMs,
      );
      if (stages === null) return;
      const sum = TEST_STAGES.reduce((sum, stage) => sum + stages[stage], 0);
      expect(sum).toBeCloseTo(mtpMs, 6);
    }),
    { seed: 22 },
  );
});

test('one test follows another until it is aborted; the one that runs still counts', async () => {
  const bench = new Bench();
  const { log } = bench;
  bench.outcomes.push(null, 'timeout', null);
  log.start();
  log.start();
  await bench.settle();
  for (let i = 0; i < 2; i++) await bench.pause();
  expect(bench.started).toBe(3);
  expect(log.entries.value.map(({ failure }) => failure)).toEqual([null, 'timeout', null]);
  expect(log.continuous.value).toBe(true);
  log.abort();
  await bench.pause();
  expect([bench.started, log.continuous.value]).toEqual([3, false]);
});

test('ends by itself when a further test would fail, too; a new run is not mixed with the old one', async () => {
  const bench = new Bench();
  bench.outcomes.push('no-lease');
  bench.log.start();
  await bench.settle();
  expect(bench.log.continuous.value).toBe(false);
  const stale = bench.waiting;
  bench.log.start();
  await bench.settle();
  stale?.();
  await bench.settle();
  expect(bench.started).toBe(2);
});

test('exports one row for each test, empty where nothing is known', async () => {
  const bench = new Bench();
  bench.outcomes.push(null, 'timeout');
  await bench.log.once(1000);
  await expect(bench.log.once(1000)).rejects.toThrow(LatencyError);
  const rows = latencyCsv(bench.log.entries.value).split('\r\n');
  expect(rows).toEqual([
    'time,test,mtp_ms,first_ms,arrived_ms,command_ms,wait_ms,cloud_ms,draw_ms,points,total_points,failure',
    '1970-01-01T00:00:00.000Z,1,80.000,60.000,65.000,15.000,15.000,35.000,15.000,9,9,',
    '1970-01-01T00:00:00.000Z,,,,,,,,,,,timeout',
    '',
  ]);
});
