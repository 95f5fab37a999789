/** A robot that comes back without operators, in a ROS 2 graph in which people stand in its way. */
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { isAvailable } from '@farpoint/dds';
import { testDomain } from '@farpoint/dds/testing';
import { LocalStack } from '@farpoint/local-stack';
import { eventually } from '@farpoint/service/testing/eventually';
import { testFolder } from '@farpoint/service/testing/folder';
import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { metricOf } from './testing/metric-of.ts';
import { Ros2Base } from './testing/ros2-base.ts';
import { SignaledOperator } from './testing/signaled-operator.ts';

const ID = 'ros2-return';
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
  limits: { leaseSilenceS: 1 }
  return: { enabled: true, afterS: 5, announceS: 1, topic: /returning }
`;
/** Half the robot, m. */
const RADIUS = 0.25;

describe('a robot in a ROS 2 graph', { skip: !isAvailable(), timeout: 120_000 }, () => {
  let folder: string;
  let base: Ros2Base;
  let stack: LocalStack;
  let operator: SignaledOperator | null = null;
  const said: boolean[] = [];

  beforeEach(async () => {
    folder = testFolder();
    base = new Ros2Base(testDomain());
    const to = { topic: '/returning', type: 'std_msgs/msg/Bool', queue: 16 };
    base.graph.subscribe(to, (bytes) => void said.push(bytes[4] === 1));
    const config = join(folder, 'farpoint.yaml');
    writeFileSync(config, configuration);
    const args = ['--config', config, '--rate-control', 'fixed'];
    stack = await LocalStack.start({ robots: [{ id: ID, name: 'Robot', args }] });
  }, 60_000);
  afterEach(async () => {
    await operator?.close().catch(() => undefined);
    await stack.stop();
    await base.close();
  }, 30_000);

  it('says so on a topic, stands before somebody in its way, and comes back when the way is free', async () => {
    operator = await SignaledOperator.connect(stack.signalingUrl, ID);
    const { client } = operator;
    const lease = await client.takeLease();
    client.drive(lease, 0);
    const timer = setInterval(() => client.drive(lease, 0.5), 20);
    await eventually(() => base.x > 2);
    clearInterval(timer);
    client.drive(lease, 0);
    await eventually(() => base.speed === 0);
    expect(said).not.toContain(true);
    await operator.vanish();
    base.person = [0.6, 1];
    await eventually(() => said.at(-1) === true);
    await eventually(() => base.speed < 0);
    await eventually(() => base.speed === 0 && base.x < 1.6);
    const stood = base.x;
    expect(stood - RADIUS).toBeGreaterThan(1.03);
    const seen = base.clouds;
    await eventually(() => base.clouds > seen + 20);
    expect(base.x).toBeCloseTo(stood, 2);
    expect(said.at(-1)).toBe(true);
    base.person = null;
    await eventually(() => said.at(-1) === false && base.speed === 0);
    expect(Math.abs(base.x)).toBeLessThan(0.15);
    expect(base.lowest).toBeGreaterThanOrEqual(-0.2);
    const ended = 'farpoint_robot_return_ended_total{reason="track-end"}';
    expect(await metricOf(stack.robotAdminUrl(ID), ended)).toBe(1);
  });
});
