import { afterEach, beforeEach, expect } from 'vitest';

/**
 * For connections in tests: what to do after each of them, and a check that no promise was rejected unheard in between.
 * Call it at the top of a file.
 *
 * @returns add what is to be closed; the newest is closed first
 */
export function useCleanups(): (() => unknown)[] {
  const cleanups: (() => unknown)[] = [];
  const unhandled: unknown[] = [];
  const note = (reason: unknown) => unhandled.push(reason);
  beforeEach(() => {
    unhandled.length = 0;
    process.on('unhandledRejection', note);
  });
  afterEach(async () => {
    for (const cleanup of cleanups.splice(0).reverse()) await cleanup();
    process.off('unhandledRejection', note);
    expect(unhandled).toEqual([]);
  });
  return cleanups;
}
