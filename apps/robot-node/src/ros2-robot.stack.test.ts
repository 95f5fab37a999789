/**
 * The real robot program between a ROS 2 graph of another implementation and an operator: processes, signaling,
 * WebRTC.
 */

import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { DdsGraph, isAvailable } from '@farpoint/dds';
import { findPeer, PEER_REMEDY, Peer, type PeerKind, testDomain } from '@farpoint/dds/testing';
import { LocalStack } from '@farpoint/local-stack';
import { readPictureFile } from '@farpoint/protocol';
import { messageBytes } from '@farpoint/ros/testing';
import { eventually } from '@farpoint/service/testing/eventually';
import { useFolder } from '@farpoint/service/testing/folder';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { monotonicMs } from './ground/clock.ts';
import { SignaledOperator } from './testing/signaled-operator.ts';
import { driveUntil } from './testing/steady-hand.ts';

const ROBOT = 'ros2-1';
const SIDE = 48;
const WATCHDOG_MS = 150;
/** The picture is requested reliably, because a busy machine's sockets lose parts of each large message. */
const CONFIGURATION = `
robot:
  source: { kind: ros2, axes: optical }
  sink: { kind: ros2 }
  ros: { domain: ${testDomain()}, reach: localhost }
  topics:
    - { topic: /points, as: cloud }
    - { topic: /front/image_raw, as: picture, label: Front, qos: { reliability: reliable } }
    - { topic: /cmd_vel, as: velocity }
`;

const kinds: PeerKind[] = ['Fast DDS', 'Python'];
for (const kind of kinds) {
  const command = isAvailable() ? findPeer(kind) : null;
  const note = isAvailable() ? PEER_REMEDY[kind] : 'apt-get install cyclonedds-dev; pnpm build:native dds';
  describe(`robot process in a ROS 2 graph with ${kind} (needs ${note})`, { skip: command === null }, () => {
    const folder = useFolder();
    let peer: Peer;
    let stack: LocalStack;
    let operator: SignaledOperator;

    beforeAll(async () => {
      const config = join(folder, 'farpoint.yaml');
      writeFileSync(config, CONFIGURATION);
      peer = await Peer.start(command as string[], {
        ...{ domain: testDomain(), cloud: 'rt/points', side: SIDE, hz: 20, twist: 'rt/cmd_vel' },
      });
      // At a fixed rate: a busy machine delays packets like a bad link, which then carries no pictures.
      const args = ['--config', config, '--watchdog-ms', String(WATCHDOG_MS), '--rate-control', 'fixed'];
      stack = await LocalStack.start({ robots: [{ id: ROBOT, name: 'Robot', args }] });
      operator = await SignaledOperator.connect(stack.signalingUrl, ROBOT);
    }, 60_000);

    afterAll(async () => {
      await operator?.close();
      await stack?.stop();
      await peer?.kill();
    }, 30_000);

    const speed = () => peer.twists.at(-1)?.x ?? null;

    it('streams the topic’s clouds', { timeout: 30_000 }, async () => {
      const { client } = operator;
      await client.until(() => client.completeFrames.filter(({ points }) => points > 100).length > 10);
      expect(client.malformedPackets).toBe(0);
    });

    it('shows a camera’s pictures', { timeout: 30_000 }, async () => {
      const { client } = operator;
      const graph = new DdsGraph({ domain: testDomain(), localhostOnly: true, now: monotonicMs });
      const type = 'sensor_msgs/msg/Image';
      const camera = graph.advertise({ topic: '/front/image_raw', type });
      const sides = { width: 800, height: 600, step: 2400, encoding: 'rgb8', is_bigendian: 0 };
      const header = { stamp: { sec: 0, nanosec: 0 }, frame_id: 'front' };
      const picture = messageBytes(2, type, {
        header,
        ...sides,
        data: new Uint8Array(2400 * 600).fill(200),
      });
      const timer = setInterval(() => camera.publish(picture), 250);
      try {
        expect((await client.message('cameras')).cameras).toEqual([{ name: 'Front' }]);
        // Nobody has requested it, so it is not subscribed.
        expect(camera.subscribers).toBe(0);
        client.sendSession({ type: 'pictures', cameras: [0] });
        await client.until(() => (client.pictures.get(0)?.pictureId ?? 0) >= 2);
        const { width, height, bytes } = client.pictures.get(0)!;
        expect(width / height).toBeCloseTo(4 / 3, 1);
        expect(width).toBeLessThanOrEqual(640);
        expect(readPictureFile(bytes)).toEqual({ format: 'jpeg', width, height });
        client.sendSession({ type: 'pictures', cameras: [] });
        await eventually(() => camera.subscribers === 0);
      } finally {
        clearInterval(timer);
        await graph.close();
      }
    });

    it('publishes the operator’s commands, zero on silence, and zero when it ends', {
      timeout: 30_000,
    }, async () => {
      const lease = await operator.client.takeLease();
      // After how many ms: watchdog.test.ts, ros-velocity.test.ts.
      await driveUntil(operator.client, lease, 0.25, () => speed() === 0.25);
      await eventually(() => speed() === 0);
      // The robot is alive: it obeys the next command.
      await driveUntil(operator.client, lease, 0.125, () => speed() === 0.125);
      expect(await stack.robot(ROBOT).stop()).toMatchObject({ code: 0 });
      await eventually(() => speed() === 0);
    });
  });
}
