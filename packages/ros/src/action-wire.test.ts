import { MessageReader } from '@foxglove/rosmsg2-serialization';
import fc from 'fast-check';
import { describe, expect, it, test } from 'vitest';
import {
  actionServices,
  cancelRequest,
  feedbackGoal,
  goalRequest,
  readCancelReply,
  readGoalReply,
  readGoalSteps,
  readResultStep,
  resultRequest,
} from './action-wire.ts';
import { RosFault } from './fault.ts';
import { fixedMessage } from './fixed-message.ts';
import { ros2GoalDefinitions } from './goal-wire.ts';

const ID = Uint8Array.from({ length: 16 }, (_, i) => i + 1);
const CDR = [0, 1, 0, 0];
const NAVIGATE = 'nav2_msgs/NavigateToPose';

/** One state of a goal: 16 bytes, zeros up to the fourth byte, the time, the status. */
const state = (id: Uint8Array, status: number, padding: number) => [
  ...id,
  ...Array<number>(padding).fill(0),
  ...[5, 0, 0, 0, 6, 0, 0, 0],
  status,
];

describe('goals of ROS 2’s action servers', () => {
  it('have services and topics of their own below the action’s name', () => {
    expect(actionServices('/dock', 'robot_msgs/action/Dock')).toEqual({
      send: {
        service: '/dock/_action/send_goal',
        request: 'robot_msgs/action/Dock_SendGoal_Request',
        reply: 'robot_msgs/action/Dock_SendGoal_Response',
      },
      cancel: {
        service: '/dock/_action/cancel_goal',
        request: 'action_msgs/srv/CancelGoal_Request',
        reply: 'action_msgs/srv/CancelGoal_Response',
      },
      result: {
        service: '/dock/_action/get_result',
        request: 'robot_msgs/action/Dock_GetResult_Request',
        reply: 'robot_msgs/action/Dock_GetResult_Response',
      },
      feedback: { topic: '/dock/_action/feedback', type: 'robot_msgs/action/Dock_FeedbackMessage' },
      status: { topic: '/dock/_action/status', type: 'action_msgs/msg/GoalStatusArray' },
    });
  });

  it('are sent with their identifier first', () => {
    const goal = Uint8Array.of(...CDR, 3);
    expect([...goalRequest(ID, goal)]).toEqual([...CDR, ...ID, 3]);
    expect([...resultRequest(ID)]).toEqual([...CDR, ...ID]);
    expect([...cancelRequest(ID)]).toEqual([...CDR, ...ID, 0, 0, 0, 0, 0, 0, 0, 0]);
  });

  it('are encoded as the library reads them, with numbers of eight bytes', () => {
    const text = 'uint8 FAST=1\ngeometry_msgs/PoseStamped pose\nstring tree "none"\nfloat64[] at';
    const definitions = ros2GoalDefinitions(NAVIGATE, text);
    const value = { pose: { header: { frame_id: 'map' }, pose: { position: { x: 2.5 } } }, at: [1, 2] };
    const goal = fixedMessage(2, NAVIGATE, value, definitions);
    const [own, ...parts] = definitions;
    const request = {
      name: 'request',
      definitions: [
        { name: 'id', type: 'uint8', isArray: true, arrayLength: 16 },
        ...(own?.definitions ?? []),
      ],
    };
    const read = new MessageReader([request, ...parts]).readMessage<Record<string, unknown>>(
      goalRequest(ID, goal),
    );
    expect(read).toMatchObject({
      id: ID,
      pose: { header: { frame_id: 'map' }, pose: { position: { x: 2.5, y: 0 } } },
      tree: '',
      at: Float64Array.of(1, 2),
    });
  });

  it('without fields have one byte, as ROS 2 writes it', () => {
    const empty = ros2GoalDefinitions('a/B', 'uint8 ONLY_A_CONSTANT=1');
    expect([...fixedMessage(2, 'a/B', {}, empty)]).toEqual([...CDR, 0]);
  });

  test.each([
    ['an unknown type', 'other_msgs/msg/Thing thing', /other_msgs\/Thing is not one of ROS/],
    ['wide texts', 'wstring name', /wstring is not supported/],
    ['no definition', 'what is this?', /cannot be read/],
  ])('with %s are refused', (_, text, message) => {
    expect(() => ros2GoalDefinitions('a/B', text)).toThrow(message);
    expect(() => ros2GoalDefinitions('a/B', text)).toThrow(RosFault);
  });

  it('are accepted or refused, and cancelled or not, by a first byte', () => {
    const time = [0, 0, 0, 5, 0, 0, 0, 6, 0, 0, 0];
    expect(readGoalReply(Uint8Array.of(...CDR, 1, ...time))).toBe(true);
    expect(readGoalReply(Uint8Array.of(...CDR, 0, ...time))).toBe(false);
    const none = [0, 0, 0, 0, 0, 0, 0];
    const one = [0, 0, 0, 1, 0, 0, 0, ...ID, 5, 0, 0, 0, 6, 0, 0, 0];
    expect(readCancelReply(Uint8Array.of(...CDR, 0, ...one))).toBe(true);
    expect(readCancelReply(Uint8Array.of(...CDR, 0, ...none))).toBe(false);
    expect(readCancelReply(Uint8Array.of(...CDR, 1, ...one))).toBe(false);
  });

  test.each([
    [0, 'unknown'],
    [1, 'accepted'],
    [2, 'running'],
    [3, 'cancelling'],
    [4, 'done'],
    [5, 'cancelled'],
    [6, 'failed'],
  ])('with the status %i are %s', (status, step) => {
    expect(readResultStep(Uint8Array.of(...CDR, status, 9, 9))).toBe(step);
  });

  it('tell how they go, several at a time', () => {
    const other = ID.map((byte) => byte + 100);
    const bytes = Uint8Array.of(...CDR, 2, 0, 0, 0, ...state(ID, 2, 0), ...state(other, 6, 3));
    expect(readGoalSteps(bytes)).toEqual([
      { id: ID, step: 'running' },
      { id: other, step: 'failed' },
    ]);
    expect(feedbackGoal(Uint8Array.of(...CDR, ...ID, 1, 2, 3))).toEqual(ID);
  });

  it('are read up to a bound, and refused where they are none', () => {
    // Each begins three bytes before the next number.
    const many = Array.from({ length: 1025 }, (_, i) => state(ID, 4, i === 0 ? 0 : 3)).flat();
    expect(readGoalSteps(Uint8Array.from([...CDR, 1, 4, 0, 0, ...many]))).toHaveLength(1024);
    expect(() => readGoalSteps(Uint8Array.of(...CDR, 255, 255, 255, 255))).toThrow(/cut short/);
    expect(() => readResultStep(Uint8Array.of(...CDR, 7))).toThrow(/the status 7/);
    expect(() => readResultStep(Uint8Array.of(...CDR, 255))).toThrow(/the status -1/);
  });

  it('whatever is said, nothing but a fault is thrown', () => {
    const readers = [readGoalReply, readCancelReply, readResultStep, feedbackGoal, readGoalSteps] as const;
    fc.assert(
      fc.property(fc.constantFrom(...readers), fc.uint8Array({ maxLength: 80 }), (read, bytes) => {
        for (const each of [bytes, Uint8Array.of(...CDR, ...bytes)]) {
          try {
            read(each);
          } catch (error) {
            expect(error).toBeInstanceOf(RosFault);
          }
        }
      }),
    );
  });
});
