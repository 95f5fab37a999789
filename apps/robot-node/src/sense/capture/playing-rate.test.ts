/** Checks that a recording plays with all of its clouds, by counting, and with its own clock. */
import { join } from 'node:path';
import { CloudPlayer } from '@farpoint/recording';
import {
  cloudMessage,
  mcapOfTopics,
  POINT_CLOUD2_SCHEMA,
  START_NS,
  writeFile,
} from '@farpoint/recording/testing';
import { useFolder } from '@farpoint/service/testing/folder';
import { EvenPace } from '@farpoint/timing';
import { expect, test } from 'vitest';
import { robotOf } from '../../program/options/testing/robot-of.ts';
import { FramePlanner } from '../encode/plan.ts';

const folder = useFolder();

const at = (ms: number) => START_NS + BigInt(Math.round(ms * 1000)) * 1000n;
/** Recorded all the time, unlike the clouds, which are recorded only while an operator watches. */
const telemetry = {
  ...{
    topic: '/farpoint/telemetry',
    type: 'telemetry',
    messageEncoding: 'json',
    schemaEncoding: 'jsonschema',
  },
  messages: Array.from({ length: 600 }, (_, k) => ({
    logNs: at(k * 50),
    data: new TextEncoder().encode('{}'),
  })),
};

/** As in a robot's recording that contains only clouds as sent. */
const unused = {
  ...{ topic: '/farpoint/captured', type: 'sensor_msgs/msg/PointCloud2', schema: POINT_CLOUD2_SCHEMA },
  messages: [],
};

async function recording(name: string, times: readonly number[]): Promise<string> {
  const messages = times.map((ms, k) => ({ logNs: at(ms), data: cloudMessage(k, 3) }));
  const clouds = {
    ...{
      topic: '/farpoint/sent',
      type: 'sensor_msgs/msg/PointCloud2',
      schema: POINT_CLOUD2_SCHEMA,
      messages,
    },
  };
  return writeFile(join(folder, name), await mcapOfTopics([telemetry, unused, clouds]));
}

/** The robot's default rate, and what the capture thread makes of it. */
async function play(
  path: string,
): Promise<{ framesPerSecond: number | null; played: number; taken: number }> {
  const { sensors } = robotOf(['--source', 'recording', '--path', path]);
  const { framesPerSecond: most } = sensors[0]!.capture;
  let nowMs = 0;
  const clock = {
    now: () => nowMs,
    wait: async (ms: number) => {
      nowMs += ms;
    },
  };
  const player = await CloudPlayer.open(
    { path, topic: null, rate: 1, fromS: 0, atEnd: 'stop', axes: 'auto' },
    clock,
  );
  const { framesPerSecond } = player.stream;
  const planner = new FramePlanner({
    policy: 'latency',
    mostFramesPerSecond: Math.min(most, framesPerSecond ?? most),
    ...{ anyRate: false, floorFraction: 0.1, mostPoints: 100_000 },
  });
  const pace = new EvenPace();
  let plannedMs = 1000 / most;
  const into = new Float32Array(player.stream.capacity * 4);
  let taken = 0;
  player.onCloud = () => {
    if (!pace.takes(nowMs, plannedMs) || player.take(into) === null) {
      player.skip();
      return;
    }
    taken++;
    const plan = planner.plan({
      ...{ targetBitsPerSecond: 40e6, rawPoints: 3, overheadBytes: 60, probeBytes: 0, workMs: 3 },
    });
    plannedMs = 1000 / plan.framesPerSecond;
    pace.taken(nowMs, plannedMs);
  };
  await player.run();
  await player.close();
  return { framesPerSecond, played: player.played, taken };
}

/** 60 clouds/s for 2 s, up to 3 ms early or late, like a busy camera's. */
const jittered = Array.from({ length: 120 }, (_, k) => 25_000 + (k * 1000) / 60 + ((k * 7) % 7) - 3);

test.each([
  ['steady', Array.from({ length: 60 }, (_, k) => (k * 1000) / 30), 30],
  ['that were recorded for 2 s of 30', Array.from({ length: 60 }, (_, k) => 20_000 + (k * 1000) / 30), 30],
  ['faster than a camera usually is', Array.from({ length: 120 }, (_, k) => 25_000 + (k * 1000) / 60), 60],
  ['few', Array.from({ length: 10 }, (_, k) => 10_000 + k * 200), 5],
])('clouds %s: none is left out', async (name, times, perSecond) => {
  const { framesPerSecond, played, taken } = await play(await recording(name, times));
  expect(framesPerSecond).toBeCloseTo(perSecond, 1);
  expect([played, taken]).toEqual([times.length, times.length]);
});

test('clouds at uneven intervals: hardly any is left out', async () => {
  const { taken } = await play(await recording('jittered', jittered));
  expect(taken).toBeGreaterThan(0.95 * jittered.length);
});

test('two formats of one capture count once', async () => {
  const times = Array.from({ length: 60 }, (_, k) => 10_000 + (k * 1000) / 30).flatMap((ms) => [ms, ms]);
  const { framesPerSecond } = await play(await recording('twice', times));
  expect(framesPerSecond).toBeCloseTo(30, 1);
});
