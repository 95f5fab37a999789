import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { OptionsError, resolveOptions } from '@farpoint/service';
import { useFolder } from '@farpoint/service/testing/folder';
import { uselessFiles } from '@farpoint/service/testing/useless-files';
import { expect, test } from 'vitest';
import { directionOf } from './directions.ts';
import { program } from './options.ts';

const folder = useFolder();
const trace = join(folder, 'trace.csv');
writeFileSync(trace, 'time_s,capacity_mbps\n0,5\n0.1,0\n');

function read(...argv: string[]) {
  const resolved = resolveOptions(program, { argv, env: {} });
  if (resolved.action !== 'run') throw new Error(resolved.action);
  const { values } = resolved;
  return { up: directionOf(values, 'up').profile, down: directionOf(values, 'down').profile };
}

test('an option for both directions applies to each; one for a single direction takes precedence', () => {
  const { up, down } = read('--rate-mbps', '8', '--rtt-ms', '60', '--loss', '0.02', '--down-loss', '0');
  expect(up).toMatchObject({ delayMs: 30, loss: 0.02, queue: { ms: 100 } });
  expect(down).toMatchObject({ delayMs: 30, loss: 0 });
  expect(up.capacity).toEqual({ steps: [{ atMs: 0, mbps: 8 }], periodMs: null });
});

test('a trace for one direction replaces the rate of both', () => {
  const { up, down } = read('--rate-mbps', '8', '--up-trace', trace, '--outages', '1-2,5-5.5');
  expect(up.capacity.steps).toEqual([
    { atMs: 0, mbps: 5 },
    { atMs: 100, mbps: 0 },
  ]);
  expect(up.capacity.periodMs).toBe(200);
  expect(down.capacity.steps[0]?.mbps).toBe(8);
  expect(down.capacity.outages).toEqual([
    { startMs: 1000, endMs: 2000 },
    { startMs: 5000, endMs: 5500 },
  ]);
});

test('without options there is no bottleneck and no delay', () => {
  const { up } = read();
  expect(up).toMatchObject({ delayMs: 0, jitterMs: 0, loss: 0, burstLoss: null, duplicate: 0 });
  expect(up.capacity.steps[0]?.mbps).toBe(Number.POSITIVE_INFINITY);
});

test('steps, bursts and a queue of bytes', () => {
  const { up } = read(
    '--steps',
    '0:41.44,30:8',
    '--burst-loss',
    '0.02',
    '--burst-length',
    '4',
    '--queue-bytes',
    '9000',
  );
  expect(up.capacity.steps[1]).toEqual({ atMs: 30_000, mbps: 8 });
  expect(up.burstLoss).toMatchObject({ leave: 0.25, lossWhenBad: 1 });
  expect(up.queue).toEqual({ bytes: 9000 });
});

test.each([
  [['--rate-mbps', '8', '--trace', trace], 'exclude each other'],
  [['--trace', join(folder, 'none.csv')], 'cannot be read'],
  [['--outages', '5-4'], 'spans of seconds'],
  [['--steps', '1:5'], 'from second 0 on'],
  [['--loss', '2'], 'from 0 to 1'],
])('%j is refused', (argv, words) => {
  expect(() => read(...argv)).toThrow(OptionsError);
  expect(() => read(...argv)).toThrow(words);
});

test.each(uselessFiles())('a trace that is $what is refused', ({ path, words }) => {
  expect(() => read('--trace', path)).toThrow(OptionsError);
  expect(() => read('--trace', path)).toThrow(path);
  expect(() => read('--trace', path)).toThrow(words);
});
