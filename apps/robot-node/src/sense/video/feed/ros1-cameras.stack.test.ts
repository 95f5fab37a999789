/** Cameras of a real ROS 1 graph: a master, and rospy nodes. */
import type { TopicEntry } from '@farpoint/ros';
import { Ros1Peers } from '@farpoint/ros/testing/ros1';
import { silentLogger } from '@farpoint/service';
import { afterAll, afterEach, describe, expect, it } from 'vitest';
import { hasVideo, WatchedCamera } from '../../../testing/watched-camera.ts';
import type { RosVideoSource } from './feed-source.ts';
import { FeedThread } from './feed-thread.ts';

const { python, missing } = Ros1Peers.find();

describe.skipIf(python === null || !hasVideo)(
  `cameras in a ROS 1 graph (${missing ?? 'docs/video.md'})`,
  { timeout: 60_000 },
  () => {
    let peers: Ros1Peers | null = null;
    const open: WatchedCamera[] = [];
    afterEach(async () => {
      await Promise.all(open.splice(0).map(({ encoder }) => encoder.close()));
    });
    afterAll(() => peers?.close());

    function watch(thread: FeedThread, topic: string, type: string): WatchedCamera {
      const entry: TopicEntry = { topic, type, as: 'picture', most: null };
      const masterUrl = peers?.masterUrl ?? '';
      const graph = { kind: 'ros1', name: 'robot', masterUrl, hostname: '127.0.0.1' } as const;
      const source: RosVideoSource = { kind: 'ros', graph, entry };
      const watched = new WatchedCamera(thread, topic, source);
      open.push(watched);
      return watched;
    }

    it('wait for the master, show raw pictures, and say that compressed ones are damaged', async () => {
      peers = await Ros1Peers.open(python ?? '');
      const thread = new FeedThread(silentLogger());
      const front = watch(thread, '/front/image_raw', 'sensor_msgs/msg/Image');
      const rear = watch(thread, '/rear/image_raw/compressed', 'sensor_msgs/msg/CompressedImage');
      await front.until(() => front.faults.length > 0);
      expect(front.faults[0]).toMatch(/nobody publishes it/);
      await peers.startCore();
      await peers.startNode('pictures', 'camera');
      await front.until(() => front.pictures.length >= 5);
      expect(front.pictures[0]).toMatchObject({ key: true, width: 640, height: 480 });
      expect(front.faults.at(-1)).toBeNull();
      await rear.until(() => /damaged/.test(rear.faults.at(-1) ?? ''));
      expect(rear.pictures).toEqual([]);
    });
  },
);
