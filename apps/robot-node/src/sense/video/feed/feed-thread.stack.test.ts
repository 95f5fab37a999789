/** The thread that feeds cameras, with real encoders, simulated cameras and a ROS 2 graph. */
import { DdsGraph, isAvailable as isDdsAvailable } from '@farpoint/dds';
import { testDomain } from '@farpoint/dds/testing';
import type { Publisher } from '@farpoint/ros';
import { messageBytes } from '@farpoint/ros/testing';
import { silentLogger } from '@farpoint/service';
import { eventually } from '@farpoint/service/testing/eventually';
import { DEFAULT_CAMERA } from '@farpoint/sim';
import { BUILD_REMEDY } from '@farpoint/video/build';
import { afterEach, describe, expect, it } from 'vitest';
import { monotonicMs } from '../../../ground/clock.ts';
import { hasVideo, WatchedCamera } from '../../../testing/watched-camera.ts';
import type { FeedSource, RosVideoSource, SimVideoSource } from './feed-source.ts';
import { FeedThread } from './feed-thread.ts';

const HANGING = new URL('../../../testing/hanging-feed-worker.ts', import.meta.url);
const FAILING = new URL('../../../testing/failing-feed-worker.ts', import.meta.url);

const { forward, left, up, pitch, fieldOfView } = DEFAULT_CAMERA;

function simulated(yaw: number, framesPerS = 20): SimVideoSource {
  const camera = { forward, left, up, pitch, fieldOfView, yaw, width: 160, height: 120 };
  return { kind: 'sim', camera, framesPerS, seed: 1 };
}

/** A thread that hangs is noticed soon. One that a busy machine keeps waiting is started again, too. */
const SOON = { firstMs: 30_000, silenceMs: 1500, checkMs: 100 };

const open: WatchedCamera[] = [];
function watch(thread: FeedThread, name: string, source: FeedSource): WatchedCamera {
  const watched = new WatchedCamera(thread, name, source);
  open.push(watched);
  return watched;
}

describe.skipIf(!hasVideo)(
  `cameras that a thread feeds (needs: ${BUILD_REMEDY})`,
  { timeout: 60_000 },
  () => {
    afterEach(async () => {
      await Promise.all(open.splice(0).map(({ encoder }) => encoder.close()));
    });

    it('of the simulator capture at common instants', async () => {
      const thread = new FeedThread(silentLogger());
      const front = watch(thread, 'Front', simulated(0));
      const rear = watch(thread, 'Rear', simulated(Math.PI));
      const slow = watch(thread, 'Slow', simulated(1, 10));
      for (const each of [front, rear, slow]) await each.until(() => each.pictures.length >= 10);
      const instants = (of: WatchedCamera) =>
        of.pictures.map(({ capturedAtMs }) => Math.round(capturedAtMs * 1000));
      for (const [of, interval] of [
        [front, 50_000],
        [rear, 50_000],
        [slow, 100_000],
      ] as const)
        for (const instant of instants(of)) expect(instant % interval).toBe(0);
      expect(instants(front).filter((instant) => instants(rear).includes(instant)).length).toBeGreaterThan(3);
      for (const { pictures, faults } of [front, rear, slow]) {
        expect(pictures[0]).toMatchObject({ key: true, width: 160, height: 120 });
        expect(faults.filter((fault) => fault !== null)).toEqual([]);
        const { capturedAtMs } = pictures.at(-1)!;
        expect(monotonicMs() - capturedAtMs).toBeGreaterThan(0);
      }
    });

    it('say why a camera cannot be made, and the others go on', async () => {
      const thread = new FeedThread(silentLogger());
      const { camera, ...rest } = simulated(0);
      const broken = watch(thread, 'Broken', { ...rest, camera: { ...camera, fieldOfView: 4 } });
      const front = watch(thread, 'Front', simulated(0));
      await broken.until(() => broken.faults.length > 0);
      expect(broken.faults[0]).toMatch(/4 rad is not between 0 and π/);
      await front.until(() => front.pictures.length >= 3);
      expect(broken.pictures).toEqual([]);
    });

    it('say so when the thread dies, and come back with a key frame', async () => {
      const script = new URL('../../../testing/failing-feed-worker.ts', import.meta.url);
      const thread = new FeedThread(silentLogger(), { script, retry: { firstMs: 1, mostMs: 10 } });
      const front = watch(thread, 'Front', simulated(0));
      const rear = watch(thread, 'Rear', simulated(1));
      for (const each of [front, rear]) await each.until(() => each.pictures.length >= 2);
      const { length } = front.pictures;
      front.encoder.requestKeyFrame();
      for (const each of [front, rear]) {
        await each.until(() => each.faults.some((fault) => fault !== null));
        expect(each.faults.find((fault) => fault !== null)).toMatch(/has ended: made to fail/);
      }
      await front.until(() => front.pictures.length > length + 2 && front.faults.at(-1) === null);
      expect(thread.restarts).toBe(1);
      const again = front.pictures.slice(length).find(({ key }) => key);
      expect(again).toBeDefined();
    });

    it('say so when the thread hangs, and come back with a key frame', async () => {
      const script = new URL('../../../testing/hanging-feed-worker.ts', import.meta.url);
      const retry = { firstMs: 1, mostMs: 10 };
      const thread = new FeedThread(silentLogger(), { script, retry, life: SOON });
      const front = watch(thread, 'Front', simulated(0));
      const rear = watch(thread, 'Rear', simulated(1));
      for (const each of [front, rear]) await each.until(() => each.pictures.length >= 2);
      front.encoder.requestKeyFrame();
      for (const each of [front, rear]) {
        await each.until(() => each.reasons.length > 0);
        expect(new Set(each.reasons)).toEqual(new Set(['feed-hung']));
        expect(each.faults.at(-1)).toMatch(/cameras has said nothing for \d+ s; it starts again/);
      }
      const { length } = front.pictures;
      await front.until(() => front.pictures.length > length + 2 && front.faults.at(-1) === null);
      expect(front.pictures[length]?.key).toBe(true);
      expect(thread.restarts).toBeGreaterThanOrEqual(1);
    });

    it.each([
      ['hangs', HANGING, { life: SOON }],
      ['is dead', FAILING, { retry: { firstMs: 60_000, mostMs: 60_000 } }],
    ])('close although the thread %s, and may be closed again', async (_, script, options) => {
      const thread = new FeedThread(silentLogger(), { script, ...options });
      const front = watch(thread, 'Front', simulated(0));
      await front.until(() => front.pictures.length >= 1);
      front.encoder.requestKeyFrame();
      await front.encoder.close();
      await front.encoder.close();
    });

    describe.skipIf(!isDdsAvailable())('from a ROS 2 graph (needs pnpm build:native dds)', () => {
      const IMAGE = 'sensor_msgs/msg/Image';
      const domain = testDomain();
      let graph: DdsGraph | null = null;
      afterEach(() => graph?.close());

      function source(topic: string, type = IMAGE): RosVideoSource {
        const reliable = { reliability: 'reliable', durability: 'volatile', depth: 5 } as const;
        return {
          kind: 'ros',
          graph: { kind: 'ros2', name: 'robot', graph: 'dds', domain, localhostOnly: true },
          entry: { topic, type, as: 'picture', most: null, qos: reliable },
        };
      }

      function advertise(topic: string): Publisher {
        graph ??= new DdsGraph({ domain, localhostOnly: true, now: monotonicMs });
        return graph.advertise({ topic, type: IMAGE });
      }

      function say(to: Publisher, encoding: string, width: number, height: number, pixelBytes: number): void {
        const ns = BigInt(Date.now()) * 1_000_000n;
        const stamp = { sec: Number(ns / 1_000_000_000n), nanosec: Number(ns % 1_000_000_000n) };
        const step = width * pixelBytes;
        const data = new Uint8Array(step * height).fill(90);
        const header = { stamp, frame_id: 'camera' };
        to.publish(messageBytes(2, IMAGE, { header, width, height, encoding, is_bigendian: 0, step, data }));
      }

      it('are subscribed only while open, follow size and encoding, and say what cannot be shown', async () => {
        graph = null;
        const publisher = advertise('/front/image');
        const other = advertise('/rear/image');
        const thread = new FeedThread(silentLogger());
        expect(publisher.subscribers).toBe(0);
        const front = watch(thread, 'Front', source('/front/image'));
        const rear = watch(thread, 'Rear', source('/rear/image'));
        await eventually(() => publisher.subscribers === 1 && other.subscribers === 1);
        let shape: readonly [string, number, number, number] = ['rgb8', 320, 240, 3];
        const timer = setInterval(() => {
          say(other, 'mono8', 64, 48, 1);
          say(publisher, ...shape);
        }, 30);
        for (shape of [
          ['rgb8', 320, 240, 3],
          ['bgr8', 160, 120, 3],
          ['mono16', 200, 100, 2],
          ['yuv422', 320, 240, 2],
          ['bayer_rggb8', 128, 96, 1],
          ['rgba8', 640, 480, 4],
        ] as const) {
          const [, width, height] = shape;
          await front.until(() => {
            const { width: w, height: h } = front.pictures.at(-1) ?? {};
            return w === width && h === height;
          });
        }
        expect(front.faults.filter((fault) => fault !== null)).toEqual([]);
        shape = ['rgb12', 320, 240, 3];
        await front.until(() => typeof front.faults.at(-1) === 'string');
        expect(front.faults.at(-1)).toMatch(/\/front\/image: a picture as rgb12; the encodings are rgb8/);
        const { length } = rear.pictures;
        await rear.until(() => rear.pictures.length > length + 3);
        shape = ['rgb8', 320, 240, 3];
        await front.until(() => front.faults.at(-1) === null && front.pictures.at(-1)?.width === 320);
        clearInterval(timer);
        expect(rear.faults.filter((fault) => fault !== null)).toEqual([]);
        for (const { capturedAtMs } of front.pictures)
          expect(monotonicMs() - capturedAtMs).toBeLessThan(60_000);
        await front.encoder.close();
        await eventually(() => publisher.subscribers === 0);
        expect(other.subscribers).toBe(1);
        await rear.encoder.close();
        await eventually(() => other.subscribers === 0);
      });

      it('of a topic that nobody publishes say so', async () => {
        const thread = new FeedThread(silentLogger());
        const front = watch(thread, 'Front', source('/nobody/image'));
        await front.until(() => front.faults.length > 0);
        expect(front.faults[0]).toMatch(/nobody publishes it \(no picture for 5 s\)/);
      });
    });
  },
);
