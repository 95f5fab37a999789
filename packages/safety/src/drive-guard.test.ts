import { decodeJson, encodeJson, isZeroTwist, robotSessionCodec, zeroTwist } from '@farpoint/protocol';
import { describe, expect, test } from 'vitest';
import { defaultDriveLimits } from './limits.ts';
import { commandOf, drivenGuard, makeGuard } from './testing/driven-guard.ts';

test('follows the latest command until the watchdog expires', () => {
  const { guard, send } = drivenGuard();
  send(1000, 0.5);
  expect(guard.velocityAt(1149).linear.x).toBe(0.5);
  expect(guard.nextDeadlineMs).toBe(1150);
  expect(guard.state(1149)).toBe('driving');
  expect(guard.velocityAt(1150).linear.x).toBe(0);
  expect(guard.state(1150)).toBe('watchdog');
  send(1200, -0.25);
  expect(guard.velocityAt(1201).linear.x).toBe(-0.25);
});

test('a refused command does not feed the watchdog', () => {
  const { guard, send } = drivenGuard();
  send(1000, 0.5);
  expect(send(1100, 9).accepted).toBe(false);
  expect(guard.nextDeadlineMs).toBe(1150);
  expect(guard.velocityAt(1149).linear.x).toBe(0.5);
});

test('a command for zero is idle, not a watchdog stop, and needs no timer', () => {
  const { guard, send } = drivenGuard();
  send(1000, 0.5);
  send(1020, 0);
  expect(guard.state(1021)).toBe('idle');
  expect(guard.nextDeadlineMs).toBeNull();
  expect(guard.state(5000)).toBe('idle');
});

test('another operator’s released grip stops nobody', () => {
  const { guard, send, lease } = drivenGuard();
  const command = send(1000, 0.5);
  expect(command.accepted).toBe(true);
  const other = guard.onCommand('b', commandOf(1, 0, { sequence: 99, lease, deadMan: false }), 1010);
  expect(other).toMatchObject({ reason: 'not-lease-holder' });
  expect(guard.velocityAt(1010).linear.x).toBe(0.5);
});

test('reports blocked only for a robot that is asked to move', () => {
  const { guard, send } = drivenGuard();
  expect(guard.state(0, true)).toBe('idle');
  send(0, 0.5);
  expect(guard.state(1, true)).toBe('blocked');
});

describe('emergency stop', () => {
  test('anyone latches it, only the holder releases it', () => {
    const { guard, send } = drivenGuard();
    send(0, 0.5);
    guard.latchEstop('operator');
    expect(isZeroTwist(guard.velocityAt(0))).toBe(true);
    expect(guard.state(0)).toBe('estop');
    expect(guard.estopState()).toEqual({ type: 'estop', latched: true, by: 'operator', latch: 1 });
    expect(guard.releaseEstop('b')).toEqual({ released: false, reason: 'not-lease-holder' });
    expect(guard.releaseEstop('a')).toEqual({ released: true });
    expect(guard.releaseEstop('a')).toEqual({ released: false, reason: 'not-latched' });
    expect(guard.estopState()).toEqual({ type: 'estop', latched: false, latch: 1 });
  });
});

test('requests from before the emergency stop do not return with its release', () => {
  const { guard, send } = drivenGuard();
  send(0, 0.5);
  guard.latchEstop('robot');
  guard.releaseEstop('a');
  expect(isZeroTwist(guard.velocityAt(2))).toBe(true);
});

describe('lease', () => {
  test('released, lost or taken: the robot stops at once, and the old lease no longer drives', () => {
    for (const end of ['release', 'gone', 'take'] as const) {
      const { guard, send } = drivenGuard();
      send(0, 0.5);
      if (end === 'release') expect(guard.releaseLease('a')).toBe(true);
      if (end === 'gone') expect(guard.operatorGone('a')).toBe(true);
      if (end === 'take') expect(guard.requestLease('b', true, 5000).granted).toBe(true);
      expect(isZeroTwist(guard.velocityAt(1))).toBe(true);
      expect(guard.nextDeadlineMs).toBeNull();
      expect(send(10, 0.5)).toMatchObject({ reason: 'not-lease-holder' });
      expect(guard.state(10)).toBe('idle');
    }
  });

  test('nobody can take over from an operator who is moving', () => {
    const { guard, send } = drivenGuard();
    for (let t = 0; t < 20_000; t += 100) {
      send(t, 0.1);
      expect(guard.requestLease('b', true, t).granted).toBe(false);
    }
  });

  test('commands for zero do not prevent the holder from becoming idle', () => {
    const { guard, send } = drivenGuard();
    for (let t = 0; t <= 5000; t += 100) send(t, 0);
    expect(guard.requestLease('b', true, 5000).granted).toBe(true);
  });

  test('each operator gets its own view of it', () => {
    const guard = makeGuard();
    expect(guard.leaseState('a')).toEqual({ type: 'lease', holder: 'nobody' });
    guard.onOpenHand('a');
    guard.requestLease('a', false, 0);
    expect(guard.leaseState('a')).toEqual({ type: 'lease', holder: 'you', lease: '01'.repeat(16) });
    expect(guard.leaseState('b')).toEqual({ type: 'lease', holder: 'other' });
    for (const message of [guard.leaseState('a'), guard.leaseState('b'), guard.estopState()]) {
      expect(decodeJson(robotSessionCodec, encodeJson(robotSessionCodec, message))).toEqual(message);
    }
  });
});

test('clock probes reach the gate', () => {
  const { guard, send } = drivenGuard();
  guard.onClockProbe('a', 1000, 1000);
  expect(send(1300, 0.5, { timeMs: 1100 })).toMatchObject({ reason: 'stale' });
});

test('malformed messages count against the rate and move nothing', () => {
  const { guard, send } = drivenGuard();
  send(0, 0.5);
  expect(guard.onMalformed('a', 'twist.linear.x: expected number', 10)).toMatchObject({
    reason: 'malformed',
  });
  expect(guard.velocityAt(10).linear.x).toBe(0.5);
});

test('neither the limits nor the velocity can be changed from outside', () => {
  const limits = { ...defaultDriveLimits };
  const guard = makeGuard({ limits });
  limits.maxLinear = 100;
  expect(guard.limits.maxLinear).toBe(1);
  expect(() => {
    (guard.limits as { maxLinear: number }).maxLinear = 100;
  }).toThrow(TypeError);
  const { guard: moving, send } = drivenGuard();
  const verdict = send(0, 0.5);
  if (verdict.accepted) verdict.twist.linear.x = 100;
  moving.velocityAt(1).linear.x = 100;
  expect(moving.velocityAt(1).linear.x).toBe(0.5);
});

test('stands still at a time that is NaN', () => {
  const { guard, send } = drivenGuard();
  send(0, 0.5);
  expect(isZeroTwist(guard.velocityAt(Number.NaN))).toBe(true);
});

describe('a supervisor', () => {
  test('takes the lease from an operator who is moving, but only when it asks to take it', () => {
    for (const takePolicy of ['never', 'idle', 'always'] as const) {
      const guard = makeGuard({ takePolicy });
      guard.onOpenHand('a');
      guard.requestLease('a', false, 0);
      expect(guard.requestLease('s', false, 1, true)).toMatchObject({ granted: false, reason: 'held' });
      expect(guard.requestLease('s', true, 1, true)).toMatchObject({ granted: true, takenFrom: 'a' });
      expect(guard.leaseHolder).toBe('s');
    }
  });

  test('releases the emergency stop of another, whose held stick still starts nothing', () => {
    const { guard, send } = drivenGuard();
    guard.latchEstop('operator');
    expect(guard.releaseEstop('s', true)).toEqual({ released: true });
    expect(guard.leaseHolder).toBe('a');
    expect(send(10, 0.5)).toMatchObject({ reason: 'estop-latched' });
    expect(send(20, 0)).toMatchObject({ accepted: true });
    expect(send(30, 0.5)).toMatchObject({ accepted: true });
  });
});

test('stops at once when nothing takes its velocities any more, and moves again only for a hand that let go', () => {
  const { guard, send } = drivenGuard();
  let fault: string | null = null;
  guard.watchWheels(() => fault);
  send(1000, 0.5);
  fault = 'nobody listens';
  expect(isZeroTwist(guard.velocityAt(1001))).toBe(true);
  expect(guard.state(1001)).toBe('idle');
  expect(send(1020, 0.5)).toMatchObject({ reason: 'no-wheels', detail: 'nobody listens' });
  fault = null;
  expect(isZeroTwist(guard.velocityAt(1030))).toBe(true);
  expect(send(1040, 0.5)).toMatchObject({ reason: 'let-go-first' });
  expect(guard.mustLetGo(1040)).toBe(true);
  send(1060, 0);
  send(1080, 0.5);
  expect(guard.mustLetGo(1081)).toBe(false);
  expect(guard.velocityAt(1081).linear.x).toBe(0.5);
});

test('what was read a while ago moves the robot for so much less', () => {
  const { guard, send } = drivenGuard();
  send(1000, 0.5, { timeMs: 0 });
  expect(send(1120, 0.5, { timeMs: 20 })).toMatchObject({ accepted: true, spentMs: 70 });
  expect(guard.velocityAt(1199).linear.x).toBe(0.5);
  expect(guard.velocityAt(1200)).toEqual(zeroTwist());
});
