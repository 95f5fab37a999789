import { zeroTwist } from '@farpoint/protocol';
import fc from 'fast-check';
import { expect, test } from 'vitest';
import { approach, DEFAULT_LIMITS, DifferentialDrive } from './drive.ts';
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
        const drive = new DifferentialDrive();
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
  const drive = new DifferentialDrive();
  drive.command(twist(0.4, -0.7));
  for (let i = 0; i < 1000; i++) drive.step(0.002, true);
  expect(drive.linear).toBe(0.4);
  expect(drive.angular).toBe(-0.7);
  expect(drive.twist).toEqual(twist(0.4, -0.7));
});

test('brakes without power', () => {
  const drive = new DifferentialDrive();
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
  const drive = new DifferentialDrive({ trackWidth: 0.5, wheelRadius: 0.1 });
  drive.linear = 0.6;
  drive.angular = 0.8;
  expect(drive.wheelSpeeds.left).toBeCloseTo(4, 9);
  expect(drive.wheelSpeeds.right).toBeCloseTo(8, 9);
});

test.each(['linear', 'angular'] as const)('refuses a command whose %s part is not finite', (part) => {
  for (const axis of ['x', 'y', 'z'] as const) {
    for (const value of [Number.NaN, Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY]) {
      const drive = new DifferentialDrive();
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
  expect(() => new DifferentialDrive({ radius: 0 })).toThrow(SimulationError);
  expect(() => new DifferentialDrive({ maxLinearSpeed: Number.NaN })).toThrow(SimulationError);
});
