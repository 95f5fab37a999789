import fc from 'fast-check';
import { expect, test } from 'vitest';
import { KeyFrameGate } from './key-frame-gate.ts';

test('passes the first request on at once, and later ones together when their time has come', () => {
  const gate = new KeyFrameGate(2000);
  expect(gate.request(0, 100)).toBe(true);
  expect(gate.request(0, 200)).toBe(false);
  expect(gate.request(0, 300)).toBe(false);
  // Another video has a time of its own.
  expect(gate.request(1, 300)).toBe(true);
  expect(gate.due(2099)).toEqual([]);
  expect(gate.due(2100)).toEqual([0]);
  expect(gate.due(9000)).toEqual([]);
  expect(gate.requests).toBe(4);
});

test('a key frame that comes for another reason serves those who wait', () => {
  const gate = new KeyFrameGate(2000);
  gate.request(0, 0);
  gate.request(0, 10);
  gate.onKeyFrame(0, 1000);
  expect(gate.due(2000)).toEqual([]);
  expect(gate.request(0, 2999)).toBe(false);
  expect(gate.due(3000)).toEqual([0]);
});

test('however many ask, requests are at least an interval apart', () => {
  const steps = fc.array(fc.record({ afterMs: fc.nat(900), asks: fc.boolean() }), { maxLength: 200 });
  fc.assert(
    fc.property(steps, (each) => {
      const gate = new KeyFrameGate(1000);
      const passed: number[] = [];
      let nowMs = 0;
      for (const { afterMs, asks } of each) {
        nowMs += afterMs;
        if (asks && gate.request(0, nowMs)) passed.push(nowMs);
        else if (gate.due(nowMs).length > 0) passed.push(nowMs);
      }
      passed.forEach((at, i) => {
        if (i > 0) expect(at - (passed[i - 1] as number)).toBeGreaterThanOrEqual(1000);
      });
    }),
    { seed: 1 },
  );
});
