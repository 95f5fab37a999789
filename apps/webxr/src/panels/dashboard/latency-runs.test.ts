import { LatencyError, type LatencyFailure, type LatencyReport } from '@farpoint/operator';
import { expect, test } from 'vitest';
import { lastTestWords, latencyCsv, testsWords } from '../../words/latency-words.ts';
import { LatencyRuns, MOST_ENDS, PAUSE_MS } from './latency-runs.ts';

function reportOf(id: number): LatencyReport {
  const times = { startedAtMs: 1000, mtpMs: 80 + id, firstMs: 60, arrivedMs: 65 };
  return { ...times, id, points: 9, totalPoints: 10, frameNumber: 4, robot: null };
}

/** Runs the steps that the runs ask for, one after another. */
class Bench {
  readonly outcomes: (LatencyFailure | null)[] = [];
  readonly pauses: number[] = [];
  started = 0;
  waiting: (() => void) | null = null;
  readonly runs = new LatencyRuns({
    test: () => {
      this.started++;
      const failure = this.outcomes.shift() ?? null;
      return failure === null
        ? Promise.resolve(reportOf(this.started))
        : Promise.reject(new LatencyError(failure));
    },
    now: () => 1000,
    epochMs: () => 0,
    after: (ms, act) => {
      this.pauses.push(ms);
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

test('one test follows another half a second after it, until it is aborted; the one that runs still counts', async () => {
  const bench = new Bench();
  const { runs } = bench;
  bench.outcomes.push(null, 'timeout', null);
  runs.start();
  runs.start();
  await bench.settle();
  for (let i = 0; i < 2; i++) await bench.pause();
  expect(bench.started).toBe(3);
  expect(bench.pauses).toEqual([PAUSE_MS, PAUSE_MS, PAUSE_MS]);
  expect(runs.ends.value.map(({ failure }) => failure)).toEqual([null, 'timeout', null]);
  expect(runs.continuous.value).toBe(true);
  runs.abort();
  await bench.pause();
  expect([bench.started, runs.continuous.value]).toEqual([3, false]);
});

test('ends by itself when a further test would fail, too; a new run is not mixed with the old one', async () => {
  const bench = new Bench();
  bench.outcomes.push(null, 'no-lease');
  bench.runs.start();
  await bench.settle();
  const stale = bench.waiting;
  await bench.pause();
  expect(bench.runs.continuous.value).toBe(false);
  bench.runs.start();
  await bench.settle();
  stale?.();
  await bench.settle();
  expect(bench.started).toBe(3);
});

test('a test that another one keeps from starting is no result', async () => {
  const bench = new Bench();
  bench.outcomes.push('busy');
  expect(await bench.runs.single()).toBe(true);
  expect(bench.runs.ends.value).toEqual([]);
});

test('keeps the last 100, and their percentiles', async () => {
  const { runs } = new Bench();
  for (let i = 0; i < MOST_ENDS + 10; i++) await runs.single();
  expect(runs.ends.value).toHaveLength(MOST_ENDS);
  expect(runs.ends.value[0]?.report?.id).toBe(11);
  expect(runs.distribution()).toMatchObject({ p50: 80 + 60, p95: 80 + 105 });
});

test('says what became of the last test, and how all are distributed', async () => {
  const bench = new Bench();
  const { runs } = bench;
  expect(lastTestWords(runs.ends.value.at(-1))).toBe('Motion to photon: not measured yet');
  expect(testsWords(runs.ends.value, runs.distribution())).toBe('');
  await runs.single();
  expect(lastTestWords(runs.ends.value.at(-1))).toBe('Motion to photon: 81 ms, first points 60 ms');
  bench.outcomes.push('timeout');
  await runs.single();
  expect(lastTestWords(runs.ends.value.at(-1))).toBe('Motion to photon: no green cloud arrived');
  const words = testsWords(runs.ends.value, runs.distribution());
  expect(words).toBe('Last 2 tests, 1 failed: median 81 ms, 95 of 100 within 81 ms');
});

test('exports one row for each test, empty where nothing is known, and the percentiles', async () => {
  const bench = new Bench();
  bench.outcomes.push(null, 'timeout');
  await bench.runs.single();
  await bench.runs.single();
  expect(latencyCsv(bench.runs.ends.value, bench.runs.distribution()).split('\r\n')).toEqual([
    'time,test,mtp_ms,first_ms,arrived_ms,points,total_points,failure',
    '1970-01-01T00:00:00.000Z,1,81.000,60.000,65.000,9,10,',
    '1970-01-01T00:00:00.000Z,,,,,,,timeout',
    'p50,,81.000,,,,,',
    'p95,,81.000,,,,,',
    '',
  ]);
});
