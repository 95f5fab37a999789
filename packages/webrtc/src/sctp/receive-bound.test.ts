import { describe, expect, it } from 'vitest';
import { excessOf, type Fragment, type ReceivedState } from './receive-bound.ts';

const [LAST, FIRST] = [1, 2];

function fragment(tsn: number, length: number, flags = 0, streamId = 1): Fragment {
  return { tsn, streamId, flags, userData: { length } };
}

function holding(fragments: readonly Fragment[], lastTsn = 0): ReceivedState {
  const streams: Record<number, { reassembly: Fragment[] }> = {};
  for (const one of fragments) {
    streams[one.streamId] ??= { reassembly: [] };
    streams[one.streamId]!.reassembly.push(one);
  }
  return { streams, lastTsn };
}

/** The first fragments of one message, 1,000 bytes each. */
function begun(count: number, tsn = 1): Fragment[] {
  return Array.from({ length: count }, (_, n) => fragment((tsn + n) >>> 0, 1000, n === 0 ? FIRST : 0));
}

describe('excessOf', () => {
  it('keeps a message of the announced length, and the next one', () => {
    expect(excessOf(fragment(66, 536, LAST), holding(begun(65)))).toBeNull();
    const complete = [...begun(65), fragment(66, 536, LAST)];
    expect(excessOf(fragment(67, 1000, FIRST), holding(complete))).toBeNull();
    expect(excessOf(fragment(67, 1000), holding(complete))).toBeNull();
  });

  it('refuses a longer one before its end, also where the numbers wrap', () => {
    expect(excessOf(fragment(66, 537, LAST), holding(begun(65)))).toBe('message-too-large');
    const wrapping = holding(begun(65, 2 ** 32 - 10), 2 ** 32 - 11);
    expect(excessOf(fragment(55, 537), wrapping)).toBe('message-too-large');
    expect(excessOf(fragment(55, 536), wrapping)).toBeNull();
  });

  it('refuses more than 256 KiB of unfinished messages in all', () => {
    const held = Array.from({ length: 5 }, (_, n) => fragment(n + 1, 52_000, FIRST, n));
    expect(excessOf(fragment(6, 2000, FIRST, 9), holding(held))).toBeNull();
    expect(excessOf(fragment(6, 3000, FIRST, 9), holding(held))).toBe('sctp-overfull');
  });

  it('refuses fragments of a byte before there are many', () => {
    const held = Array.from({ length: 1024 }, (_, n) => fragment(2 * n + 2, 1));
    expect(excessOf(fragment(2051, 1), holding(held))).toBe('sctp-overfull');
    expect(excessOf(fragment(2051, 1), holding(held.slice(1)))).toBeNull();
  });

  it('refuses numbers far ahead, but not duplicates', () => {
    expect(excessOf(fragment(4096, 1, FIRST | LAST), holding([]))).toBeNull();
    expect(excessOf(fragment(4097, 1, FIRST | LAST), holding([]))).toBe('sctp-overfull');
    expect(excessOf(fragment(0, 1, FIRST | LAST), holding([], 100))).toBeNull();
  });

  it('refuses the 65th stream', () => {
    const held = Array.from({ length: 64 }, (_, n) => fragment(n + 1, 1, FIRST, n));
    expect(excessOf(fragment(65, 1, FIRST, 64), holding(held))).toBe('sctp-overfull');
    expect(excessOf(fragment(65, 1, FIRST, 63), holding(held))).toBeNull();
  });
});
