import { expect, it } from 'vitest';
import { GOAL_POSE_TYPE, goalPoseWriter } from './goal-pose.ts';
import { decoderOf } from './message-decoder.ts';

it.each([1, 2] as const)('a goal of ROS %i has its frame, its stamp and a turn about z', (version) => {
  const write = goalPoseWriter(version);
  const bytes = write({ x: 4.25, y: -1.5, yaw: Math.PI / 2 }, 1_700_000_000_000_000_009n, 'odom');
  const half = Math.SQRT1_2;
  expect(decoderOf(version, GOAL_POSE_TYPE, null)(bytes)).toMatchObject({
    header: { frame_id: 'odom', stamp: { sec: 1_700_000_000 } },
    pose: {
      position: { x: 4.25, y: -1.5, z: 0 },
      orientation: { x: 0, y: 0, z: expect.closeTo(half), w: expect.closeTo(half) },
    },
  });
});
