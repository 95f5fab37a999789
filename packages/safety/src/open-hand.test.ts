/** Only a hand that has said that it is open moves the robot: at the beginning, after others, and after an emergency stop. */
import { type Command, NO_LEASE, zeroTwist } from '@farpoint/protocol';
import { describe, expect, test } from 'vitest';
import { commandOf, makeGuard } from './testing/driven-guard.ts';

const GAP_MS = 400;

function setUp() {
  const guard = makeGuard({ takePolicy: 'always', letGoAfterMs: GAP_MS });
  let sequence = 0;
  const leaseOf = (by: string) => guard.leaseState(by).lease ?? NO_LEASE;
  /** A command at that time. @returns why it was refused; `null` if it was not */
  const says = (by: string, nowMs: number, x: number, more: Partial<Command> = {}) => {
    const said = { sequence: ++sequence, timeMs: nowMs, lease: leaseOf(by), deadMan: x !== 0, ...more };
    const verdict = guard.onCommand(by, commandOf(x, 0, said), nowMs);
    return verdict.accepted ? null : verdict.reason;
  };
  return { guard, says, speed: (nowMs: number) => guard.velocityAt(nowMs).linear.x };
}

describe('an operator who begins to drive', () => {
  test('with a stick that is held moves nothing until it is let go of', () => {
    const { guard, says, speed } = setUp();
    guard.requestLease('a', false, 0);
    for (let t = 0; t < 2000; t += 20) expect(says('a', t, 0.4)).toBe('let-go-first');
    expect(speed(2000)).toBe(0);
    expect(says('a', 2000, 0)).toBeNull();
    expect(says('a', 2020, 0.4)).toBeNull();
  });

  test.each([
    ['zero', {}],
    ['an open grip', { deadMan: false, twist: { ...zeroTwist(), linear: { x: 0.3, y: 0, z: 0 } } }],
  ])('may have said %s before it had the lease', (_, how) => {
    const { guard, says, speed } = setUp();
    expect(says('a', 0, 0, how)).toBe('not-lease-holder');
    guard.requestLease('a', false, 10);
    expect(says('a', 20, 0.4)).toBeNull();
    expect(speed(20)).toBe(0.4);
  });

  test('whose hand has closed since it said so moves nothing, nor one that says that it is not read', () => {
    for (const [x, more] of [
      [0.4, {}],
      [0, { unread: true as const }],
    ] as const) {
      const { guard, says } = setUp();
      says('a', 0, 0);
      says('a', 10, x, more);
      guard.requestLease('a', false, 20);
      expect(says('a', 30, 0.4)).toBe('let-go-first');
    }
  });

  test('is not believed what it said too late, or before what it said last', () => {
    const { guard, says } = setUp();
    guard.onClockProbe('a', 0, 0);
    says('a', 1000, 0, { timeMs: 0 });
    guard.requestLease('a', false, 1010);
    expect(says('a', 1020, 0.4)).toBe('let-go-first');
    const other = setUp();
    other.says('a', 0, 0.4, { sequence: 9 });
    other.says('a', 10, 0, { sequence: 8 });
    other.guard.requestLease('a', false, 20);
    expect(other.says('a', 30, 0.4, { sequence: 10 })).toBe('let-go-first');
  });

  test('after it asked in vain, or after it drove before, must let go again', () => {
    const { guard, says } = setUp();
    says('a', 0, 0);
    says('b', 0, 0);
    guard.requestLease('b', false, 10);
    says('b', 20, 0.4);
    // Its grip closes, and is held until the other one leaves.
    expect(guard.requestLease('a', false, 30).granted).toBe(false);
    guard.operatorGone('b');
    guard.requestLease('a', false, 40);
    expect(says('a', 50, 0.4)).toBe('let-go-first');
    says('a', 60, 0);
    expect(says('a', 80, 0.4)).toBeNull();
    guard.requestLease('c', true, 100);
    guard.requestLease('a', true, 120);
    expect(says('a', 140, 0.4)).toBe('let-go-first');
  });

  test('in a new session must let go, whatever it said in the last', () => {
    const { guard, says } = setUp();
    says('a', 0, 0);
    guard.requestLease('a', false, 10);
    says('a', 20, 0.4);
    says('a', 40, 0);
    guard.operatorGone('a');
    guard.requestLease('a', false, 60);
    expect(says('a', 80, 0.4, { sequence: 1 })).toBe('let-go-first');
  });
});

describe('after the emergency stop was released', () => {
  test.each([151, 190, 399, 401, 5000])('a radio gap of %i ms is no open hand', (gapMs) => {
    const { guard, says, speed } = setUp();
    guard.onOpenHand('a');
    guard.requestLease('a', false, 0);
    says('a', 0, 0.3);
    guard.latchEstop('operator');
    for (let t = 20; t <= 100; t += 20) expect(says('a', t, 0.3)).toBe('estop-latched');
    guard.releaseEstop('a');
    for (let t = 100 + gapMs; t < 600 + gapMs; t += 20) {
      expect(says('a', t, 0.3)).toBe('estop-latched');
      expect(speed(t)).toBe(0);
    }
    says('a', 700 + gapMs, 0);
    expect(says('a', 720 + gapMs, 0.3)).toBeNull();
  });

  test('another who drives by then needs an open hand of its own, and no more', () => {
    const { guard, says } = setUp();
    guard.onOpenHand('a');
    guard.requestLease('a', false, 0);
    guard.latchEstop('operator');
    guard.releaseEstop('a');
    says('b', 0, 0);
    guard.requestLease('b', true, 10);
    expect(says('b', 20, 0.3)).toBeNull();
  });
});
