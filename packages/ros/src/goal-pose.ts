/** A goal as Nav2's bt_navigator and move_base take it: geometry_msgs/PoseStamped. */
import { nextSequence32 } from '@farpoint/protocol';
import { MessageWriter as Ros1Writer } from '@foxglove/rosmsg-serialization';
import { MessageWriter as Ros2Writer } from '@foxglove/rosmsg2-serialization';
import { definitionsOf } from './definitions.ts';
import { RosFault } from './fault.ts';

export const GOAL_POSE_TYPE = 'geometry_msgs/msg/PoseStamped';

/** @param goal m and rad, in the frame */
export type GoalPoseWriter = (
  goal: Readonly<{ x: number; y: number; yaw: number }>,
  stampNs: bigint,
  frameId: string,
) => Uint8Array;

export function goalPoseWriter(version: 1 | 2): GoalPoseWriter {
  const definitions = definitionsOf(version, GOAL_POSE_TYPE);
  if (definitions === null) throw new RosFault('unsupported', GOAL_POSE_TYPE);
  const writer = version === 1 ? new Ros1Writer(definitions) : new Ros2Writer(definitions);
  let seq = 0;
  return ({ x, y, yaw }, stampNs, frame_id) => {
    const sec = Number(stampNs / 1_000_000_000n);
    const nsec = Number(stampNs % 1_000_000_000n);
    seq = nextSequence32(seq);
    const orientation = { x: 0, y: 0, z: Math.sin(yaw / 2), w: Math.cos(yaw / 2) };
    // Each writer uses the field names of its own version.
    const header = { seq, stamp: { sec, nsec, nanosec: nsec }, frame_id };
    return writer.writeMessage({ header, pose: { position: { x, y, z: 0 }, orientation } });
  };
}
