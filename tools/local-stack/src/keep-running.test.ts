import { expect, test } from 'vitest';
import { keepRunning, type RunningProgram } from './keep-running.ts';
import type { Exit } from './managed-process.ts';

/** A program that ends when it is told to. */
class Program implements RunningProgram {
  end: (exit: Exit) => void = () => {};
  readonly exited = new Promise<Exit>((resolve) => {
    this.end = resolve;
  });
}

function bench(starts: (() => Program)[]) {
  const said: string[] = [];
  const stop = new AbortController();
  let nowMs = 0;
  let nextMs = 500;
  const first = new Program();
  const done = keepRunning(
    first,
    {
      start: async () => {
        const begin = starts.shift();
        if (begin === undefined) {
          stop.abort();
          throw new Error('no more');
        }
        return begin();
      },
      backoff: {
        nextMs: () => {
          nextMs *= 2;
          return nextMs / 2;
        },
        reset: () => {
          nextMs = 500;
        },
      },
      now: () => nowMs,
      wait: async (ms) => {
        nowMs += ms;
      },
      onEnd: (_program, { signal, code }, waitMs) => said.push(`ended ${signal ?? code}, ${waitMs}`),
      onFailure: (error, waitMs) => said.push(`${(error as Error).message}, ${waitMs}`),
      onStart: () => said.push(`up at ${nowMs}`),
    },
    stop.signal,
  );
  return { said, stop, first, done, pass: (ms: number) => (nowMs += ms) };
}

const settled = () => new Promise((resolve) => setImmediate(resolve));

test('a killed program is restarted, with growing delay while it does not last', async () => {
  const [second, third] = [new Program(), new Program()];
  const fail = () => {
    throw new Error('port taken');
  };
  const { said, stop, first, done, pass } = bench([() => second, fail, () => third]);
  first.end({ code: null, signal: 'SIGKILL' });
  await settled();
  second.end({ code: 1, signal: null });
  await settled();
  expect(said).toEqual([
    'ended SIGKILL, 500',
    'up at 500',
    'ended 1, 1000',
    'port taken, 2000',
    'up at 3500',
  ]);
  // The one that lasted is back soon.
  pass(10_000);
  third.end({ code: null, signal: 'SIGKILL' });
  await settled();
  expect(said.at(-1)).toBe('ended SIGKILL, 500');
  stop.abort();
  await done;
});

test('a program that ends after the stop is not restarted', async () => {
  const { said, stop, first, done } = bench([]);
  stop.abort();
  first.end({ code: 0, signal: null });
  await done;
  expect(said).toEqual([]);
});
