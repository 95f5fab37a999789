import fc from 'fast-check';
import { expect, test } from 'vitest';
import { DecodeGate } from './decode-gate.ts';

const INTERVAL = 3000;
const frame = (number: number, isKey = false, bytes = new Uint8Array()) => ({
  ...{ isKey, bytes, rtpTimestamp: (number * INTERVAL) >>> 0 },
});
const sps = (level: number) => Uint8Array.of(0, 0, 1, 0x67, 0x42, 0xe0, level, 0, 0, 1, 0x65, 0x88);
const reasonOf = (gate: DecodeGate, ...args: Parameters<DecodeGate['decide']>) => {
  const decision = gate.decide(...args);
  return decision.decode ? null : decision.reason;
};

test('begins with a key frame, and asks for one until it comes, twice a second at most', () => {
  const gate = new DecodeGate('VP8');
  expect(reasonOf(gate, frame(1), 0)).toBe('waits-for-key');
  expect([0, 100, 499, 500].map((ms) => gate.asksForKey(ms))).toEqual([true, false, false, true]);
  expect(gate.decide(frame(2, true), 0)).toEqual({
    ...{ decode: true, configure: 'vp8', isKey: true, ticks: 2 * INTERVAL },
  });
  expect(gate.asksForKey(5000)).toBe(false);
  expect(gate.decide(frame(3), 0)).toMatchObject({ decode: true, configure: null, isKey: false });
});

test('configures the decoder anew where the stream’s level changes', () => {
  const gate = new DecodeGate('H264');
  expect(gate.decide(frame(1, true, sps(0x1f)), 0)).toMatchObject({ configure: 'avc1.42e01f' });
  expect(gate.decide(frame(2, true, sps(0x1f)), 0)).toMatchObject({ configure: null, isKey: true });
  expect(gate.decide(frame(3, true, sps(0x28)), 0)).toMatchObject({ configure: 'avc1.42e028' });
});

test('what is called a key frame and has no parameter sets does not begin a stream', () => {
  const gate = new DecodeGate('H264');
  expect(reasonOf(gate, frame(1, true, Uint8Array.of(0, 0, 1, 0x65, 0x88)), 0)).toBe('waits-for-key');
});

test('a frame that comes after its successor ends decoding until the next key frame', () => {
  const gate = new DecodeGate('VP8');
  for (const number of [1, 2, 4]) gate.decide(frame(number, number === 1), 0);
  expect(reasonOf(gate, frame(3), 0)).toBe('out-of-order');
  expect(gate.asksForKey(0)).toBe(true);
  expect(reasonOf(gate, frame(5), 0)).toBe('waits-for-key');
  expect(gate.decide(frame(6, true), 0).decode).toBe(true);
  expect(gate.drops).toEqual({
    ...{ 'waits-for-key': 1, 'out-of-order': 1, 'decoder-busy': 0, 'decoder-failed': 0 },
  });
});

test('a decoder that has fallen behind, or failed, begins again with a key frame', () => {
  const gate = new DecodeGate('VP8');
  gate.decide(frame(1, true), 0);
  expect(gate.decide(frame(2), 5).decode).toBe(true);
  expect(reasonOf(gate, frame(3), 6)).toBe('decoder-busy');
  expect(reasonOf(gate, frame(4), 0)).toBe('waits-for-key');
  expect(gate.decide(frame(5, true), 0)).toMatchObject({ decode: true, configure: 'vp8' });
  gate.restart('failed');
  expect(reasonOf(gate, frame(6), 0)).toBe('waits-for-key');
  expect(gate.drops['decoder-failed']).toBe(1);
});

test('timestamps count on over their wrap', () => {
  const gate = new DecodeGate('VP8');
  const last = { ...frame(0, true), rtpTimestamp: 2 ** 32 - 1000 };
  expect(gate.decide(last, 0)).toMatchObject({ ticks: 2 ** 32 - 1000 });
  expect(gate.decide({ ...frame(0), rtpTimestamp: 2000 }, 0)).toMatchObject({ ticks: 2 ** 32 + 2000 });
});

test('the decoder gets frames in order, and none whose predecessor is missing because the gate dropped it', () => {
  const step = fc.record({ forward: fc.integer({ min: -2, max: 3 }), isKey: fc.boolean(), busy: fc.nat(7) });
  fc.assert(
    fc.property(fc.array(step, { maxLength: 60 }), (steps) => {
      const gate = new DecodeGate('VP8');
      let [number, before, whole] = [10, Number.NEGATIVE_INFINITY, false];
      for (const { forward, isKey, busy } of steps) {
        number += forward;
        const decision = gate.decide(frame(number, isKey), busy);
        if (decision.decode) {
          expect(isKey || whole).toBe(true);
          expect(decision.ticks).toBeGreaterThan(before);
          before = decision.ticks;
        }
        whole = decision.decode;
      }
    }),
  );
});
