import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { useFolder } from '@farpoint/service/testing/folder';
import fc from 'fast-check';
import { beforeAll, describe, expect, it } from 'vitest';
import { RecordingError } from './errors.ts';
import { openRecording } from './open-recording.ts';
import type { Recording } from './recording.ts';
import { Peers } from './testing/peers.ts';
import { playClouds } from './testing/play-clouds.ts';

const FILES = [
  'bag-none.bag',
  'bag-lz4.bag',
  'bag-bz2.bag',
  'mcap-ros2-none.mcap',
  'mcap-ros2-lz4.mcap',
  'mcap-ros2-zstd.mcap',
  'mcap-ros1-zstd.mcap',
  'rosbag2/rosbag2.mcap',
];
const INSTALL_MS = 400_000;

const peers = Peers.install();
describe.skipIf(typeof peers === 'string')(
  `recordings of PyPI’s mcap and rosbags ${typeof peers === 'string' ? `(${peers})` : ''}`,
  { timeout: 60_000 },
  () => {
    const folder = useFolder();
    beforeAll(() => (peers as Peers).write(folder), INSTALL_MS);

    it.each(FILES)('%s: contains every message, in order', async (file) => {
      const recording = await openRecording(join(folder, file));
      expect(Object.fromEntries(recording.topics.map(({ name, messages }) => [name, messages]))).toEqual({
        '/points': 20,
        '/tf': 100,
        '/odom': 100,
        '/tf_static': 1,
      });
      const names = recording.topics.map(({ name }) => name);
      const seen = new Map<string, number>();
      let lastNs = 0n;
      for await (const { topic, logNs, data } of recording.messages(names, recording.startNs)) {
        expect(logNs).toBeGreaterThanOrEqual(lastNs);
        lastNs = logNs;
        expect(topic.decode(data)).toBeDefined();
        seen.set(topic.name, (seen.get(topic.name) ?? 0) + 1);
      }
      expect(Object.fromEntries(seen)).toEqual({ '/points': 20, '/tf': 100, '/odom': 100, '/tf_static': 1 });
      expect(lastNs).toBe(recording.endNs);
      await recording.close();
    });

    it.each(FILES)('%s: plays at its times, with the poses from tf', async (file) => {
      const { shown, faults, player } = await playClouds({ path: join(folder, file) });
      expect(faults).toEqual([]);
      expect(shown).toHaveLength(20);
      expect(player.stream).toMatchObject({ axes: 'body', frameId: 'lidar', height: 1, capacity: 750 });
      shown.forEach(({ atMs, count, first, pose }, k) => {
        expect(atMs).toBeCloseTo(k * 100, 3);
        expect(count).toBe(500);
        // x forward, y left, z up became x right, y down, z forward.
        expect(first[0]).toBeCloseTo(0, 5);
        expect(first[1]).toBeCloseTo(-0.5, 5);
        expect(first[2]).toBeCloseTo(k, 4);
        // The body is at (k / 10, 0, 0), turned left by 90°; the LiDAR is 0.5 m in front of it and 1 m above.
        expect(pose.position.x).toBeCloseTo(k / 10, 5);
        expect(pose.position.y).toBeCloseTo(0.5, 5);
        expect(pose.position.z).toBeCloseTo(1, 5);
        // Its optical z axis therefore points along the world's +y.
        const { x, y, z, w } = pose.orientation;
        expect([2 * (x * z + y * w), 2 * (y * z - x * w)].map((c) => Math.round(c * 1e6) / 1e6 + 0)).toEqual([
          0, 1,
        ]);
      });
    });

    it.each(['bag-lz4.bag', 'mcap-ros2-zstd.mcap'])('%s: seeks, plays faster, repeats', async (file) => {
      const path = join(folder, file);
      const { shown, faults } = await playClouds({ path, rate: 2, fromS: 1.05, atEnd: 'repeat' }, 12);
      expect(faults).toEqual([]);
      expect(shown.map(({ first }) => Math.round(first[2] as number))).toEqual([
        11, 12, 13, 14, 15, 16, 17, 18, 19, 11, 12, 13,
      ]);
      expect(shown[8]?.atMs).toBeCloseTo(400, 3);
      // The pose of the first cloud is known from messages before it.
      expect(shown[0]?.pose.position.x).toBeCloseTo(1.1, 5);
      expect(shown[9]?.pose.position.x).toBeCloseTo(1.1, 5);
    });

    it.each(['bag-none.bag', 'bag-lz4.bag', 'bag-bz2.bag'])(
      '%s, cut short or changed anywhere: typed errors with file and byte, or messages',
      async (file) => {
        const whole = readFileSync(join(folder, file));
        const change = fc.record({
          cut: fc.boolean(),
          at: fc.nat(whole.length - 1),
          bytes: fc.uint8Array({ minLength: 1, maxLength: 8 }),
        });
        const outcomes = { errors: 0, messages: 0 };
        await fc.assert(
          fc.asyncProperty(change, async ({ cut, at, bytes }) => {
            const damaged = cut ? whole.subarray(0, at) : Buffer.from(whole);
            if (!cut) damaged.set(bytes.subarray(0, whole.length - at), at);
            const path = join(folder, `damaged-${file}`);
            writeFileSync(path, damaged);
            let recording: Recording | null = null;
            try {
              recording = await openRecording(path);
              for await (const message of recording.messages(['/points', '/tf'], recording.startNs)) {
                if (message.data.length > 0) outcomes.messages++;
              }
            } catch (error) {
              expect(error).toBeInstanceOf(RecordingError);
              expect((error as RecordingError).message).toContain(path);
              expect((error as RecordingError).offset).toBeGreaterThanOrEqual(0);
              outcomes.errors++;
            } finally {
              await recording?.close();
            }
          }),
          { numRuns: 100 },
        );
        expect(outcomes.errors).toBeGreaterThan(20);
        expect(outcomes.messages).toBeGreaterThan(0);
      },
    );

    it('refuses a missing topic or one without clouds, naming those that have clouds', async () => {
      const path = join(folder, 'mcap-ros2-none.mcap');
      await expect(playClouds({ path, topic: '/nothing' })).rejects.toMatchObject({
        code: 'no-topic',
        topic: '/nothing',
        message: expect.stringContaining('with clouds: /points'),
      });
      await expect(playClouds({ path, topic: '/odom' })).rejects.toMatchObject({
        message: expect.stringContaining('nav_msgs/msg/Odometry'),
      });
    });
  },
);
