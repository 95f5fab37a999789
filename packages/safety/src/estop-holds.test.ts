/** The emergency stop as stops at the robot hold it. */
import { robotStops } from '@farpoint/protocol';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { makeGuard } from './testing/driven-guard.ts';

describe('a stop at the robot', () => {
  test('is released by nobody else, and tells every operator so', () => {
    const guard = makeGuard();
    guard.onOpenHand('a');
    guard.requestLease('a', false, 0);
    expect(guard.holdEstop('gpio')).toBe(true);
    expect(guard.holdEstop('gpio')).toBe(false);
    expect(guard.estopState()).toEqual({
      ...{ type: 'estop', latched: true, by: 'robot', latch: 1, releasedAt: 'robot' },
    });
    for (const supervises of [false, true])
      expect(guard.releaseEstop('a', supervises, 1)).toEqual({
        released: false,
        reason: 'held-at-robot',
      });
    expect(guard.letGoEstop('key')).toBe(false);
    expect(guard.letGoEstop('gpio')).toBe(true);
    expect(guard.estopState()).toEqual({ type: 'estop', latched: false, latch: 1 });
  });

  test.each([
    ['operator', 'operator'],
    ['robot', 'robot'],
  ] as const)('leaves a latch by the %s, which is released as ever', (by, left) => {
    const guard = makeGuard();
    guard.onOpenHand('a');
    guard.requestLease('a', false, 0);
    guard.holdEstop('shm');
    guard.latchEstop(by, 'a');
    expect(guard.estopKeptFor).toBe(left);
    guard.letGoEstop('shm');
    expect(guard.estopState()).toMatchObject({ latched: true, by: left });
    expect(guard.estopState().releasedAt).toBeUndefined();
    expect(guard.releaseEstop('a')).toEqual({ released: true });
  });

  test('leaves a latch that was there before', () => {
    const guard = makeGuard();
    guard.latchEstop('operator', 'a');
    guard.holdEstop('key');
    expect(guard.estopState()).toMatchObject({ by: 'operator', releasedAt: 'robot' });
    guard.letGoEstop('key');
    expect(guard.estopState()).toMatchObject({ latched: true, by: 'operator' });
  });

  test('alone is not kept for anybody over a restart', () => {
    const guard = makeGuard();
    guard.holdEstop('key');
    expect(guard.estopKeptFor).toBeNull();
    expect([...guard.estopHolders]).toEqual(['key']);
  });
});

const who = fc.constantFrom('a', 'b');
const step = fc.oneof(
  fc.record({ kind: fc.constantFrom('hold', 'let-go'), stop: fc.constantFrom(...robotStops), by: who }),
  fc.record({
    ...{ kind: fc.constantFrom('latch', 'latch-by-robot', 'release', 'supervise', 'gone', 'lease') },
    ...{ stop: fc.constant('key' as const), by: who },
  }),
);

test('whatever is pressed and asked: latched while anything holds it, and until all else is released', () => {
  const outcomes = new Set<string>();
  fc.assert(
    fc.property(fc.array(step, { maxLength: 60 }), (steps) => {
      const guard = makeGuard();
      const held = new Set<string>();
      let asked = false;
      let nowMs = 0;
      for (const { kind, stop, by } of steps) {
        nowMs += 10;
        if (kind === 'hold') {
          expect(guard.holdEstop(stop)).toBe(!held.has(stop));
          held.add(stop);
        } else if (kind === 'let-go') {
          expect(guard.letGoEstop(stop)).toBe(held.delete(stop));
        } else if (kind === 'latch' || kind === 'latch-by-robot') {
          if (kind === 'latch') guard.latchEstop('operator', by);
          else guard.latchEstop('robot');
          asked = true;
        } else if (kind === 'lease') guard.requestLease(by, true, nowMs, true);
        else if (kind === 'gone') guard.operatorGone(by);
        else {
          const outcome = guard.releaseEstop(by, kind === 'supervise');
          if (held.size > 0) expect(outcome.released).toBe(false);
          if (kind === 'supervise') expect(outcome.released).toBe(asked && held.size === 0);
          if (outcome.released) asked = false;
          outcomes.add(outcome.released ? 'released' : outcome.reason);
        }
        const state = guard.estopState();
        expect(state.latched).toBe(asked || held.size > 0);
        expect(state.releasedAt === 'robot').toBe(held.size > 0);
        if (state.latched) expect(guard.state(nowMs)).toBe('estop');
      }
    }),
    { seed: 7, numRuns: 500 },
  );
  expect(outcomes).toEqual(new Set(['released', 'held-at-robot', 'not-latched', 'not-lease-holder']));
});
