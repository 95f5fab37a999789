import fc from 'fast-check';
import { expect, it } from 'vitest';
import { steerTo } from './steer-to.ts';

const limits = { maxLinear: 0.6, maxAngular: 0.8 };
const TICK_S = 0.025;
const place = fc.double({ min: -10, max: 10, noNaN: true });
const direction = fc.double({ min: -Math.PI, max: Math.PI, noNaN: true });

it('leads from any pose to any goal, within its limits', () => {
  const goals = fc.record({ x: place, y: place, yaw: fc.option(direction, { nil: undefined }) });
  fc.assert(
    fc.property(goals, fc.record({ x: place, y: place, yaw: direction }), (goal, start) => {
      const pose = { ...start };
      let seconds = 0;
      for (; seconds < 120; seconds += TICK_S) {
        const { linear, angular } = steerTo(goal, pose, limits);
        expect(Math.abs(linear.x)).toBeLessThanOrEqual(limits.maxLinear);
        expect(Math.abs(angular.z)).toBeLessThanOrEqual(limits.maxAngular);
        if (linear.x === 0 && angular.z === 0) break;
        pose.x += linear.x * Math.cos(pose.yaw) * TICK_S;
        pose.y += linear.x * Math.sin(pose.yaw) * TICK_S;
        pose.yaw += angular.z * TICK_S;
      }
      expect(Math.hypot(goal.x - pose.x, goal.y - pose.y)).toBeLessThanOrEqual(0.15);
      if (goal.yaw !== undefined) expect(Math.cos(goal.yaw - pose.yaw)).toBeGreaterThan(Math.cos(0.07));
    }),
    { seed: 5, numRuns: 200 },
  );
});

it('turns before it drives', () => {
  const behind = steerTo({ x: -2, y: 0.1 }, { x: 0, y: 0, yaw: 0 }, limits);
  expect(behind.linear.x).toBe(0);
  expect(behind.angular.z).toBe(0.8);
});
