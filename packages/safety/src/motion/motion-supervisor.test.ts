import { type Intervention, type Twist, zeroTwist } from '@farpoint/protocol';
import { describe, expect, test } from 'vitest';
import type { DriveGuard } from '../drive-guard.ts';
import { RESUME_WITHIN_MS } from '../limits.ts';
import { drivenGuard } from '../testing/driven-guard.ts';
import { FREE, type MotionBound, type MotionGuard } from './motion-guard.ts';
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
  const { guard, send } = drivenGuard({ letGoAfterMs });
  const motion = new MotionSupervisor(guard, { guards: [told, other], ...options });
  const drive = (nowMs: number, x: number, z = 0): Twist => {
    send(nowMs, x, {}, z);
    return motion.velocityAt(nowMs);
  };
  const begun: Intervention[] = [];
  motion.onIntervention = (reason) => begun.push(reason);
  return { told, other, guard, motion, drive, begun, send };
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
    ['another driver', (guard: DriveGuard) => guard.releaseLease('a')],
  ])('%s brakes as hard as allowed', (_, happens) => {
    const { guard, motion, drive } = supervised({ ramps, staleMs: 1000 });
    for (let t = 0; t <= 200; t += 20) drive(t, 1);
    happens(guard);
    motion.velocityAt(350);
    expect(motion.velocityAt(400).linear.x).toBeLessThanOrEqual(1 - 0.05 * 4 + 1e-9);
    expect(motion.velocityAt(650)).toEqual(zeroTwist());
  });

  test('where a hand must let go, the robot stays until it has, and says why', () => {
    const { told, motion, drive, send } = supervised({
      letGoAfter: { 'view-lost': { why: 'what you saw was too old', lastsMs: 0 } },
    });
    drive(0, 1);
    told.is('view-lost', 0, true);
    expect(drive(20, 1)).toEqual(zeroTwist());
    told.says = FREE;
    const verdict = send(40, 1);
    expect(verdict).toMatchObject({
      reason: 'let-go-first',
      detail: 'held while what you saw was too old: let go of it once',
    });
    expect(motion.velocityAt(40)).toEqual(zeroTwist());
    expect(motion.decision).toEqual({ phase: 'held', factor: 0, reasons: ['view-lost'] });
    send(60, 0, { deadMan: false });
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
      const { told, drive, send } = supervised({ letGoAfter });
      drive(0, 1);
      told.is('view-lost', 0, true);
      for (let t = 20; t < 20 + lostMs; t += 20) expect(drive(t, 1)).toEqual(zeroTwist());
      drive(20 + lostMs, 1);
      told.says = FREE;
      expect(drive(440, 1).linear.x).toBe(movesOn ? 1 : 0);
      if (!movesOn) expect(send(450, 1)).toMatchObject({ reason: 'let-go-first' });
    }
  });

  test('a hand that is not read brakes at once, and that is no letting go', () => {
    const { motion, drive, send } = supervised({ ramps, staleMs: 1000 }, RESUME_WITHIN_MS);
    for (let t = 0; t <= 2000; t += 20) drive(t, 1);
    const unread = (t: number, x = 0) => send(t, x, { unread: true });
    expect(unread(2020).accepted).toBe(true);
    motion.velocityAt(2020);
    expect(motion.velocityAt(2070).linear.x).toBeCloseTo(1 - 0.07 * ramps.emergencyMps2);
    // Whatever velocity it names.
    unread(2080, 1);
    expect(motion.velocityAt(2090).linear.x).toBeLessThan(0.72);
    expect(send(2399, 1).accepted).toBe(true);
    for (let t = 2420; t <= 3000; t += 20) drive(t, 1);
    for (let t = 3020; t <= 3400; t += 20) unread(t);
    expect(send(3400, 1)).toMatchObject({ reason: 'let-go-first' });
    send(3420, 0, { deadMan: false });
    expect(send(3440, 1).accepted).toBe(true);
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
