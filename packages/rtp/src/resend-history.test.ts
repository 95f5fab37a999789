import { describe, expect, it } from 'vitest';
import { MOST_PACKET_BYTES, ResendHistory } from './resend-history.ts';

const text = (bytes: Uint8Array | null) => (bytes === null ? null : Buffer.from(bytes).toString());
const packet = (text: string) => [Buffer.from(text)];
const taken = (history: ResendHistory, sequence: number, nowMs: number) =>
  text(history.take(sequence, nowMs));

describe('ResendHistory', () => {
  it('returns a packet once, while it is of use', () => {
    const history = new ResendHistory(8);
    history.add(0xffff, [Buffer.from('head'), Buffer.from(''), Buffer.from('tail')], 100, 33);
    expect(taken(history, 0xffff, 120)).toBe('headtail');
    expect(taken(history, 0xffff, 125)).toBeNull();
    expect(history.refusals).toEqual({ unknown: 0, 'too-late': 0, resent: 1 });
  });

  it('refuses a packet that would arrive after its successor', () => {
    const history = new ResendHistory(8);
    history.add(1, packet('a'), 100, 33);
    expect(taken(history, 1, 133)).toBeNull();
    expect(history.refusals['too-late']).toBe(1);
  });

  it('forgets the oldest packets and never confuses two packets', () => {
    const history = new ResendHistory(4);
    for (let sequence = 0; sequence < 6; sequence++) history.add(sequence, packet(String(sequence)), 0, 1000);
    expect([0, 1, 2, 5, 9].map((sequence) => taken(history, sequence, 1))).toEqual([
      null,
      null,
      '2',
      '5',
      null,
    ]);
    expect(history.refusals.unknown).toBe(3);
  });

  it('knows nothing before the first packet', () => {
    expect(taken(new ResendHistory(4), 0, 0)).toBeNull();
  });

  it('copies: what is sent, and what is kept, may change afterwards', () => {
    const history = new ResendHistory(1);
    const given = Buffer.from('first');
    history.add(7, [given], 0, 1000);
    given.fill('x');
    const resent = history.take(7, 1);
    history.add(8, packet('other'), 2, 1000);
    expect(text(resent)).toBe('first');
  });

  it('keeps packets of any length up to that of Ethernet, and no longer one', () => {
    const history = new ResendHistory(4);
    const longest = Buffer.alloc(MOST_PACKET_BYTES, 1);
    for (const sequence of [0, 1, 2]) history.add(sequence, [longest], 0, 1000);
    history.add(3, packet('last'), 0, 1000);
    expect(history.take(2, 1)).toEqual(new Uint8Array(longest));
    expect(taken(history, 3, 1)).toBe('last');
    history.add(4, [longest, Buffer.alloc(1)], 0, 1000);
    // Neither it nor the one whose place it took.
    expect(history.take(4, 1)).toBeNull();
    expect(history.take(0, 1)).toBeNull();
  });

  it('requires a capacity that can mask a sequence number', () => {
    expect(() => new ResendHistory(1000)).toThrow(RangeError);
    expect(() => new ResendHistory(65_536)).toThrow(RangeError);
  });
});
