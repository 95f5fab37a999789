import { type Twist, zeroTwist } from '@farpoint/protocol';
import { decoderOf, type TopicEntry } from '@farpoint/ros';
import { MemoryGraph } from '@farpoint/ros/testing';
import { describe, expect, it } from 'vitest';
import { RosVelocity } from './ros-velocity.ts';

const TWIST = 'geometry_msgs/msg/Twist';
const STAMPED = 'geometry_msgs/msg/TwistStamped';
const ahead = (x: number): Twist => ({ ...zeroTwist(), linear: { x, y: 0, z: 0 } });

function setUp(type = TWIST) {
  let nowMs = 1000;
  const graph = new MemoryGraph(2, () => nowMs);
  const entry: TopicEntry = { topic: '/cmd_vel', type, as: 'velocity', most: null };
  const wallNs = () => 1_700_000_000_000_000_000n + BigInt(nowMs) * 1_000_000n;
  const velocity = new RosVelocity(graph, { entry, silenceMs: 150, now: () => nowMs, wallNs });
  const decode = decoderOf(2, type, null);
  const messages = () => (graph.published.get('/cmd_vel') ?? []).map((bytes) => decode(bytes) as Twist);
  /** Advances time. The thread checks every 10 ms; the main thread applies `twist` every 40 ms, unless it is `null`. */
  const pass = (ms: number, twist: Twist | null, hold = false) => {
    for (let i = 0; i < ms; i += 10) {
      nowMs += 10;
      if (twist !== null && i % 40 === 30) velocity.apply(twist, hold);
      velocity.checkSilence();
    }
  };
  return { graph, velocity, messages, pass, xs: () => messages().map(({ linear }) => linear.x) };
}

describe('RosVelocity', () => {
  it('advertises the one topic as Nav2 does, and publishes nothing before it is driven', () => {
    const { graph, messages, pass } = setUp();
    pass(2000, zeroTwist());
    expect(graph.advertised).toEqual([
      { topic: '/cmd_vel', type: TWIST, qos: { reliability: 'reliable', durability: 'volatile', depth: 1 } },
    ]);
    expect(graph.subscribed).toEqual([]);
    expect(messages()).toEqual([]);
  });

  it('publishes at a steady rate while driven, then zeros for a second, then nothing, so that others can drive', () => {
    const { pass, xs } = setUp();
    pass(1000, ahead(0.4));
    expect(xs()).toEqual(Array(25).fill(0.4));
    pass(3000, zeroTwist());
    const after = xs().slice(25);
    expect(after.length).toBeGreaterThanOrEqual(23);
    expect(after.length).toBeLessThanOrEqual(26);
    expect(new Set(after)).toEqual(new Set([0]));
  });

  it('publishes zero by itself on silence, and then nothing', () => {
    const { velocity, pass, xs } = setUp();
    pass(400, ahead(0.4));
    const driven = xs().length;
    pass(140, null);
    expect(xs().length).toBe(driven);
    pass(20, null);
    expect(xs().slice(driven)).toEqual([0]);
    expect(velocity.silences).toBe(1);
    pass(5000, null);
    const zeros = xs().slice(driven);
    expect(new Set(zeros)).toEqual(new Set([0]));
    // From 1 s after the last motion, at the rate of driving.
    expect(zeros.length).toBeLessThanOrEqual(25);
    expect(zeros.length).toBeGreaterThanOrEqual(15);
    pass(1000, ahead(0.2));
    expect(xs().at(-1)).toBe(0.2);
  });

  it('publishes zeros while the emergency stop is latched, even if it never drove', () => {
    const { pass, xs } = setUp();
    pass(4000, zeroTwist(), true);
    expect(xs()).toEqual(Array(100).fill(0));
  });

  it('publishes a final zero when closed in motion, and nothing if others may be driving', () => {
    const moving = setUp();
    moving.pass(200, ahead(0.3));
    moving.velocity.close();
    expect(moving.xs().at(-1)).toBe(0);
    const standing = setUp();
    standing.pass(2000, zeroTwist());
    standing.velocity.close();
    expect(standing.xs()).toEqual([]);
  });

  it('stamps TwistStamped with the time of day and base_link', () => {
    const { pass, messages } = setUp(STAMPED);
    pass(40, ahead(0.25));
    expect(messages()).toMatchObject([
      { header: { frame_id: 'base_link', stamp: { sec: 1_700_000_001 } }, twist: ahead(0.25) },
    ]);
  });
});
