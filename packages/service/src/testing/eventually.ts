import { vi } from 'vitest';

/**
 * Resolves with what `is` gives once that is neither false, null nor undefined. How long it takes is the machine's
 * business: only the test's own limit ends it.
 */
export function eventually<T>(is: () => T | Promise<T>): Promise<Exclude<T, false | null | undefined>> {
  return vi.waitUntil(is, { timeout: 300_000, interval: 10 }) as Promise<
    Exclude<T, false | null | undefined>
  >;
}
