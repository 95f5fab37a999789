import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { ReplayWindow } from './replay-window.ts';

describe('ReplayWindow', () => {
  it('knows which of the last 64 were received, and counts everything older as received', () => {
    fc.assert(
      fc.property(fc.array(fc.nat(300), { maxLength: 200 }), fc.nat(300), (marked, asked) => {
        const window = new ReplayWindow();
        for (const sequence of marked) window.mark(sequence);
        const highest = Math.max(-1, ...marked);
        const isOld = highest - asked >= 64;
        expect(window.has(asked)).toBe(marked.includes(asked) || isOld);
      }),
      { seed: 1 },
    );
  });

  it('works at the end of the 48-bit range', () => {
    const window = new ReplayWindow();
    window.mark(2 ** 48 - 2);
    expect(window.has(2 ** 48 - 1)).toBe(false);
    expect(window.has(2 ** 48 - 2)).toBe(true);
    expect(window.has(2 ** 48 - 3)).toBe(false);
    expect(window.has(5)).toBe(true);
  });
});
