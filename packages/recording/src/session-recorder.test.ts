import { spawn } from 'node:child_process';
import { mkdtempSync, rmSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Pose } from '@farpoint/protocol';
import { afterAll, describe, expect, it } from 'vitest';
import * as z from 'zod';
import { CloudPlayer } from './cloud-player.ts';
import { CloudTap } from './cloud-tap.ts';
import { openRecording } from './open-recording.ts';
import { SessionRecorder } from './session-recorder.ts';
import { FakeClock } from './testing/fake-clock.ts';
import { Peers } from './testing/peers.ts';

const folder = mkdtempSync(join(tmpdir(), 'farpoint-recorder-'));
afterAll(() => rmSync(folder, { recursive: true, force: true }));

const headerSchema = z.object({ frame_id: z.string() });
const tfSchema = z.object({
  transforms: z.array(z.object({ header: headerSchema, child_frame_id: z.string() })),
});
const stampedSchema = z.object({ header: headerSchema, child_frame_id: z.string().optional() });

const FRAMES = 30;
const LENS = { fx: 8, fy: 8, cx: 7.5, cy: 5.5 };
const GRID = { width: 16, height: 12, camera: LENS };
const poseAt = (k: number): Pose => ({
  position: { x: k / 10, y: 0, z: 1 },
  orientation: { x: -0.5, y: 0.5, z: -0.5, w: 0.5 },
});

/** The writer has its turn, as between two frames of a camera. */
async function written(tap: CloudTap): Promise<void> {
  while (tap.pending > 0) await new Promise((resolve) => setTimeout(resolve, 1));
}

async function record(path: string, compression: 'none' | 'zstd' = 'none'): Promise<SessionRecorder> {
  const recorder = await SessionRecorder.open({
    ...{ path, compression, robotId: 'test', epochNs: 1_700_000_000_000_000_000n },
  });
  const tap = new CloudTap(recorder.clouds, 1000);
  const depth = new Float32Array(16 * 12);
  const colour = new Uint32Array(16 * 12).fill(0xff03_0201);
  for (let k = 0; k < FRAMES; k++) {
    depth.fill(2 + k);
    depth[0] = Number.NaN;
    const stamp = { cameraPose: poseAt(k), captureMs: k * 100 };
    tap.captured({ form: 'images', depth, colour, ...stamp }, GRID);
    recorder.json('telemetry', k * 100, { k, speed: 0.5 });
    recorder.velocity(k * 100, { linear: { x: k, y: 0, z: 0 }, angular: { x: 0, y: 0, z: 1 } });
    recorder.state(
      k * 100,
      { ...poseAt(k), orientation: { x: 0, y: 0, z: 0, w: 1 } },
      {
        linear: { x: 1, y: 0, z: 0 },
        angular: { x: 0, y: 0, z: 0 },
      },
    );
    await written(tap);
  }
  expect(tap.dropped).toBe(0);
  tap.close();
  await recorder.close();
  const { dropped, faults } = recorder;
  expect({ dropped, faults }).toEqual({ dropped: 0, faults: 0 });
  return recorder;
}

describe('SessionRecorder', { timeout: 60_000 }, () => {
  it.each(['none', 'zstd'] as const)('what it records (%s) is played again', async (compression) => {
    const path = join(folder, `${compression}.mcap`);
    const recorder = await record(path, compression);
    expect(recorder.bytes).toBe(statSync(path).size);
    const recording = await openRecording(path);
    expect(recording.warning).toBeNull();
    const counts = Object.fromEntries(recording.topics.map(({ name, messages }) => [name, messages]));
    expect(counts).toMatchObject({ '/farpoint/captured': FRAMES, '/tf': 2 * FRAMES, '/odom': FRAMES });
    expect(counts).toMatchObject({ '/farpoint/cmd_vel': FRAMES, '/farpoint/telemetry': FRAMES });
    await recording.close();
    expect(recorder.messages).toBe(FRAMES * 6 + (counts['/farpoint/recorder'] ?? 0));

    const clock = new FakeClock();
    const player = await CloudPlayer.open(
      { path, topic: null, rate: 1, fromS: 0, atEnd: 'stop', axes: 'auto' },
      clock,
    );
    expect(player.stream).toMatchObject({ axes: 'optical', width: 16, height: 12, capacity: 192 });
    const into = new Float32Array(192 * 4);
    let k = 0;
    player.onCloud = () => {
      const cloud = player.take(into);
      expect(clock.ms).toBeCloseTo(k * 100, 3);
      expect(cloud?.count).toBe(192);
      expect(cloud?.cameraPose.position.x).toBeCloseTo(k / 10, 6);
      expect(into[0]).toBeNaN();
      // The last pixel, on its ray.
      expect(into[191 * 4]).toBeCloseTo(((15 - 7.5) / 8) * (2 + k), 4);
      expect(into[191 * 4 + 2]).toBe(2 + k);
      expect(new Uint32Array(into.buffer)[191 * 4 + 3]).toBe(0xff03_0201);
      k++;
    };
    await player.run();
    expect(player.twist.linear.x).toBe(1);
    await player.close();
    expect(k).toBe(FRAMES);
  });

  it('every frame that a message names stands in the world by tf alone, as viewers place it', async () => {
    const path = join(folder, 'frames.mcap');
    await record(path);
    const recording = await openRecording(path);
    const parents = new Map<string, string>();
    const named = new Map<string, string>();
    for await (const { topic, data } of recording.messages(
      recording.topics.map(({ name }) => name),
      0n,
    )) {
      const message = topic.decode(data);
      for (const { header, child_frame_id } of tfSchema.safeParse(message).data?.transforms ?? [])
        parents.set(child_frame_id, header.frame_id);
      const { header, child_frame_id } = stampedSchema.safeParse(message).data ?? {};
      if (header !== undefined) named.set(header.frame_id, topic.name);
      if (child_frame_id !== undefined) named.set(child_frame_id, topic.name);
    }
    await recording.close();
    expect([...named.keys()].sort()).toEqual(['base_link', 'camera_optical_frame', 'world']);
    for (const [frame, topic] of named) {
      let root = frame;
      for (let depth = 0; depth < 8 && parents.has(root); depth++) root = parents.get(root) as string;
      expect(root, `${frame} of ${topic}`).toBe('world');
    }
  });

  it('records no more captured clouds than it was asked for', async () => {
    const path = join(folder, 'few.mcap');
    const recorder = await SessionRecorder.open({ path, compression: 'none', robotId: 'test', epochNs: 0n });
    const tap = new CloudTap(recorder.clouds, 5);
    const cloud = { form: 'points' as const, points: new Float32Array(40), count: 10 };
    for (let k = 0; k < 58; k++) {
      tap.captured(
        { ...cloud, cameraPose: poseAt(0), captureMs: k * (1000 / 30) },
        { ...GRID, camera: null },
      );
      await written(tap);
    }
    tap.close();
    await recorder.close();
    const recording = await openRecording(path);
    expect(recording.topics.find(({ name }) => name === '/farpoint/captured')?.messages).toBe(10);
    await recording.close();
  });

  it('drops the oldest where the writer does not keep up, counts it, and never waits', async () => {
    const path = join(folder, 'fast.mcap');
    const recorder = await SessionRecorder.open({ path, compression: 'none', robotId: 'test', epochNs: 0n });
    const tap = new CloudTap(recorder.clouds, Number.POSITIVE_INFINITY);
    const points = new Float32Array(40_000);
    // All in one turn: no answer can come in between.
    for (let k = 0; k < 50; k++) {
      const cloud = { form: 'points' as const, points, count: 10_000 };
      tap.captured(
        { ...cloud, cameraPose: poseAt(0), captureMs: k },
        { width: 10_000, height: 1, camera: null },
      );
    }
    for (let k = 0; k < 10_000; k++) recorder.json('telemetry', k, { k });
    expect(tap.dropped).toBe(50 - 6);
    expect(recorder.dropped).toBe(10_000 - 256 - 4096);
    tap.close();
    await recorder.close();
    const recording = await openRecording(path);
    const sequences: number[] = [];
    for await (const { logNs } of recording.messages(['/farpoint/captured'], 0n))
      sequences.push(Number(logNs / 1_000_000n));
    // The first two were under way at once; the newest four waited.
    expect(sequences).toEqual([0, 1, 46, 47, 48, 49]);
    expect(recording.topics.find(({ name }) => name === '/farpoint/telemetry')?.messages).toBe(256 + 4096);
    await recording.close();
  });

  it('does not write over a file', async () => {
    const path = join(folder, 'there.mcap');
    await record(path);
    await expect(record(path)).rejects.toMatchObject({
      name: 'RecordingError',
      message: expect.stringContaining(path),
    });
  });

  it('leaves a file that is read up to its last chunk when it is killed', async () => {
    const path = join(folder, 'killed.mcap');
    const child = spawn(
      process.execPath,
      [join(import.meta.dirname, 'testing', 'endless-recorder.ts'), path],
      {
        stdio: ['ignore', 'pipe', 'inherit'],
      },
    );
    const written = await new Promise<number>((resolve) => {
      child.stdout.on('data', (data: Buffer) => {
        const count = Number(data.toString().trim().split('\n').at(-1));
        if (count >= 100) resolve(count);
      });
    });
    child.kill('SIGKILL');
    await new Promise((resolve) => child.once('exit', resolve));
    const recording = await openRecording(path);
    expect(recording.warning).toContain('ends without its index');
    let clouds = 0;
    for await (const { topic, data } of recording.messages(['/farpoint/captured'], 0n)) {
      expect(topic.decode(data)).toMatchObject({ width: 100, height: 100 });
      clouds++;
    }
    await recording.close();
    // What the writer had said was written, at least.
    expect(clouds).toBeGreaterThan(0);
    const all = recording.topics.reduce((sum, { messages }) => sum + (messages ?? 0), 0);
    expect(all).toBeGreaterThanOrEqual(written);
  });
});

const peers = Peers.install();
describe.skipIf(typeof peers === 'string')(
  `recordings read by PyPI’s mcap and rosbags ${typeof peers === 'string' ? `(${peers})` : ''}`,
  { timeout: 60_000 },
  () => {
    it.each(['none', 'zstd'] as const)(
      'every message is there (%s), with its check values and schemas',
      async (compression) => {
        const path = join(folder, `for-peers-${compression}.mcap`);
        const recorder = await record(path, compression);
        const { topics, messages, profile } = (peers as Peers).read(path);
        expect(profile).toBe('ros2');
        expect(messages).toBe(recorder.messages);
        for (const topic of ['/farpoint/captured', '/odom', '/farpoint/cmd_vel', '/farpoint/telemetry']) {
          expect(topics[topic]).toMatchObject({ count: FRAMES, sequence: FRAMES - 1 });
        }
        expect(topics['/tf']).toMatchObject({ count: 2 * FRAMES, sequence: 2 * FRAMES - 1 });
        expect((peers as Peers).count(path)).toEqual(
          Object.fromEntries(Object.entries(topics).map(([name, { count }]) => [name, count])),
        );
        const clouds = topics['/farpoint/captured']?.sums ?? [];
        clouds.forEach(([points, x, , z], k) => {
          expect(points).toBe(192);
          // 191 pixels have a depth; the one that has none was the first, whose ray goes to the left.
          expect(z).toBeCloseTo(191 * (2 + k), 3);
          expect(x).toBeCloseTo((7.5 / 8) * (2 + k), 3);
        });
      },
    );
  },
);
