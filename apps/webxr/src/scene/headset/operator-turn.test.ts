import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { OperatorTurn, STEADY_RATE } from './operator-turn.ts';

const degrees = (radians: number) => (radians * 180) / Math.PI;

describe('in steps', () => {
  test('turns once for each deflection: to the right is negative', () => {
    const turn = new OperatorTurn({ turn: 'snap', snapDegrees: 30 });
    expect(turn.by(0, 11)).toBe(0);
    expect(degrees(turn.by(0.9, 11))).toBeCloseTo(-30, 9);
    expect(turn.by(1, 11)).toBe(0);
    // Not yet centred.
    expect(turn.by(0.5, 11)).toBe(0);
    expect(turn.by(1, 11)).toBe(0);
    expect(turn.by(0.1, 11)).toBe(0);
    expect(degrees(turn.by(-1, 11))).toBeCloseTo(30, 9);
  });

  test.each([
    { back: 0, to: 0.69, turns: 0 },
    { back: 0, to: 0.71, turns: 1 },
    { back: 0.39, to: 0.71, turns: 1 },
    { back: 0.41, to: 1, turns: 0 },
  ])('after the stick came back to $back, a push to $to turns $turns times', ({ back, to, turns }) => {
    const turn = new OperatorTurn({ turn: 'snap', snapDegrees: 30 });
    turn.by(0, 11);
    turn.by(1, 11);
    turn.by(back, 11);
    expect(degrees(turn.by(to, 11))).toBeCloseTo(-30 * turns, 9);
  });

  test('a stick that is deflected from the beginning turns nothing until it is centred', () => {
    const turn = new OperatorTurn({ turn: 'snap', snapDegrees: 30 });
    expect(turn.by(1, 11)).toBe(0);
    expect(turn.by(0, 11)).toBe(0);
    expect(turn.by(1, 11)).not.toBe(0);
    turn.disarm();
    expect(turn.by(-1, 11)).toBe(0);
  });

  test('trembles around the threshold do not turn again', () => {
    const turn = new OperatorTurn({ turn: 'snap', snapDegrees: 45 });
    turn.by(0, 11);
    let total = 0;
    for (const stick of [0.69, 0.71, 0.69, 0.72, 0.6, 0.8]) total += turn.by(stick, 11);
    expect(degrees(total)).toBeCloseTo(-45, 9);
  });
});

describe('steadily', () => {
  test('turns in proportion to time, and at most at the full rate', () => {
    const turn = new OperatorTurn({ turn: 'smooth', snapDegrees: 30 });
    turn.by(0, 11);
    expect(turn.by(1, 20)).toBeCloseTo(-STEADY_RATE * 0.02, 9);
    expect(turn.by(-1, 10)).toBeCloseTo(STEADY_RATE * 0.01, 9);
    expect(turn.by(0.3, 10)).toBeLessThan(0);
    expect(turn.by(0.05, 10)).toBe(0);
  });

  test('a frame after a hang turns by no more than 50 ms', () => {
    const turn = new OperatorTurn({ turn: 'smooth', snapDegrees: 30 });
    turn.by(0, 11);
    expect(turn.by(1, 5000)).toBeCloseTo(-STEADY_RATE * 0.05, 9);
    expect(turn.by(1, -5)).toBe(0);
  });
});

test('does not turn where the view follows the robot, and never by anything that is not a number', () => {
  const followsRobot = new OperatorTurn({ turn: 'robot', snapDegrees: 30 });
  followsRobot.by(0, 11);
  expect(followsRobot.by(1, 11)).toBe(0);
  const stick = fc.double();
  fc.assert(
    fc.property(fc.constantFrom('snap' as const, 'smooth' as const), fc.array(stick), (kind, sticks) => {
      const turn = new OperatorTurn({ turn: kind, snapDegrees: 30 });
      for (const deflection of sticks) {
        expect(Math.abs(turn.by(deflection, 11))).toBeLessThanOrEqual(Math.PI / 6 + 1e-9);
      }
    }),
    { seed: 4 },
  );
});
