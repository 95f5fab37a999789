/** Where tf says that a scanner sits on the robot. */
import type { TopicEntry } from '@farpoint/ros';
import { MemoryGraph } from '@farpoint/ros/testing';
import { describe, expect, it } from 'vitest';
import { SensorFrames } from './sensor-frames.ts';

const TYPE = 'tf2_msgs/msg/TFMessage';
const DAY_MS = 1.7e12;
const NO_TURN = { x: 0, y: 0, z: 0, w: 1 };

function start(base: string | null = null) {
  let nowMs = 1000;
  const graph = new MemoryGraph(2, () => nowMs);
  const faults: string[] = [];
  const entry = (topic: string): TopicEntry => ({ topic, type: TYPE, as: 'tf', most: null });
  const frames = new SensorFrames(
    graph,
    { topics: [entry('/tf'), entry('/tf_static')], base },
    { now: () => nowMs, wallNs: () => BigInt(Math.round((DAY_MS + nowMs) * 1e6)) },
    ({ message }) => faults.push(message),
  );
  return {
    ...{ frames, graph, faults },
    wait: (ms: number) => {
      nowMs += ms;
    },
    say: (topic: string, parent: string, child: string, x: number, stampMs = nowMs) => {
      const ns = BigInt(Math.round((DAY_MS + stampMs) * 1e6));
      const stamp = { sec: Number(ns / 1_000_000_000n), nanosec: Number(ns % 1_000_000_000n) };
      const transform = { translation: { x, y: 0, z: 0 }, rotation: NO_TURN };
      const transforms = [{ header: { stamp, frame_id: parent }, child_frame_id: child, transform }];
      graph.say(topic, TYPE, { transforms });
    },
  };
}

describe('a scanner’s frame', () => {
  it('is unknown until tf says it', () => {
    const { frames, say } = start();
    expect(frames.mountOf('laser', 1000)).toBeNull();
    say('/tf_static', 'base_link', 'laser', 0.2);
    expect(frames.mountOf('laser', 1000)?.position).toEqual({ x: 0.2, y: 0, z: 0 });
    expect(frames.mountOf('/laser', 1000)?.orientation).toEqual(NO_TURN);
    expect(frames.mountOf('rear', 1000)).toBeNull();
  });

  it('lies in the base, wherever that drives', () => {
    const { frames, say, wait } = start();
    say('/tf_static', 'base_link', 'laser', 0.2);
    for (const x of [5, 6]) {
      say('/tf', 'odom', 'base_link', x);
      wait(20);
    }
    expect(frames.mountOf('laser', 1010)?.position.x).toBeCloseTo(0.2);
  });

  it('is placed over links between', () => {
    const { frames, say } = start();
    say('/tf_static', 'base_footprint', 'base_link', 0);
    say('/tf_static', 'base_link', 'mast', 0.1);
    say('/tf_static', 'mast', 'laser', 0.2);
    expect(frames.mountOf('laser', 1000)?.position.x).toBeCloseTo(0.3);
  });

  it('of another robot in the same graph says nothing', () => {
    const { frames, say } = start('robot1/base_link');
    say('/tf_static', 'robot2/base_link', 'laser', 0.2);
    expect(frames.mountOf('laser', 1000)).toBeNull();
    say('/tf_static', 'robot1/base_link', 'robot1/laser', 0.4);
    expect(frames.mountOf('robot1/laser', 1000)?.position.x).toBe(0.4);
  });

  it('survives what is no transform, and stamps that are refused', () => {
    const { frames, say, graph, faults } = start();
    say('/tf_static', 'base_link', 'laser', 0.2);
    say('/tf', 'odom', 'base_link', 1);
    say('/tf', 'odom', 'base_link', 9, 5000);
    say('/tf_static', 'base_link', 'laser', Number.NaN);
    graph.sayBytes('/tf', new Uint8Array(3));
    expect(frames.mountOf('laser', 1000)?.position.x).toBeCloseTo(0.2);
    expect(faults).toHaveLength(1);
  });
});
