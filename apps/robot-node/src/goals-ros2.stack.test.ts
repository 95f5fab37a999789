/** Goals in a ROS 2 graph: a navigator gets them, and its velocities pass the guard only while the driver holds on. */
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { isAvailable } from '@farpoint/dds';
import { testDomain } from '@farpoint/dds/testing';
import { LocalStack } from '@farpoint/local-stack';
import { zeroTwist } from '@farpoint/protocol';
import { decoderOf, GOAL_POSE_TYPE, velocityWriter } from '@farpoint/ros';
import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { GoalHand } from './testing/goal-hand.ts';
import { Ros2Base } from './testing/ros2-base.ts';
import { SignaledOperator } from './testing/signaled-operator.ts';

const ID = 'ros2-goals';
const configuration = `
robot:
  source: { kind: ros2 }
  sink: { kind: ros2 }
  ros: { domain: ${testDomain()}, reach: localhost }
  topics:
    - { topic: /points, as: cloud }
    - { topic: /odom, as: pose, type: nav_msgs/msg/Odometry }
    - { topic: /tf_static, as: tf }
    - { topic: /cmd_vel, as: velocity }
  guard: { mount: "0,0,1,0,0,0" }
  goals: { navigator: ros }
  limits: { watchdogMs: 800 }
  motion: { viewSlowMs: 1000, viewBrakeMs: 2500, viewStallMs: 1500 }
`;
interface GoalPose {
  header: { frame_id: string };
  pose: { position: { x: number; y: number } };
}

const until = async (is: () => boolean) => {
  while (!is()) await new Promise((resolve) => setTimeout(resolve, 5));
};

describe('a robot with a navigator in a ROS 2 graph', { skip: !isAvailable(), timeout: 120_000 }, () => {
  let folder: string;
  let base: Ros2Base;
  let stack: LocalStack;
  let operator: SignaledOperator | null = null;
  let navigating: NodeJS.Timeout;
  let speed = 0;
  const goals: GoalPose[] = [];

  beforeEach(async () => {
    folder = mkdtempSync(join(tmpdir(), 'farpoint-goals-ros2-'));
    base = new Ros2Base(testDomain());
    const decode = decoderOf(2, GOAL_POSE_TYPE, null);
    base.graph.subscribe({ topic: '/goal_pose', type: GOAL_POSE_TYPE, queue: 16 }, (bytes) =>
      goals.push(decode(bytes) as GoalPose),
    );
    const publisher = base.graph.advertise({ topic: '/cmd_vel_nav', type: 'geometry_msgs/msg/Twist' });
    const write = velocityWriter(2, 'geometry_msgs/msg/Twist');
    // A navigator that hears nothing and drives on for ever.
    navigating = setInterval(() => {
      const twist = { ...zeroTwist(), linear: { x: speed, y: 0, z: 0 } };
      publisher.publish(write(twist, 0n, ''));
    }, 50);
    const config = join(folder, 'farpoint.yaml');
    writeFileSync(config, configuration);
    const args = ['--config', config, '--rate-control', 'fixed'];
    stack = await LocalStack.start({ robots: [{ id: ID, name: 'Robot', args }] });
  }, 60_000);
  afterEach(async () => {
    clearInterval(navigating);
    await operator?.close().catch(() => undefined);
    await stack.stop();
    await base.close();
    rmSync(folder, { recursive: true, force: true });
  });

  it('passes the velocities on while its driver holds on to a goal, and at no other time', async () => {
    speed = 0.2;
    operator = await SignaledOperator.connect(stack.signalingUrl, ID);
    const { client } = operator;
    const hand = await GoalHand.of(client);
    try {
      const { sequence } = client.telemetry ?? { sequence: 0 };
      await client.until(() => (client.telemetry?.sequence ?? 0) >= sequence + 20);
      expect(base.x).toBe(0);
      hand.go(1);
      await hand.until(() => base.x > 0.2);
      expect(goals[0]).toMatchObject({ header: { frame_id: 'odom' }, pose: { position: { x: 1, y: 0 } } });
      expect(client.session.filter(({ type }) => type === 'goalState')).toHaveLength(2);
      hand.letGo();
      expect((await hand.told('cancelled')).reason).toBe('silence');
      await until(() => base.speed === 0);
      // The navigator's goal is where the robot is, although this one does not hear it.
      await until(() => goals.length === 2);
      expect(goals[1]?.pose.position.x).toBeLessThan(0.7);
      const stood = base.x;
      expect(stood).toBeLessThan(0.7);
      const { sequence: then } = client.telemetry ?? { sequence: 0 };
      await client.until(() => (client.telemetry?.sequence ?? 0) >= then + 20);
      expect(base.x).toBe(stood);
      hand.go(1 - stood);
      await hand.until(() => base.x > 0.85);
      speed = 0;
      await hand.told('reached');
    } finally {
      hand.letGo();
    }
  });

  it('stops before what is in its way, whatever the navigator says', async () => {
    speed = 0.3;
    base.person = [1.2, 1.4];
    operator = await SignaledOperator.connect(stack.signalingUrl, ID);
    const hand = await GoalHand.of(operator.client);
    try {
      hand.go(3);
      expect((await hand.told('blocked')).reason).toBe('obstacle');
      await until(() => base.speed === 0);
      expect(base.x).toBeLessThan(1.2 - 0.25);
    } finally {
      hand.letGo();
    }
  });
});
