import { describe, expect, it } from 'vitest';
import { ResendHistory } from './resend-history.ts';

describe('ResendHistory', () => {
  it('returns a packet once, while it is of use', () => {
    const history = new ResendHistory<string>(8);
    history.add(0xffff, 'a', 100, 33);
    expect(history.take(0xffff, 120)).toBe('a');
    expect(history.take(0xffff, 125)).toBeNull();
    expect(history.refusals).toEqual({ unknown: 0, 'too-late': 0, resent: 1 });
  });

  it('refuses a packet that would arrive after its successor', () => {
    const history = new ResendHistory<string>(8);
    history.add(1, 'a', 100, 33);
    expect(history.take(1, 133)).toBeNull();
    expect(history.refusals['too-late']).toBe(1);
  });

  it('forgets the oldest packets and never confuses two packets', () => {
    const history = new ResendHistory<string>(4);
    for (let sequence = 0; sequence < 6; sequence++) history.add(sequence, String(sequence), 0, 1000);
    expect([0, 1, 2, 5, 9].map((sequence) => history.take(sequence, 1))).toEqual([
      null,
      null,
      '2',
      '5',
      null,
    ]);
    expect(history.refusals.unknown).toBe(3);
  });

  it('requires a capacity that can mask a sequence number', () => {
    expect(() => new ResendHistory(1000)).toThrow(RangeError);
    expect(() => new ResendHistory(65_536)).toThrow(RangeError);
  });
});
