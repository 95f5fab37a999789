import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { PendingSignIns, SIGN_IN_TIME_MS } from './pending-sign-ins.ts';

const pending = (nonce: string) => ({
  request: { key: 'k'.repeat(43), return: 'https://teleop.example/', state: null },
  ...{ nonce, verifier: 'v' },
});

describe('sign-ins that have begun', () => {
  it('are finished once, by the browser that began them', () => {
    const all = new PendingSignIns(4);
    all.add('s', 'mine', pending('n'), 0);
    expect(all.take('s', 'another', 1)).toEqual({ outcome: 'other-browser' });
    expect(all.take('s', null, 1)).toEqual({ outcome: 'other-browser' });
    expect(all.take('t', 'mine', 1)).toEqual({ outcome: 'unknown' });
    expect(all.take('s', 'mine', 1)).toEqual({ outcome: 'found', pending: pending('n') });
    expect(all.take('s', 'mine', 1)).toEqual({ outcome: 'unknown' });
  });

  it('expire, and are forgotten when others begin', () => {
    const all = new PendingSignIns(4);
    all.add('old', 'b', pending('n'), 0);
    expect(all.take('old', 'b', SIGN_IN_TIME_MS)).toMatchObject({ outcome: 'expired' });
    all.add('old', 'b', pending('n'), 0);
    all.add('new', 'b', pending('n'), SIGN_IN_TIME_MS);
    expect([all.size, all.take('old', 'b', SIGN_IN_TIME_MS).outcome]).toEqual([1, 'unknown']);
  });

  it('are bounded: the oldest is dropped', () => {
    fc.assert(
      fc.property(fc.integer({ min: 1, max: 8 }), fc.integer({ min: 0, max: 30 }), (most, count) => {
        const all = new PendingSignIns(most);
        for (let i = 0; i < count; i++) all.add(`s${i}`, 'b', pending(`n${i}`), i);
        expect(all.size).toBe(Math.min(most, count));
        for (let i = 0; i < count; i++)
          expect(all.take(`s${i}`, 'b', count).outcome).toBe(i < count - most ? 'unknown' : 'found');
      }),
    );
  });
});
