import { zeroTwist } from '@farpoint/protocol';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { approach, BaseDrive, DEFAULT_LIMITS } from './drive.ts';
import { SimulationError } from './errors.ts';

function twist(linear: number, angular: number) {
  const command = zeroTwist();
  command.linear.x = linear;
  command.angular.z = angular;
  return command;
}

test('speeds and accelerations stay within the limits, whatever is commanded', () => {
  const any = fc.double({ min: -1e6, max: 1e6, noNaN: true });
  fc.assert(
    fc.property(
      fc.array(fc.tuple(any, any, fc.integer({ min: 1, max: 300 })), { maxLength: 20 }),
      (commands) => {
        const drive = new BaseDrive();
        const dt = 0.002;
        for (const [linear, angular, steps] of commands) {
          drive.command(twist(linear, angular));
          for (let i = 0; i < steps; i++) {
            const { linear: v, angular: w } = drive;
            drive.step(dt, true);
            const speedingUp = Math.abs(drive.linear) > Math.abs(v);
            const limit = speedingUp ? DEFAULT_LIMITS.linearAcceleration : DEFAULT_LIMITS.linearDeceleration;
            expect(Math.abs(drive.linear - v) / dt).toBeLessThan(limit + 1e-9);
            expect(Math.abs(drive.angular - w) / dt).toBeLessThan(DEFAULT_LIMITS.angularAcceleration + 1e-9);
            expect(Math.abs(drive.linear)).toBeLessThanOrEqual(DEFAULT_LIMITS.maxLinearSpeed);
            expect(Math.abs(drive.angular)).toBeLessThanOrEqual(DEFAULT_LIMITS.maxAngularSpeed);
          }
        }
      },
    ),
    { numRuns: 30, seed: 1 },
  );
});

test('reaches the command and keeps it', () => {
  const drive = new BaseDrive();
  drive.command(twist(0.4, -0.7));
  for (let i = 0; i < 1000; i++) drive.step(0.002, true);
  expect(drive.linear).toBe(0.4);
  expect(drive.angular).toBe(-0.7);
  expect(drive.twist).toEqual(twist(0.4, -0.7));
});

test('brakes without power', () => {
  const drive = new BaseDrive();
  drive.command(twist(1, 0));
  for (let i = 0; i < 1000; i++) drive.step(0.002, true);
  for (let i = 0; i < 250; i++) drive.step(0.002, false);
  expect(drive.linear).toBeCloseTo(0, 9);
});

test('a reversal passes through zero at the braking limit', () => {
  expect(approach(0.1, -1, 0.05, 0.2)).toBe(0);
  expect(approach(0.5, -1, 0.05, 0.2)).toBeCloseTo(0.3, 12);
  expect(approach(-0.5, -1, 0.05, 0.2)).toBeCloseTo(-0.55, 12);
});

test('wheels turn at the speeds that give the motion', () => {
  const drive = new BaseDrive({ trackWidth: 0.5, wheelRadius: 0.1 });
  drive.linear = 0.6;
  drive.angular = 0.8;
  expect(drive.wheelSpeeds.left).toBeCloseTo(4, 9);
  expect(drive.wheelSpeeds.right).toBeCloseTo(8, 9);
});

test.each(['linear', 'angular'] as const)('refuses a command whose %s part is not finite', (part) => {
  for (const axis of ['x', 'y', 'z'] as const) {
    for (const value of [Number.NaN, Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY]) {
      const drive = new BaseDrive();
      drive.command(twist(0.5, 0));
      const command = zeroTwist();
      command[part][axis] = value;
      expect(() => drive.command(command)).toThrow(
        expect.objectContaining({ code: 'not-finite', what: `twist.${part}.${axis}` }),
      );
      for (let i = 0; i < 1000; i++) drive.step(0.002, true);
      expect(drive.linear).toBe(0.5);
    }
  }
});

test('refuses invalid limits', () => {
  expect(() => new BaseDrive({ radius: 0 })).toThrow(SimulationError);
  expect(() => new BaseDrive({ maxLinearSpeed: Number.NaN })).toThrow(SimulationError);
});

describe('sideways', () => {
  const aside = (x: number, y: number) => ({ ...zeroTwist(), linear: { x, y, z: 0 } });

  test('a base that cannot stays as it is, whatever is commanded', () => {
    const drive = new BaseDrive();
    drive.command(aside(0.4, 0.5));
    for (let i = 0; i < 1000; i++) drive.step(0.002, true);
    expect(drive.twist).toEqual(aside(0.4, 0));
    expect(drive.speed).toBe(0.4);
  });

  test('one that can speeds up and brakes as forwards, within its limit', () => {
    const drive = new BaseDrive({ maxLateralSpeed: 0.5 });
    drive.command(aside(0, -2));
    for (let i = 0; i < 100; i++) drive.step(0.002, true);
    expect(drive.lateral).toBeCloseTo(-0.2);
    for (let i = 0; i < 1000; i++) drive.step(0.002, true);
    expect(drive.twist).toEqual(aside(0, -0.5));
    expect(drive.speed).toBe(0.5);
    for (let i = 0; i < 100; i++) drive.step(0.002, false);
    expect(drive.lateral).toBeCloseTo(-0.1);
    drive.halt();
    expect(drive.twist).toEqual(zeroTwist());
  });

  test('the limit is not negative', () => {
    expect(() => new BaseDrive({ maxLateralSpeed: -0.1 })).toThrow(SimulationError);
    expect(() => new BaseDrive({ maxLateralSpeed: Number.NaN })).toThrow(SimulationError);
  });
});
