import type { Fence, FencePose } from '@farpoint/safety';
import { expect, it } from 'vitest';
import { goalInFence } from './goal-in-fence.ts';

const fence: Fence = { allowed: [], forbidden: [], slow: [], radiusM: 10 };
const pose: FencePose = { x: 4, y: 0, yaw: 0, linear: 0, angular: 0, errorM: 0.1, atMs: 0 };
const robot = { x: 4, y: 0 };

it('permits what the whole robot fits into', () => {
  expect(goalInFence(fence, 0.5, pose, robot, { x: 9.3, y: 0 })).toBeNull();
  expect(goalInFence(fence, 0.5, pose, robot, { x: 9.5, y: 0 })).toBe('outside-fence');
  expect(goalInFence(fence, 0.5, pose, robot, { x: Number.NaN, y: 0 })).toBe('outside-fence');
  expect(goalInFence(fence, 0.5, null, robot, { x: 0, y: 0 })).toBe('no-pose');
});

it('takes the worst direction where it is not known', () => {
  const located = { ...pose, yaw: null };
  expect(goalInFence(fence, 0.5, located, { x: 0, y: 0 }, { x: -5.3, y: 0 })).toBeNull();
  expect(goalInFence(fence, 0.5, located, { x: 0, y: 0 }, { x: -5.5, y: 0 })).toBe('outside-fence');
});
