import { truncateSync } from 'node:fs';
import { join } from 'node:path';
import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { MappedFile } from './mapped-file.ts';
import { ADDON_SUITE, scratchFolder } from './testing/helpers.ts';
import { Watch, type WatchOutcome } from './watch.ts';

let folder: string;
let path: string;
let file: MappedFile;
let watch: Watch | null = null;
beforeEach(() => {
  folder = scratchFolder();
  path = join(folder, 'file');
  if (!ADDON_SUITE.skip) file = MappedFile.open(path, { bytes: 16, create: true });
});
afterEach(() => {
  watch?.close();
  file?.close();
});

function watchOutcomes(futex: boolean) {
  const outcomes: WatchOutcome[] = [];
  const waiting: ((outcome: WatchOutcome) => void)[] = [];
  watch = new Watch(file, { offset: 8, futex }, (outcome) => {
    const next = waiting.shift();
    if (next === undefined) outcomes.push(outcome);
    else next(outcome);
  });
  const next = (): Promise<WatchOutcome> => {
    const come = outcomes.shift();
    return come === undefined ? new Promise((resolve) => waiting.push(resolve)) : Promise.resolve(come);
  };
  return { watch, next, outcomes };
}

describe.skipIf(ADDON_SUITE.skip)(`watch (${ADDON_SUITE.note})`, () => {
  describe.each([true, false])('futex: %s', (futex) => {
    it('reports an earlier change, and one that happens later', async () => {
      const { watch, next } = watchOutcomes(futex);
      file.store8(8, 5);
      watch.arm({ value: 0, timeoutMs: 60_000 });
      expect(await next()).toBe('changed');
      watch.arm({ value: 5, quietMs: futex ? 0 : 2, timeoutMs: 60_000 });
      setImmediate(() => {
        file.store8(8, 6);
        file.wake(8);
      });
      expect(await next()).toBe('changed');
    });

    it('reports once each time it is armed, and nothing without a change', async () => {
      const { watch, next, outcomes } = watchOutcomes(futex);
      watch.arm({ value: 0, timeoutMs: 3 });
      expect(await next()).toBe('timeout');
      file.store8(8, 9);
      file.wake(8);
      watch.arm({ value: 9, timeoutMs: 3 });
      expect(await next()).toBe('timeout');
      expect(outcomes).toEqual([]);
    });

    it('survives truncation of the file while it waits', async () => {
      const { watch, next } = watchOutcomes(futex);
      watch.arm({ value: 0, timeoutMs: 60_000 });
      truncateSync(path, 0);
      expect(await next()).toBe('fault');
    });
  });

  it('is silent once closed', async () => {
    const { watch, outcomes } = watchOutcomes(true);
    watch.arm({ value: 0, timeoutMs: 60_000 });
    file.store32(8, 1);
    file.wake(8);
    watch.close();
    await new Promise((resolve) => setImmediate(resolve));
    expect(outcomes).toEqual([]);
    watch.arm({ value: 0, timeoutMs: 1 });
    watch.close();
  });
});
