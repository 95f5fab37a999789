import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { READER_SILENT_MS, ReaderWatch } from './reader-watch.ts';

const PERIOD_MS = 40;

/** Writes every 40 ms from this counter on. @param echoOf what the reader has answered by then */
function write(watch: ReaderWatch, count: number, echoOf: (counter: number) => number, first = 0): number {
  let nowMs = 0;
  for (let i = 0; i < count; i++) {
    nowMs = i * PERIOD_MS;
    watch.note(echoOf(first + i) & 0xff, first + i, nowMs);
  }
  return nowMs;
}

describe('ReaderWatch', () => {
  it('hears a reader that follows the counter, over the wrap of its lowest byte', () => {
    const watch = new ReaderWatch(true);
    expect(watch.isSilent(0)).toBe(true);
    for (const first of [0, 250, -3, 2 ** 31 - 3]) {
      const nowMs = write(watch, 10, (counter) => counter - 1, first);
      expect(watch.isSilent(nowMs)).toBe(false);
    }
  });

  it('misses a reader that has answered and stops, for ever', () => {
    for (const required of [true, false]) {
      const watch = new ReaderWatch(required);
      const heardMs = write(watch, 10, (counter) => counter - 1);
      expect(watch.isSilent(heardMs + READER_SILENT_MS)).toBe(false);
      // The byte comes near the counter again every 256 writes.
      for (let i = 10; i < 1000; i++) {
        const nowMs = i * PERIOD_MS;
        watch.note(8, i, nowMs);
        expect(watch.isSilent(nowMs)).toBe(nowMs - heardMs > READER_SILENT_MS);
      }
    }
  });

  it('does not ask for an answer from a reader that has never answered, unless it is required', () => {
    fc.assert(
      fc.property(fc.integer({ min: 0, max: 255 }), fc.integer(), (byte, first) => {
        const [optional, required] = [new ReaderWatch(false), new ReaderWatch(true)];
        expect(optional.isSilent(write(optional, 600, () => byte, first))).toBe(false);
        expect(required.isSilent(write(required, 600, () => byte, first))).toBe(true);
      }),
      { seed: 7, numRuns: 50 },
    );
  });

  it('takes a byte that changes without following the counter for nothing', () => {
    const watch = new ReaderWatch(true);
    expect(watch.isSilent(write(watch, 100, (counter) => counter + 100 + (counter % 50)))).toBe(true);
  });
});
