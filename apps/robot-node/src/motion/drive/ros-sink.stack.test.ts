/** The thread that publishes velocities, with a real master and a rospy subscriber. */

import { type Twist, zeroTwist } from '@farpoint/protocol';
import { topicTableSchema } from '@farpoint/ros';
import { Ros1Peers } from '@farpoint/ros/testing/ros1';
import type { Logger } from '@farpoint/service';
import { eventually } from '@farpoint/service/testing/eventually';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { RosSink } from './ros-sink.ts';

const { python, missing } = Ros1Peers.find();
const ahead: Twist = { ...zeroTwist(), linear: { x: 0.3, y: 0, z: 0 } };
const SILENCE_MS = 150;
const HANG_MS = 2000;

describe.skipIf(python === null)(`ROS sink (${missing ?? 'rosmaster, rospy'})`, { timeout: 60_000 }, () => {
  let peers: Ros1Peers;
  beforeAll(async () => {
    peers = await Ros1Peers.open(python ?? '');
    await peers.startCore();
  }, 60_000);
  afterAll(() => peers.close());

  it('publishes zero while the main thread hangs', async () => {
    const node = await peers.startNode('velocity', 'base');
    const [entry] = topicTableSchema.parse([{ topic: '/cmd_vel', as: 'velocity' }]);
    if (entry === undefined) throw new Error('no entry');
    const graph = { kind: 'ros1' as const, masterUrl: peers.masterUrl, name: 'sink', hostname: '127.0.0.1' };
    const warnings: unknown[] = [];
    const log = {
      info: () => {},
      warn: (...said: unknown[]) => warnings.push(said),
      error: (...said: unknown[]) => warnings.push(said),
    };
    const sink = new RosSink({ graph, entry, silenceMs: SILENCE_MS }, log as unknown as Logger);
    const timer = setInterval(() => sink.apply(ahead, false), 40);
    await eventually(() => node.heard.some(({ x }) => x === 0.3));
    const hangAt = Date.now();
    // Nothing runs in this thread meanwhile.
    Atomics.wait(new Int32Array(new SharedArrayBuffer(4)), 0, 0, HANG_MS);
    clearInterval(timer);
    await eventually(() => node.heard.some(({ x }) => x === 0));
    const firstZero = node.heard.find(({ x }) => x === 0)?.nodeMs ?? 0;
    expect(firstZero - hangAt).toBeGreaterThan(0);
    // It does not wait for the main thread. After how many ms: ros-velocity.test.ts.
    expect(firstZero - hangAt).toBeLessThan(HANG_MS);
    expect(warnings).toEqual([]);
    await sink.close();
    await node.kill();
  });
});
