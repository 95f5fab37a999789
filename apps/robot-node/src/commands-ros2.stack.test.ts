/** A robot command at the real robot program in a ROS 2 graph: a topic hears just the message that is configured. */
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { DdsGraph, isAvailable } from '@farpoint/dds';
import { testDomain } from '@farpoint/dds/testing';
import { LocalStack } from '@farpoint/local-stack';
import { RELIABLE_QOS } from '@farpoint/ros';
import { eventually } from '@farpoint/service/testing/eventually';
import { useFolder } from '@farpoint/service/testing/folder';
import { expect, it } from 'vitest';
import { SignaledOperator } from './testing/signaled-operator.ts';

const ID = 'ros2-commands';
const folder = useFolder();
const configuration = `
robot:
  sink: { kind: ros2 }
  ros: { domain: ${testDomain()}, reach: localhost }
  topics: [{ topic: /cmd_vel, as: velocity }]
  commands:
    - id: preset
      label: Camera preset
      who: drive
      perSecond: 10
      publish: { topic: /preset, type: std_msgs/String, message: { data: gate } }
`;

it('publishes a command’s message in a ROS 2 graph', { skip: !isAvailable(), timeout: 60_000 }, async () => {
  const graph = new DdsGraph({ domain: testDomain(), localhostOnly: true });
  const heard: Uint8Array[] = [];
  graph.subscribe({ topic: '/preset', type: 'std_msgs/msg/String', qos: RELIABLE_QOS, queue: 8 }, (bytes) =>
    heard.push(bytes.slice()),
  );
  // Without wheels, the robot is not ready.
  graph.subscribe({ topic: '/cmd_vel', type: 'geometry_msgs/msg/Twist', queue: 1 }, () => undefined);
  const config = join(folder, 'farpoint.yaml');
  writeFileSync(config, configuration);
  const args = ['--config', config, '--rate-control', 'fixed', '--sim-size', '64'];
  const stack = await LocalStack.start({ robots: [{ id: ID, name: 'Robot', args }] });
  try {
    const operator = await SignaledOperator.connect(stack.signalingUrl, ID);
    const { client } = operator;
    let request = 0;
    await eventually(async () => {
      const own = ++request;
      client.sendSession({ type: 'callCommand', id: 'preset', request: own, timeMs: performance.now() });
      const { state } = await client.message(
        'commandRun',
        (each) => each.request === own && each.state !== 'running',
      );
      return state === 'done';
    });
    await eventually(() => heard.length > 0);
    // CDR: after its kind, the length with the final zero, and the text.
    expect([...(heard[0] ?? [])].slice(4, 13)).toEqual([5, 0, 0, 0, ...Buffer.from('gate\0')]);
    await operator.close();
  } finally {
    await stack.stop();
    await graph.close();
  }
});
