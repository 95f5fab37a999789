import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { ClientBacklog, type LiveMessage } from './client-backlog.ts';

const LIMITS = { bytes: 1000, messages: 10 };

function message(channel: number, ns: number, bytes = 10, link: LiveMessage['link'] = 'alone'): LiveMessage {
  return { channel, ns: BigInt(ns), bytes: new Uint8Array(bytes), link };
}

function rest(backlog: ClientBacklog): [channel: number, ns: number][] {
  const all: [number, number][] = [];
  for (let each = backlog.next(); each !== null; each = backlog.next())
    all.push([each.channel, Number(each.ns)]);
  return all;
}

describe('ClientBacklog', () => {
  it('drops the oldest of the channel that takes most', () => {
    const backlog = new ClientBacklog(LIMITS);
    backlog.push(message(1, 0, 50));
    for (let ns = 1; ns <= 3; ns++) backlog.push(message(2, ns, 400));
    expect(backlog.dropped).toBe(1);
    expect(backlog.bytes).toBe(850);
    expect(rest(backlog)).toEqual([
      [1, 0],
      [2, 2],
      [2, 3],
    ]);
    expect(backlog.bytes).toBe(0);
  });

  it('keeps a message that is larger than everything allowed, but only that', () => {
    const backlog = new ClientBacklog(LIMITS);
    backlog.push(message(1, 0, 5000));
    backlog.push(message(1, 1, 5000));
    expect(rest(backlog)).toEqual([[1, 1]]);
  });

  it('drops a video’s frames up to the next key frame, and asks for one if none waits', () => {
    const backlog = new ClientBacklog(LIMITS);
    const asked: number[] = [];
    backlog.onKeyNeeded = (channel) => asked.push(channel);
    backlog.push(message(1, 0, 300, 'key'));
    backlog.push(message(1, 1, 300, 'follows'));
    backlog.push(message(1, 2, 300, 'key'));
    backlog.push(message(1, 3, 300, 'follows'));
    expect(asked).toEqual([]);
    backlog.push(message(1, 4, 600, 'follows'));
    expect(asked).toEqual([1]);
    expect(backlog.dropped).toBe(5);
    backlog.push(message(1, 5, 10, 'follows'));
    backlog.push(message(1, 6, 10, 'key'));
    expect(rest(backlog)).toEqual([[1, 6]]);
  });

  it('begins a video with a key frame', () => {
    const backlog = new ClientBacklog(LIMITS);
    const asked: number[] = [];
    backlog.onKeyNeeded = (channel) => asked.push(channel);
    backlog.begin(1);
    backlog.push(message(1, 0, 10, 'follows'));
    expect(asked).toEqual([1]);
    backlog.push(message(1, 1, 10, 'key'));
    backlog.push(message(1, 2, 10, 'follows'));
    expect(rest(backlog)).toEqual([
      [1, 1],
      [1, 2],
    ]);
    expect(backlog.dropped).toBe(0);
  });

  it('forgets a channel', () => {
    const backlog = new ClientBacklog(LIMITS);
    backlog.push(message(1, 0));
    backlog.push(message(2, 1));
    backlog.forget(1);
    expect(backlog.bytes).toBe(10);
    expect(rest(backlog)).toEqual([[2, 1]]);
  });

  it('is bounded, in order, and loses nothing uncounted, whatever comes', () => {
    const step = fc.oneof(
      { weight: 4, arbitrary: fc.record({ channel: fc.nat(3), bytes: fc.nat(600), key: fc.boolean() }) },
      { weight: 1, arbitrary: fc.constant(null) },
    );
    fc.assert(
      fc.property(fc.array(step, { maxLength: 100 }), (steps) => {
        const backlog = new ClientBacklog(LIMITS);
        let refused = 0;
        const count = (before: number) => (backlog.messages + backlog.dropped === before ? 1 : 0);
        const taken: LiveMessage[] = [];
        let pushed = 0;
        steps.forEach((each, i) => {
          if (each === null) {
            const next = backlog.next();
            if (next !== null) taken.push(next);
            return;
          }
          // Channels 0 and 1 carry videos.
          const link = each.channel > 1 ? 'alone' : each.key ? 'key' : 'follows';
          const before = backlog.messages + backlog.dropped;
          backlog.push(message(each.channel, i, each.bytes, link));
          refused += count(before);
          pushed++;
          if (backlog.messages > 1) expect(backlog.bytes).toBeLessThanOrEqual(LIMITS.bytes);
          expect(backlog.messages).toBeLessThanOrEqual(LIMITS.messages);
        });
        for (let next = backlog.next(); next !== null; next = backlog.next()) taken.push(next);
        expect(taken.every(({ ns }, i) => i === 0 || ns > taken[i - 1]!.ns)).toBe(true);
        expect(taken.length + backlog.dropped + refused).toBe(pushed);
        expect(backlog.bytes).toBe(0);
      }),
    );
  });
});
