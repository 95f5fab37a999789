import { type Command, type Intervention, type Twist, zeroTwist } from '@farpoint/protocol';
import { describe, expect, test } from 'vitest';
import { DriveGuard } from '../drive-guard.ts';
import { defaultDriveLimits, RESUME_WITHIN_MS } from '../limits.ts';
import type { MotionBound, MotionGuard } from './motion-guard.ts';
import { FREE } from './motion-guard.ts';
import { MotionSupervisor, type MotionSupervisorOptions } from './motion-supervisor.ts';

const ramps = {
  accelerationMps2: 10,
  decelerationMps2: 2,
  emergencyMps2: 4,
  turnRadps2: 30,
  emergencyTurnRadps2: 60,
};

/** A guard that says what a test wants. */
class Told implements MotionGuard {
  says: MotionBound = FREE;
  bound(): MotionBound {
    return this.says;
  }
  is(reason: Intervention, factor: number, urgent = false): void {
    this.says = { reason, factor, urgent };
  }
}

function supervised(options: Partial<MotionSupervisorOptions> = {}, letGoAfterMs = 150) {
  const told = new Told();
  const other = new Told();
  const guard = new DriveGuard({
    limits: defaultDriveLimits,
    letGoAfterMs,
    randomBytes: (count) => new Uint8Array(count),
  });
  guard.onOpenHand('op');
  const outcome = guard.requestLease('op', false, 0);
  const motion = new MotionSupervisor(guard, { guards: [told, other], ...options });
  let sequence = 0;
  const command = (nowMs: number, x: number, z = 0, deadMan = true): Command => ({
    type: 'command',
    sequence: sequence++,
    timeMs: nowMs,
    lease: outcome.granted ? outcome.lease : '',
    deadMan,
    twist: { ...zeroTwist(), linear: { x, y: 0, z: 0 }, angular: { x: 0, y: 0, z } },
  });
  const drive = (nowMs: number, x: number, z = 0): Twist => {
    guard.onCommand('op', command(nowMs, x, z), nowMs);
    return motion.velocityAt(nowMs);
  };
  const begun: Intervention[] = [];
  motion.onIntervention = (reason) => begun.push(reason);
  return { told, other, guard, motion, drive, begun, command };
}

describe('the motion supervisor', () => {
  test('lets through what nothing bounds', () => {
    const { motion, drive } = supervised();
    expect(drive(0, 0.5, 1)).toMatchObject({ linear: { x: 0.5 }, angular: { z: 1 } });
    expect(motion.decision).toEqual({ phase: 'driving', factor: 1, reasons: [] });
  });

  test('follows the strictest guard, along the same arc, and names all, the strictest first', () => {
    const { told, other, motion, drive, begun } = supervised();
    told.is('view-late', 0.5);
    other.is('obstacle-near', 0.25);
    expect(drive(0, 0.8, -1)).toMatchObject({ linear: { x: 0.2 }, angular: { z: -0.25 } });
    expect(motion.decision).toEqual({
      phase: 'limited',
      factor: 0.25,
      reasons: ['obstacle-near', 'view-late'],
    });
    drive(20, 0.8, -1);
    expect(begun).toEqual(['obstacle-near', 'view-late']);
    told.says = FREE;
    other.says = FREE;
    drive(40, 0.8);
    expect(motion.decision.reasons).toEqual([]);
    other.is('obstacle-near', 0.5);
    drive(60, 0.8);
    expect(begun).toEqual(['obstacle-near', 'view-late', 'obstacle-near']);
  });

  test.each([Number.NaN, -1, 2, Number.POSITIVE_INFINITY])('a factor of %s holds the robot', (factor) => {
    const { told, motion, drive } = supervised();
    told.is('fence', factor);
    expect(drive(0, 1)).toEqual(zeroTwist());
    expect(motion.decision).toMatchObject({ phase: 'held', factor: 0 });
  });

  test('brakes harder where something demands it, and says that it brakes', () => {
    const { told, motion, drive } = supervised({ ramps });
    drive(0, 1);
    for (let t = 20; t <= 200; t += 20) drive(t, 1);
    expect(motion.ramping).toBe(false);
    told.is('obstacle', 0, true);
    expect(drive(220, 1).linear.x).toBeCloseTo(0.92);
    expect(motion.decision.phase).toBe('braking');
    expect(motion.ramping).toBe(true);
    // The driver lets the stick go: the ordinary ramp.
    told.says = FREE;
    expect(drive(240, 0).linear.x).toBeCloseTo(0.88);
  });

  test.each([
    ['silence', () => undefined],
    ['the emergency stop', (guard: DriveGuard) => guard.latchEstop('operator')],
    ['another driver', (guard: DriveGuard) => guard.releaseLease('op')],
  ])('%s brakes as hard as allowed', (_, happens) => {
    const { guard, motion, drive } = supervised({ ramps, staleMs: 1000 });
    for (let t = 0; t <= 200; t += 20) drive(t, 1);
    happens(guard);
    motion.velocityAt(350);
    expect(motion.velocityAt(400).linear.x).toBeLessThanOrEqual(1 - 0.05 * 4 + 1e-9);
    expect(motion.velocityAt(650)).toEqual(zeroTwist());
  });

  test('where a hand must let go, the robot stays until it has, and says why', () => {
    const { told, guard, motion, drive, command } = supervised({
      letGoAfter: { 'view-lost': { why: 'what you saw was too old', lastsMs: 0 } },
    });
    drive(0, 1);
    told.is('view-lost', 0, true);
    expect(drive(20, 1)).toEqual(zeroTwist());
    told.says = FREE;
    const verdict = guard.onCommand('op', command(40, 1), 40);
    expect(verdict).toMatchObject({
      reason: 'let-go-first',
      detail: 'held while what you saw was too old: let go of it once',
    });
    expect(motion.velocityAt(40)).toEqual(zeroTwist());
    expect(motion.decision).toEqual({ phase: 'held', factor: 0, reasons: ['view-lost'] });
    guard.onCommand('op', command(60, 0, 0, false), 60);
    motion.velocityAt(60);
    expect(motion.decision).toEqual({ phase: 'standing', factor: 1, reasons: [] });
    expect(drive(80, 1).linear.x).toBe(1);
  });

  test('what stops it for a shorter time than allowed lets it move on by itself', () => {
    const letGoAfter = { 'view-lost': { why: 'what you saw was too old', lastsMs: 400 } };
    for (const [lostMs, movesOn] of [
      [399, true],
      [401, false],
    ] as const) {
      const { told, guard, drive, command } = supervised({ letGoAfter });
      drive(0, 1);
      told.is('view-lost', 0, true);
      for (let t = 20; t < 20 + lostMs; t += 20) expect(drive(t, 1)).toEqual(zeroTwist());
      drive(20 + lostMs, 1);
      told.says = FREE;
      expect(drive(440, 1).linear.x).toBe(movesOn ? 1 : 0);
      if (!movesOn)
        expect(guard.onCommand('op', command(450, 1), 450)).toMatchObject({ reason: 'let-go-first' });
    }
  });

  test('after a gap of 399 ms in a grip that held on it moves on by its ramps, after one of 401 ms it does not', () => {
    for (const [gapMs, movesOn] of [
      [399, true],
      [401, false],
    ] as const) {
      const { guard, motion, drive, command } = supervised({ ramps, staleMs: 1000 }, RESUME_WITHIN_MS);
      for (let t = 0; t <= 2000; t += 20) drive(t, 1);
      expect(motion.velocityAt(2000).linear.x).toBe(1);
      for (let t = 2010; t < 2000 + gapMs; t += 10) motion.velocityAt(t);
      // It has braked as hard as allowed from the watchdog's time on.
      expect(motion.velocityAt(2000 + gapMs).linear.x).toBeLessThan(0.01);
      const backMs = 2000 + gapMs;
      const verdict = guard.onCommand('op', command(backMs, 1), backMs);
      expect(verdict.accepted).toBe(movesOn);
      expect(guard.mustLetGo(backMs)).toBe(!movesOn);
      motion.velocityAt(backMs);
      expect(motion.velocityAt(backMs + 100).linear.x).toBeCloseTo(
        movesOn ? 0.1 * ramps.accelerationMps2 : 0,
      );
    }
  });

  test('a gap is no letting go after a released emergency stop, as long as it would let the hand drive on', () => {
    for (const gapMs of [151, 300, 399]) {
      const { guard, command } = supervised({}, RESUME_WITHIN_MS);
      guard.latchEstop('operator', 'op');
      guard.releaseEstop('op');
      const held = (t: number) => guard.onCommand('op', command(t, 1), t);
      for (let t = 1010; t <= 1100; t += 10) expect(held(t)).toMatchObject({ reason: 'estop-latched' });
      expect(held(1100 + gapMs)).toMatchObject({ reason: 'estop-latched' });
      guard.onCommand('op', command(2000, 0, 0, false), 2000);
      expect(held(2010).accepted).toBe(true);
      // A hand that grips afresh, as another operator's does, need not.
      guard.latchEstop('operator', 'op');
      held(2400);
      guard.releaseEstop('op');
      guard.releaseLease('op');
      guard.onOpenHand('next');
      const granted = guard.requestLease('next', false, 2420);
      const lease = granted.granted ? granted.lease : '';
      expect(guard.onCommand('next', { ...command(2600, 1), lease }, 2600).accepted).toBe(true);
    }
  });

  test('a hand that is not read brakes at once, and that is no letting go', () => {
    const { guard, motion, drive, command } = supervised({ ramps, staleMs: 1000 }, RESUME_WITHIN_MS);
    for (let t = 0; t <= 2000; t += 20) drive(t, 1);
    const unread = (t: number, x = 0) => guard.onCommand('op', { ...command(t, x), unread: true }, t);
    expect(unread(2020).accepted).toBe(true);
    motion.velocityAt(2020);
    expect(motion.velocityAt(2070).linear.x).toBeCloseTo(1 - 0.07 * ramps.emergencyMps2);
    // Whatever velocity it names.
    unread(2080, 1);
    expect(motion.velocityAt(2090).linear.x).toBeLessThan(0.72);
    expect(guard.onCommand('op', command(2399, 1), 2399).accepted).toBe(true);
    for (let t = 2420; t <= 3000; t += 20) drive(t, 1);
    for (let t = 3020; t <= 3400; t += 20) unread(t);
    expect(guard.onCommand('op', command(3400, 1), 3400)).toMatchObject({ reason: 'let-go-first' });
    guard.onCommand('op', command(3420, 0, 0, false), 3420);
    expect(guard.onCommand('op', command(3440, 1), 3440).accepted).toBe(true);
  });

  test('the emergency stop is what is shown of it', () => {
    const { told, guard, motion, drive } = supervised();
    told.is('obstacle-near', 0.5);
    drive(0, 1);
    guard.latchEstop('operator');
    motion.velocityAt(10);
    expect(motion.decision).toEqual({ phase: 'latched', factor: 1, reasons: [] });
  });
});
