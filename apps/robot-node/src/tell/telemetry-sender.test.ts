import { decodeJson, type NearField, nearFieldText, telemetryCodec, zeroTwist } from '@farpoint/protocol';
import { MotionSupervisor } from '@farpoint/safety';
import { makeGuard } from '@farpoint/safety/testing';
import { describe, expect, it } from 'vitest';
import { StageTimer } from '../ground/stage-timer.ts';
import { MotionStatus } from '../motion/drive/motion-status.ts';
import type { OperatorSession } from '../serve/session/operator-session.ts';
import { StageBoard } from './stage-board.ts';
import { TelemetryBoard } from './telemetry-board.ts';
import { TelemetrySender } from './telemetry-sender.ts';

const STEP_MS = 50;
const STREAM = {
  ...{ frameNumber: 0, framesPerSecond: 0, pointsPerFrame: 0, validPoints: 0 },
  ...{ bitsPerSecond: 0, targetBitsPerSecond: 0, droppedFrames: 0 },
};

/**
 * What one second of telemetry brings to an operator whose path has this rate.
 *
 * @param metres to what is before the robot, by the time, ms
 */
function secondAt(
  targetBitsPerSecond: number,
  metres: (nowMs: number) => number | null = () => null,
  driven = true,
): {
  states: number;
  topics: string[];
  samples: number;
  components: number;
  near: number;
  paths: number;
  alarms: unknown[];
  /** How many commands are told of in each message. */
  stages: number[];
} {
  const heard: string[] = [];
  const alarms: unknown[] = [];
  const stages = new StageBoard();
  const operator = {
    peer: { connected: true, sendTelemetry: (text: string) => heard.push(text) },
    sender: { targetBitsPerSecond },
    messages: { send: (message: unknown) => alarms.push(message), stages },
    status: (stages: unknown) => ({ stages, stream: STREAM }),
  } as unknown as OperatorSession;
  const guard = makeGuard();
  const quantity = {
    type: 'quantity',
    number: 0,
    topic: '/a',
    field: 'data',
    label: 'A',
    unit: 'V',
  } as const;
  const rule = { watches: '/a data', label: 'A', unit: 'V', high: { warn: 2 }, hysteresis: 0 };
  const board = new TelemetryBoard([quantity], [rule]);
  for (const topic of ['/a', '/b', '/c']) board.take({ topic, label: topic, level: 'ok', values: [] }, 0);
  const imu = { name: 'imu', level: 'ok', message: '', sinceMs: 0 } as const;
  board.components.take('/diagnostics', [imu], 0);
  const sender = new TelemetrySender(
    new Map([['operator', operator]]),
    new MotionStatus(new MotionSupervisor(guard), null),
    new StageTimer(),
    board,
    { driven, nearField: (nowMs) => nearAt(metres(nowMs), nowMs) },
  );
  const orientation = { x: 0, y: 0, z: 0, w: 1 };
  const state = { timeMs: 0, pose: { position: zeroTwist().linear, orientation }, twist: zeroTwist() };
  board.navigation.take(
    '/plan',
    {
      kind: 'path',
      points: [
        [0, 0],
        [1, 0],
      ],
    },
    0,
  );
  for (let i = 0; i < 20; i++) {
    board.sample('/a', [i / 5], i * STEP_MS);
    stages.command(i, i * STEP_MS, i * STEP_MS, null);
    sender.send({ ...state, battery: null, contact: false }, i * STEP_MS);
  }
  const messages = heard.map((text) => decodeJson(telemetryCodec, text));
  return {
    states: messages.filter(({ type }) => type === 'telemetry').length,
    topics: messages.flatMap((message) => (message.type === 'reading' ? [message.topic] : [])),
    samples: messages.flatMap((message) => (message.type === 'samples' ? message.samples : [])).length,
    components: messages.filter(({ type }) => type === 'diagnostics').length,
    near: messages.filter(({ type }) => type === 'nearField').length,
    paths: messages.filter(({ type }) => type === 'path').length,
    alarms,
    stages: messages.flatMap((message) => (message.type === 'stages' ? [message.commands.length] : [])),
  };
}

function nearAt(metres: number | null, timeMs: number): NearField | null {
  if (metres === null) return null;
  return {
    ...{ type: 'nearField', timeMs },
    sectors: nearFieldText([{ hit: { kind: 'thing', metres }, unseen: null }]),
  };
}

describe('TelemetrySender', () => {
  it('sends the state 20 times a second and each reading once', () => {
    const { states, topics } = secondAt(10e6);
    expect(states).toBe(20);
    expect(topics.sort()).toEqual(['/a', '/b', '/c']);
  });

  it('on a narrow path, sends the state less often, but still every reading', () => {
    const { states, topics } = secondAt(0.3e6);
    expect(states).toBe(5);
    expect(topics.sort()).toEqual(['/a', '/b', '/c']);
  });

  it('tells when commands passed the robot’s stations, four times a second, and once to a narrow path', () => {
    expect(secondAt(10e6).stages).toEqual([1, 5, 5, 5]);
    expect(secondAt(0.3e6).stages).toEqual([4]);
  });

  it('sends every sample, but only the newest of each quantity on a narrow path', () => {
    expect(secondAt(10e6)).toMatchObject({ samples: 20, components: 1 });
    expect(secondAt(0.3e6)).toMatchObject({ samples: 5, components: 0 });
  });

  it('sends what is near ten times a second while it changes, otherwise twice; to a narrow path, and while nobody drives, half as often', () => {
    const coming = (nowMs: number) => 2 - nowMs / 1000;
    expect([secondAt(10e6, coming).near, secondAt(0.3e6, coming).near]).toEqual([10, 5]);
    expect([secondAt(10e6, coming, false).near, secondAt(0.3e6, coming, false).near]).toEqual([5, 5]);
    const standing = () => 0.3;
    expect([secondAt(10e6, standing).near, secondAt(0.3e6, standing).near]).toEqual([2, 2]);
    expect(secondAt(10e6).near).toBe(0);
  });

  it('sends the navigator’s path to every operator, once a second at most', () => {
    expect([secondAt(10e6).paths, secondAt(0.3e6).paths]).toEqual([1, 1]);
  });

  it('sends an alarm once, when it is raised', () => {
    expect(secondAt(10e6).alarms).toMatchObject([{ type: 'alarm', level: 'warn', value: 2.2, limit: 2 }]);
  });
});
