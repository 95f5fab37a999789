import { md5 } from '@foxglove/rosmsg';
import { MessageReader, MessageWriter } from '@foxglove/rosmsg-serialization';
import fc from 'fast-check';
import { describe, expect, it, test } from 'vitest';
import { definitionsOf } from './definitions.ts';
import { RosFault } from './fault.ts';
import { fixedMessage } from './fixed-message.ts';
import {
  actionTypes,
  cancelMessage,
  goalDefinitions,
  goalMessage,
  isLastStatus,
  readGoalStatus,
} from './goal-wire.ts';

const MOVE = 'move_base_msgs/MoveBase';
const move = goalDefinitions(MOVE, 'geometry_msgs/PoseStamped target_pose');

/** A result without fields of its own, as the library writes it. */
const result = new MessageWriter([
  {
    name: 'a/BActionResult',
    definitions: [
      { name: 'header', type: 'std_msgs/Header', isComplex: true },
      { name: 'status', type: 'actionlib_msgs/GoalStatus', isComplex: true },
    ],
  },
  ...(definitionsOf(1, 'std_msgs/Header') ?? []),
  ...(definitionsOf(1, 'actionlib_msgs/GoalStatus') ?? []),
]);
const stamp = { sec: 5, nsec: 6 };
const resultBytes = (id: string, status: number, text: string, frame = 'map') =>
  result.writeMessage({
    header: { seq: 1, stamp, frame_id: frame },
    status: { goal_id: { stamp, id }, status, text },
  });

describe('goals of ROS 1’s action servers', () => {
  it('have the sums that ROS computes for move_base_msgs', () => {
    expect(md5(move.goal)).toBe('257d089627d7eb7136c24d3593d05a16');
    expect(md5(move.action)).toBe('660d6895a1b9a16dce51fbdd9a64a56b');
    expect(actionTypes(MOVE)).toEqual({
      goal: 'move_base_msgs/msg/MoveBaseGoal',
      action: 'move_base_msgs/msg/MoveBaseActionGoal',
      feedback: 'move_base_msgs/msg/MoveBaseActionFeedback',
      result: 'move_base_msgs/msg/MoveBaseActionResult',
    });
  });

  it('are sent as the library reads them', () => {
    const value = { target_pose: { header: { frame_id: 'map' }, pose: { position: { x: 2.5 } } } };
    const goal = fixedMessage(1, actionTypes(MOVE).goal, value, move.goal);
    const bytes = goalMessage('farpoint-1', 1_700_000_000_250, goal);
    const read = new MessageReader(move.action).readMessage(bytes);
    const at = { sec: 1_700_000_000, nsec: 250_000_000 };
    expect(read).toMatchObject({
      header: { stamp: at },
      goal_id: { stamp: at, id: 'farpoint-1' },
      goal: value,
    });
    const cancel = new MessageReader(definitionsOf(1, 'actionlib_msgs/GoalID') ?? []).readMessage(
      cancelMessage('é-1'),
    );
    expect(cancel).toEqual({ stamp: { sec: 0, nsec: 0 }, id: 'é-1' });
  });

  test.each([
    ['an unknown type', 'other_msgs/Thing thing', /other_msgs\/Thing is not one of ROS/],
    ['no definition', 'what is this?', /cannot be read/],
  ])('with %s are refused', (_, text, message) => {
    expect(() => goalDefinitions('a/B', text)).toThrow(message);
    expect(() => goalDefinitions('a/B', text)).toThrow(RosFault);
  });

  test.each([
    [0, 'pending', false],
    [1, 'active', false],
    [2, 'cancelled', true],
    [3, 'done', true],
    [4, 'failed', true],
    [5, 'refused', true],
    [6, 'active', false],
    [7, 'active', false],
    [8, 'cancelled', true],
    [9, 'lost', true],
  ] as const)('with the status %i are %s', (code, state, isLast) => {
    const status = readGoalStatus(resultBytes('g', code, 'why'));
    expect(status).toEqual({ id: 'g', state, text: 'why' });
    expect(isLastStatus(status.state)).toBe(isLast);
  });

  it('are read whatever the texts are, and refused wherever they are cut', () => {
    fc.assert(
      fc.property(fc.string(), fc.string(), fc.string(), fc.nat(), (id, text, frame, cut) => {
        const bytes = resultBytes(id.toWellFormed(), 3, text.toWellFormed(), frame.toWellFormed());
        const { id: read } = readGoalStatus(bytes);
        expect(new TextEncoder().encode(read)).toEqual(new TextEncoder().encode(id.toWellFormed()));
        const short = bytes.subarray(0, cut % bytes.length);
        expect(() => readGoalStatus(short)).toThrow(RosFault);
      }),
      { seed: 1, numRuns: 200 },
    );
    expect(() => readGoalStatus(resultBytes('g', 10, ''))).toThrow(/the status 10/);
    expect(() => readGoalStatus(resultBytes('x'.repeat(4097), 3, ''))).toThrow(/4097 bytes/);
  });
});
