import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { type PacedFrame, PacketPacer } from './pacer.ts';

const MBIT = 1_000_000;

interface NumberedFrame extends PacedFrame {
  id: number;
}

/** 1250-byte packets: 10,000 bits each, so 1 ms apart at 10 Mbit/s. */
function frame(id: number, packets: number, minSpanMs?: number): NumberedFrame {
  return { id, packets, bytes: packets * 1250, ...(minSpanMs === undefined ? {} : { minSpanMs }) };
}

/** Exact timing: no packet is sent early. */
function exact(bitsPerSecond: number, options = {}) {
  return new PacketPacer<NumberedFrame>(bitsPerSecond, { factor: 1, burstMs: 0, ...options });
}

/** Wakes up exactly when asked to. @returns [frame id, packet, time] of every packet */
function drain(pacer: PacketPacer<NumberedFrame>, fromMs: number): [number, number, number][] {
  const sent: [number, number, number][] = [];
  let t = fromMs;
  while (pacer.nextDueMs !== null) {
    t = Math.max(t, pacer.nextDueMs);
    for (let run = pacer.due(t); run !== null; run = pacer.due(t)) {
      for (let i = 0; i < run.count; i++) sent.push([run.frame.id, run.first + i, t]);
    }
  }
  return sent;
}

test.each([
  ['evenly at the rate', exact(10 * MBIT), frame(1, 4), [0, 1, 2, 3]],
  ['faster by the factor', exact(8 * MBIT, { factor: 1.25 }), frame(1, 3), [0, 1, 2]],
  ['over the minimum span', exact(100 * MBIT), frame(1, 4, 20), [0, 5, 10, 15]],
  // Fewer wake-ups, and the same rate.
  [
    'together within a burst’s window',
    exact(40 * MBIT, { burstMs: 1 }),
    frame(1, 9),
    [0, 0, 0, 0, 1, 1, 1, 1, 2],
  ],
] as const)('packets leave %s', (_, pacer, whole, timesMs) => {
  pacer.enqueue(whole, 100);
  expect(drain(pacer, 100)).toEqual(timesMs.map((ms, i) => [1, i, 100 + ms]));
});

test('a burst has no more bytes than allowed, however high the rate and however late the wake-up', () => {
  const pacer = exact(400 * MBIT, { burstMs: 2.5, burstBytes: 64_000 });
  const long = frame(1, 300);
  const packetBytes = long.bytes / long.packets;
  pacer.enqueue(long, 0);
  const sent = [0, 5, 6].map((now) => {
    let bytes = 0;
    for (let run = pacer.due(now); run !== null; run = pacer.due(now)) bytes += run.count * packetBytes;
    return bytes;
  });
  expect(sent[0]).toBeCloseTo(64_000, -3.5);
  // What is caught up, and what is sent ahead.
  expect(sent[1]).toBeCloseTo(128_000, -3.5);
  expect(sent[2]).toBeLessThanOrEqual(64_000);
});

test('the next frame keeps its distance from the one before', () => {
  const pacer = exact(10 * MBIT);
  pacer.enqueue(frame(1, 2), 0);
  pacer.due(0);
  pacer.enqueue(frame(2, 2), 0);
  expect(drain(pacer, 0)).toEqual([
    [1, 1, 1],
    [2, 0, 2],
    [2, 1, 3],
  ]);
});

test('idle time is not caught up', () => {
  const pacer = exact(10 * MBIT);
  pacer.enqueue(frame(1, 1), 0);
  drain(pacer, 0);
  pacer.enqueue(frame(2, 3), 500);
  expect(drain(pacer, 500).map(([, , t]) => t)).toEqual([500, 501, 502]);
});

test('a late wake-up catches up 10 ms and no more', () => {
  const pacer = exact(10 * MBIT);
  pacer.enqueue(frame(1, 100), 0);
  pacer.due(0);
  // Those of 50 … 59 ms, then that of 60 ms.
  expect(pacer.due(60)).toMatchObject({ first: 1, count: 10 });
  expect(pacer.due(60)).toMatchObject({ first: 11, count: 1 });
  expect(pacer.due(60)).toBeNull();
  expect(pacer.nextDueMs).toBe(61);
});

test('a new rate applies from the next packet on; a rate of zero is a trickle', () => {
  const pacer = exact(10 * MBIT);
  pacer.enqueue(frame(1, 10), 0);
  pacer.due(0);
  pacer.setRate(1 * MBIT);
  pacer.due(1);
  expect(pacer.nextDueMs).toBe(11);
  pacer.setRate(0);
  pacer.due(11);
  expect(pacer.nextDueMs).toBe(111);
});

describe('a full queue', () => {
  test('a newer frame replaces one that has not begun', () => {
    const pacer = exact(10 * MBIT);
    expect(pacer.enqueue(frame(1, 2), 0)).toEqual([]);
    pacer.due(0);
    expect(pacer.enqueue(frame(2, 2), 0)).toEqual([]);
    expect(pacer.enqueue(frame(3, 2), 0)).toEqual([{ frame: frame(2, 2), reason: 'superseded', packets: 2 }]);
    expect(drain(pacer, 0).map(([id]) => id)).toEqual([1, 3, 3]);
    expect(pacer.drops).toEqual({ superseded: 1, overdue: 0, undecodable: 0, cleared: 0 });
  });

  test('a frame whose first packet must still wait has not begun', () => {
    const pacer = exact(1 * MBIT);
    pacer.enqueue(frame(1, 1), 0);
    pacer.due(0);
    pacer.enqueue(frame(2, 1), 1);
    expect(pacer.due(1)).toBeNull();
    expect(pacer.enqueue(frame(3, 1), 2)).toMatchObject([{ frame: { id: 2 }, reason: 'superseded' }]);
    expect(drain(pacer, 3)).toEqual([[3, 0, 10]]);
  });

  test('a frame that takes too long gives way to a newer one, but no earlier', () => {
    const pacer = exact(1 * MBIT, { maxFrameMs: 250 });
    pacer.enqueue(frame(1, 100), 0);
    pacer.due(0);
    pacer.due(10);
    pacer.enqueue(frame(2, 1), 249);
    expect(pacer.drops.overdue).toBe(0);
    expect(pacer.enqueue(frame(3, 1), 250)).toEqual([
      { frame: frame(1, 100), reason: 'overdue', packets: 98 },
      { frame: frame(2, 1), reason: 'superseded', packets: 1 },
    ]);
    expect(drain(pacer, 250).map(([id]) => id)).toEqual([3]);
  });

  test('clear returns the frames in progress and the waiting ones', () => {
    const pacer = exact(10 * MBIT);
    pacer.enqueue(frame(1, 3), 0);
    pacer.due(0);
    pacer.enqueue(frame(2, 3), 0);
    expect(pacer.clear()).toEqual([
      { frame: frame(1, 3), reason: 'cleared', packets: 2 },
      { frame: frame(2, 3), reason: 'cleared', packets: 3 },
    ]);
    expect(pacer.nextDueMs).toBeNull();
  });
});

test('for any frames and wake-ups: every packet once and in order or its frame dropped, within rate and queue', () => {
  const event = fc.record({
    dt: fc.double({ min: 0, max: 40, noNaN: true }),
    packets: fc.integer({ min: 0, max: 60 }),
    rate: fc.constantFrom(0, 1, 5, 20, 100),
  });
  fc.assert(
    fc.property(fc.array(event, { minLength: 1, maxLength: 60, size: 'max' }), (events) => {
      const pacer = new PacketPacer<NumberedFrame>(20 * MBIT, { factor: 1.1 });
      const frames = new Map<number, { packets: number; sent: number; dropped: number }>();
      let t = 0;
      let bits = 0;
      let allowance = 0;
      let fastest = 20;
      const wake = () => {
        for (let run = pacer.due(t); run !== null; run = pacer.due(t)) {
          const state = frames.get(run.frame.id) as { packets: number; sent: number; dropped: number };
          expect(run.first).toBe(state.sent);
          state.sent += run.count;
          expect(run.last).toBe(state.sent === state.packets);
          bits += run.count * 10_000;
        }
        if (pacer.nextDueMs !== null) expect(pacer.nextDueMs).toBeGreaterThan(t);
      };
      events.forEach(({ dt, packets, rate }, id) => {
        allowance += dt * Math.max(fastest, 0.1) * 1.1 * 1000;
        t += dt;
        wake();
        if (rate > 0) {
          pacer.setRate(rate * MBIT);
          fastest = Math.max(fastest, rate);
        }
        if (packets > 0) {
          frames.set(id, { packets, sent: 0, dropped: 0 });
          for (const drop of pacer.enqueue(frame(id, packets), t)) {
            (frames.get(drop.frame.id) as { dropped: number }).dropped += drop.packets;
          }
        }
        wake();
        // 10 ms of catching up, 1 ms of burst, one packet.
        expect(bits).toBeLessThanOrEqual(allowance + 11 * fastest * 1.1 * 1000 + 10_000 + 1);
        const open = [...frames.values()].filter((f) => f.sent + f.dropped < f.packets);
        expect(open.length).toBeLessThanOrEqual(2);
      });
      for (const drop of pacer.clear())
        (frames.get(drop.frame.id) as { dropped: number }).dropped += drop.packets;
      for (const state of frames.values()) expect(state.sent + state.dropped).toBe(state.packets);
    }),
    { seed: 7, numRuns: 500 },
  );
});

describe('lanes', () => {
  const inLane = (id: number, packets: number, lane: number) => ({ ...frame(id, packets), lane });

  test('a lower lane’s frame goes between the packets of a higher lane’s frame, which then continues', () => {
    const pacer = exact(10 * MBIT);
    pacer.enqueue(inLane(1, 4, 1), 0);
    const sent: number[] = [];
    for (let t = 0; pacer.nextDueMs !== null; t++) {
      if (t === 2) expect(pacer.enqueue(inLane(2, 2, 0), t)).toEqual([]);
      for (let run = pacer.due(t); run !== null; run = pacer.due(t)) sent.push(run.frame.id);
    }
    expect(sent).toEqual([1, 1, 2, 2, 1, 1]);
  });

  test('a frame gives way only to newer ones of its own lane', () => {
    const pacer = exact(10 * MBIT);
    pacer.enqueue(inLane(1, 4, 1), 0);
    expect(pacer.enqueue(inLane(2, 4, 0), 0)).toEqual([]);
    expect(pacer.enqueue(inLane(3, 4, 0), 0)).toMatchObject([{ frame: { id: 2 }, reason: 'superseded' }]);
    expect(pacer.enqueue(inLane(4, 4, 1), 0)).toMatchObject([{ frame: { id: 1 }, reason: 'superseded' }]);
    expect(new Set(drain(pacer, 0).map(([id]) => id))).toEqual(new Set([3, 4]));
  });

  test('all lanes share one rate, and clear empties all of them', () => {
    const pacer = exact(10 * MBIT);
    pacer.enqueue(inLane(1, 3, 1), 0);
    pacer.enqueue(inLane(2, 3, 0), 0);
    expect(drain(pacer, 0).map(([, , t]) => t)).toEqual([0, 1, 2, 3, 4, 5]);
    pacer.enqueue(inLane(3, 3, 1), 10);
    pacer.enqueue(inLane(4, 3, 0), 10);
    expect(pacer.clear()).toHaveLength(2);
    expect(pacer.nextDueMs).toBeNull();
  });
});

describe('frames that need the one before', () => {
  const video = (id: number, key = false): NumberedFrame => ({
    ...frame(id, 10),
    ...{ lane: -1, maxWaitingFrames: 3, maxSpanMs: 50, needsPrevious: !key },
  });

  test('wait for their turn in order', () => {
    const pacer = exact(10 * MBIT);
    for (const id of [1, 2, 3]) expect(pacer.enqueue(video(id), 0)).toEqual([]);
    expect(drain(pacer, 0).map(([id]) => id)).toEqual([1, 2, 3].flatMap((id) => new Array(10).fill(id)));
  });

  test('are dropped with it, up to the next that needs none', () => {
    const pacer = exact(10 * MBIT);
    for (const id of [1, 2]) pacer.enqueue(video(id), 0);
    pacer.enqueue(video(3, true), 0);
    const dropped = pacer.enqueue(video(4), 0);
    expect(dropped.map(({ frame: { id }, reason }) => [id, reason])).toEqual([
      [1, 'superseded'],
      [2, 'undecodable'],
    ]);
    expect(drain(pacer, 0).map(([id]) => id)).toEqual([3, 4].flatMap((id) => new Array(10).fill(id)));
    expect(pacer.drops).toEqual({ superseded: 1, overdue: 0, undecodable: 1, cleared: 0 });
  });

  test('are dropped with one that was cut off, the new one included', () => {
    const pacer = exact(MBIT);
    pacer.enqueue(video(1, true), 0);
    pacer.due(0);
    pacer.enqueue(video(2), 10);
    const dropped = pacer.enqueue(video(3), 60);
    expect(dropped.map(({ frame: { id }, reason }) => [id, reason])).toEqual([
      [1, 'overdue'],
      [2, 'undecodable'],
      [3, 'undecodable'],
    ]);
    expect(pacer.nextDueMs).toBeNull();
  });

  test('leave other lanes alone', () => {
    const pacer = exact(MBIT);
    pacer.enqueue({ ...frame(7, 2), lane: 0 }, 0);
    for (const id of [1, 2, 3, 4]) pacer.enqueue(video(id), 0);
    expect(drain(pacer, 0).map(([id]) => id)).toEqual([7, 7]);
  });
});
