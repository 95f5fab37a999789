/** Laser scans and a collision topic of a ROS 2 graph, at the real robot program. */
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { DdsGraph, isAvailable } from '@farpoint/dds';
import { testDomain } from '@farpoint/dds/testing';
import { LocalStack } from '@farpoint/local-stack';
import type { Intervention } from '@farpoint/protocol';
import { messageBytes } from '@farpoint/ros/testing';
import { testFolder } from '@farpoint/service/testing/folder';
import { describe, expect, it, onTestFinished } from 'vitest';
import { monotonicMs } from './ground/clock.ts';
import { SignaledOperator } from './testing/signaled-operator.ts';

const ID = 'sim-1';
const SCAN = 'sensor_msgs/msg/LaserScan';
const BOOL = 'std_msgs/msg/Bool';
const RAYS = 360;

/** Not stamped: the arrival counts. */
function scanOf(range: number) {
  return {
    header: { stamp: { sec: 0, nanosec: 0 }, frame_id: 'laser' },
    ...{ angle_min: -Math.PI, angle_max: Math.PI, angle_increment: (2 * Math.PI) / RAYS },
    ...{ time_increment: 0, scan_time: 0.05, range_min: 0.1, range_max: 12, intensities: [] },
    ranges: new Array<number>(RAYS).fill(range),
  };
}

describe('a robot with a laser scanner and a collision topic', {
  skip: !isAvailable(),
  timeout: 60_000,
}, () => {
  it('stops for either, says which, and moves on when it is free', async () => {
    const graph = new DdsGraph({ domain: testDomain(), localhostOnly: true, now: monotonicMs });
    onTestFinished(() => graph.close());
    const scans = graph.advertise({ topic: '/scan', type: SCAN });
    const demands = graph.advertise({ topic: '/collision', type: BOOL });
    graph.subscribe({ topic: '/cmd_vel', type: 'geometry_msgs/msg/Twist', queue: 4 }, () => undefined);
    let range = 3;
    let stop: boolean | null = false;
    const publishing = setInterval(() => {
      scans.publish(messageBytes(2, SCAN, scanOf(range)));
      if (stop !== null) demands.publish(messageBytes(2, BOOL, { data: stop }));
    }, 50);
    onTestFinished(() => clearInterval(publishing));
    const folder = testFolder();
    const config = join(folder, 'farpoint.yaml');
    writeFileSync(
      config,
      `robot:
  sink: { kind: ros2 }
  ros: { domain: ${testDomain()}, reach: localhost }
  topics: [{ topic: /cmd_vel, as: velocity }]
  guard:
    scans: [{ topic: /scan, mount: "0,0,0.3,0,0,0" }]
    collision: { topic: /collision }
`,
    );
    const args = ['--rate-control', 'fixed', '--sim-size', '64', '--max-points', '600', '--config', config];
    const stack = await LocalStack.start({ robots: [{ id: ID, name: 'Robot', args }] });
    onTestFinished(() => stack.stop());
    const { client } = await SignaledOperator.connect(stack.signalingUrl, ID).then((operator) => {
      onTestFinished(() => operator.close());
      return operator;
    });
    const lease = await client.takeLease();
    client.drive(lease, 0);
    const driving = setInterval(() => client.drive(lease, 0.1), 20);
    onTestFinished(() => clearInterval(driving));
    const until = (reason: Intervention | null) =>
      client.until(() => {
        const { motion, drive } = client.telemetry ?? {};
        if (reason === null) return drive === 'driving' && motion?.factor === 1;
        return motion?.reasons.includes(reason) === true;
      });
    await until(null);
    stop = true;
    await until('collision-topic');
    await client.until(() => client.telemetry?.drive === 'blocked');
    stop = false;
    await until(null);
    range = 0.35;
    await until('obstacle');
    const about = async () => (await fetch(`${stack.robotAdminUrl(ID)}/healthz`)).json();
    expect(await about()).toMatchObject({
      checks: { guard: { ok: true, detail: { state: 'on', reason: 'obstacle', collision: 'free' } } },
    });
    range = 3;
    await until(null);
    stop = null;
    await until('collision-silent');
    expect(await about()).toMatchObject({
      checks: {
        guard: {
          ok: false,
          detail: {
            collision: 'silent',
            sensors: [
              { name: 'Camera' },
              { name: 'Camera, floor ahead' },
              { name: 'Camera, floor behind' },
              { name: '/scan' },
            ],
          },
        },
      },
    });
    const metrics = await (await fetch(`${stack.robotAdminUrl(ID)}/metrics`)).text();
    expect(metrics).toContain('farpoint_robot_guard_sensor_live{sensor="/scan"} 1');
    expect(metrics).toContain('farpoint_robot_collision_topic{state="silent"} 1');
    expect(metrics).toMatch(/interventions[^\n]*reason="collision-topic"[^\n]* 1\n/);
  });
});
