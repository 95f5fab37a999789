/** A stop by a topic in a ROS 2 graph, at the real robot program. */
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { DdsGraph, isAvailable as isDdsAvailable } from '@farpoint/dds';
import { testDomain } from '@farpoint/dds/testing';
import { messageBytes } from '@farpoint/ros/testing';
import { describe, it } from 'vitest';
import { monotonicMs } from './ground/clock.ts';
import { CLEAR, HELD, untilReading, untilState, useStoppedRobot } from './testing/use-stopped-robot.ts';

const robot = useStoppedRobot();

describe('a topic in a ROS 2 graph', { skip: !isDdsAvailable(), timeout: 60_000 }, () => {
  it('stops when it is true, silent, or gone', async () => {
    const graph = new DdsGraph({ domain: testDomain(), localhostOnly: true, now: monotonicMs });
    robot.ending.push(() => graph.close());
    const type = 'std_msgs/msg/Bool';
    let publisher = graph.advertise({ topic: '/stop', type });
    let says: boolean | null = false;
    const publishing = setInterval(() => {
      if (says !== null) publisher.publish(messageBytes(2, type, { data: says }));
    }, 50);
    robot.ending.push(() => clearInterval(publishing));
    const config = join(robot.folder, 'farpoint.yaml');
    writeFileSync(
      config,
      `robot:
  sink: { kind: ros2 }
  ros: { domain: ${testDomain()}, reach: localhost }
  topics: [{ topic: /cmd_vel, as: velocity }]
  stops: { topic: /stop }
`,
    );
    const wheels = graph.subscribe(
      { topic: '/cmd_vel', type: 'geometry_msgs/msg/Twist', queue: 4 },
      () => undefined,
    );
    robot.ending.push(() => wheels.close());
    const { driver } = await robot.start(['--config', config]);
    const { client } = driver;
    await untilState(client, CLEAR);
    says = true;
    await untilState(client, HELD);
    says = false;
    await untilState(client, CLEAR);
    says = null;
    await untilState(client, HELD);
    await untilReading(client, 'topic', 'error');
    says = false;
    await untilState(client, CLEAR);
    publisher.close();
    says = null;
    await untilState(client, HELD);
    publisher = graph.advertise({ topic: '/stop', type });
    says = false;
    await untilState(client, CLEAR);
  });
});
