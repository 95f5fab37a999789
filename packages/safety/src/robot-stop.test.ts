import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { RobotStopSignal, type RobotStopState } from './robot-stop.ts';

const repeating = () => new RobotStopSignal({ silentMs: 500, steadyMs: 250 });

describe('a stop that repeats itself', () => {
  test('stops until it is heard, and until it has said go for long enough', () => {
    const signal = repeating();
    expect(signal.state(0)).toBe('unheard');
    signal.hear(false, 1000);
    expect(signal.state(1000)).toBe('settling');
    expect(signal.state(1249)).toBe('settling');
    expect(signal.state(1250)).toBe('go');
  });

  test('stops at once, when it says so, is silent or lost', () => {
    const signal = repeating();
    signal.hear(false, 0);
    expect(signal.state(500)).toBe('go');
    expect(signal.state(501)).toBe('silent');
    signal.hear(false, 600);
    expect(signal.state(849)).toBe('settling');
    expect(signal.state(850)).toBe('go');
    signal.lose();
    expect(signal.state(850)).toBe('lost');
    signal.hear(false, 900);
    expect(signal.state(900)).toBe('settling');
    signal.hear(true, 1300);
    expect(signal.state(1300)).toBe('pressed');
    signal.lose();
    expect(signal.state(9000)).toBe('pressed');
  });
});

test('a key speaks at changes only, and is remembered', () => {
  const key = new RobotStopSignal({ silentMs: null, steadyMs: 0, pressed: true });
  expect(key.state(1e9)).toBe('pressed');
  key.hear(false, 1e9);
  expect(key.state(1e9)).toBe('go');
  expect(key.state(1e12)).toBe('go');
  expect(() => new RobotStopSignal({ silentMs: 5, steadyMs: 0, pressed: true })).toThrow(RangeError);
});

const step = fc.record({
  waitMs: fc.constantFrom(0, 1, 20, 100, 249, 250, 251, 499, 500, 501, 2000),
  say: fc.constantFrom('go', 'go', 'go', 'stop', 'lose', 'nothing'),
});

test('whatever is heard and when: go needs a steady go without a gap', () => {
  let went = 0;
  fc.assert(
    fc.property(fc.array(step, { maxLength: 60 }), (steps) => {
      const signal = repeating();
      const heard: { atMs: number; say: string }[] = [];
      let nowMs = 0;
      const check = () => {
        if (signal.state(nowMs) !== 'go') return;
        went++;
        // Back from now: nothing but go, no gap, for 250 ms at least.
        let laterMs = nowMs;
        for (const { atMs, say } of heard.toReversed()) {
          expect(say).toBe('go');
          expect(laterMs - atMs).toBeLessThanOrEqual(500);
          laterMs = atMs;
          if (nowMs - atMs >= 250) return;
        }
        expect.unreachable('it has not said go for long enough');
      };
      for (const { waitMs, say } of steps) {
        nowMs += waitMs;
        check();
        if (say === 'nothing') continue;
        heard.push({ atMs: nowMs, say });
        if (say === 'lose') signal.lose();
        else signal.hear(say === 'stop', nowMs);
        const expected: Record<string, RobotStopState[]> = {
          stop: ['pressed'],
          lose: ['lost', 'pressed'],
          go: ['go', 'settling'],
        };
        expect(expected[say]).toContain(signal.state(nowMs));
        check();
      }
    }),
    { seed: 19, numRuns: 500 },
  );
  expect(went).toBeGreaterThan(100);
});
