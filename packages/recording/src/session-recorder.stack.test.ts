import { spawn } from 'node:child_process';
import { createHash } from 'node:crypto';
import { readFileSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Pose } from '@farpoint/protocol';
import { foxgloveCompressedImageSchema, stampNs } from '@farpoint/ros';
import { eventually } from '@farpoint/service/testing/eventually';
import { useFolder } from '@farpoint/service/testing/folder';
import { describe, expect, it, onTestFinished } from 'vitest';
import * as z from 'zod';
import { CloudPlayer } from './cloud-player.ts';
import { CloudTap } from './cloud-tap.ts';
import { openRecording } from './open-recording.ts';
import type { Recording } from './recording.ts';
import { SessionRecorder } from './session-recorder.ts';
import { FakeClock } from './testing/fake-clock.ts';
import { Peers } from './testing/peers.ts';
import { PLAY_ALL } from './testing/play-clouds.ts';

const folder = useFolder();

const headerSchema = z.object({ frame_id: z.string() });
const tfSchema = z.object({
  transforms: z.array(z.object({ header: headerSchema, child_frame_id: z.string() })),
});
const stampedSchema = z.object({ header: headerSchema, child_frame_id: z.string().optional() });

const FRAMES = 30;
const NOTHING_DROPPED = { captured: 0, sent: 0, pictures: 0, videos: 0, events: 0 };
const LENS = { fx: 8, fy: 8, cx: 7.5, cy: 5.5 };
const GRID = { width: 16, height: 12, camera: LENS };
const FRONT = '/farpoint/pictures/Camera';
const REAR = '/farpoint/pictures/rear_image_raw';
const VIDEOS = ['/farpoint/videos/Front', '/farpoint/videos/Mast_left'];
const poseAt = (k: number): Pose => ({
  position: { x: k / 10, y: 0, z: 1 },
  orientation: { x: -0.5, y: 0.5, z: -0.5, w: 0.5 },
});

/** Stand-ins for JPEGs: nothing decodes them. Some are larger than what the writer copies. */
const pictureOf = (camera: number, k: number): Uint8Array<ArrayBuffer> =>
  Uint8Array.from({ length: k % 10 === 9 ? 300_000 : 2000 + k }, (_, i) => (i * 7 + k * 13 + camera) & 0xff);
const CAMERAS = [
  { name: 'Camera', ofCloud: true },
  { name: '/rear/image_raw', ofCloud: false },
];

/** Stand-ins for coded frames: nothing decodes them. */
const frameOf = (video: number, k: number): Uint8Array<ArrayBuffer> =>
  Uint8Array.from({ length: 900 + k }, (_, i) => (i * 5 + k * 17 + video) & 0xff);

/** Lets the writer run, as between two frames of a camera. */
const written = (tap: CloudTap) => eventually(() => tap.pending === 0);

type RecorderOptions = Parameters<typeof SessionRecorder.open>[0];
const open = (path: string | null, more: Partial<RecorderOptions> = {}) =>
  SessionRecorder.open({ path, compression: 'none', robotId: 'test', epochNs: 0n, ...more });

/** Captures 10,000 points. */
const capture = (tap: CloudTap, points: Float32Array<ArrayBuffer>, capturedAtMs: number) =>
  tap.captured(
    { form: 'points', points, count: 10_000, cameraPose: poseAt(0), capturedAtMs },
    { width: 10_000, height: 1, camera: null },
  );

/** When the messages of a topic were recorded, ms. */
async function timesOf(recording: Recording, topic: string): Promise<number[]> {
  const times: number[] = [];
  for await (const { logNs } of recording.messages([topic], 0n)) times.push(Number(logNs / 1_000_000n));
  return times;
}

/** A recorder with a file of its own. @returns it, and what it has written, once it is closed */
async function recorderOf(name: string, more: Partial<RecorderOptions> = {}) {
  const path = join(folder, `${name}.mcap`);
  const recorder = await open(path, more);
  const reopen = async (clouds: { close(): void } = recorder.clouds) => {
    clouds.close();
    await recorder.close();
    return reopened(path);
  };
  return { path, recorder, reopen };
}

/** A recording that is closed with the test. */
async function reopened(path: string) {
  const recording = await openRecording(path);
  onTestFinished(() => recording.close());
  return recording;
}

/** Lets the writer tell the tap that a file is open, or is not. */
async function told(tap: CloudTap, recording: boolean): Promise<void> {
  while (tap.recording !== recording) await new Promise((resolve) => setTimeout(resolve, 1));
}

async function record(path: string, compression: 'none' | 'zstd' = 'none'): Promise<SessionRecorder> {
  const recorder = await open(path, { compression, epochNs: 1_700_000_000_000_000_000n });
  recorder.cameras(CAMERAS);
  recorder.videos([
    { name: 'Front', format: 'h264' },
    { name: 'Mast left', format: 'vp8' },
  ]);
  const tap = new CloudTap(recorder.clouds, { captured: 1000, sent: 1000 });
  const depth = new Float32Array(16 * 12);
  const colour = new Uint32Array(16 * 12).fill(0xff03_0201);
  for (let k = 0; k < FRAMES; k++) {
    depth.fill(2 + k);
    depth[0] = Number.NaN;
    const stamp = { cameraPose: poseAt(k), capturedAtMs: k * 100 };
    tap.captured({ form: 'images', depth, colour, ...stamp }, GRID);
    recorder.picture(0, k * 100, 'jpeg', pictureOf(0, k));
    if (k % 3 === 0) recorder.picture(1, k * 100 + 40, 'png', pictureOf(1, k));
    const key = k % 10 === 0;
    recorder.video({ video: 0, capturedAtMs: k * 100, key, format: 'h264', bytes: frameOf(0, k) });
    // Another encoder from the twentieth frame on.
    const format = k < 20 ? 'vp8' : 'h264';
    recorder.video({ video: 1, capturedAtMs: k * 100 + 3, key, format, bytes: frameOf(1, k) });
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
  expect({ dropped, faults }).toEqual({ dropped: NOTHING_DROPPED, faults: 0 });
  return recorder;
}

/** One recording of each kind is enough for all who only read it. */
const made = new Map<string, Promise<{ path: string; recorder: SessionRecorder }>>();
function recorded(compression: 'none' | 'zstd'): Promise<{ path: string; recorder: SessionRecorder }> {
  const path = join(folder, `${compression}.mcap`);
  const known = made.get(compression) ?? record(path, compression).then((recorder) => ({ path, recorder }));
  made.set(compression, known);
  return known;
}

describe('SessionRecorder', { timeout: 60_000 }, () => {
  it.each(['none', 'zstd'] as const)('what it records (%s) can be played', async (compression) => {
    const { path, recorder } = await recorded(compression);
    expect(recorder.file.bytes).toBe(statSync(path).size);
    const recording = await reopened(path);
    expect(recording.warning).toBeNull();
    const counts = Object.fromEntries(recording.topics.map(({ name, messages }) => [name, messages]));
    expect(counts).toMatchObject({ '/farpoint/captured': FRAMES, '/tf': 2 * FRAMES, '/odom': FRAMES });
    expect(counts).toMatchObject({ '/farpoint/cmd_vel': FRAMES, '/farpoint/telemetry': FRAMES });
    expect(counts).toMatchObject({ [FRONT]: FRAMES, [REAR]: FRAMES / 3 });
    expect(recorder.file.messages).toBe(FRAMES * 9 + FRAMES / 3 + (counts['/farpoint/recorder'] ?? 0));

    const clock = new FakeClock();
    const player = await CloudPlayer.open({ ...PLAY_ALL, path, along: [FRONT, REAR] }, clock);
    const pictures: [string, number, number][] = [];
    player.onAlong = ({ topic, data }) => {
      const image = foxgloveCompressedImageSchema.parse(topic.decode(data));
      const at = Number(stampNs(image.timestamp) - 1_700_000_000_000_000_000n) / 1e6;
      const camera = topic.name === FRONT ? 0 : 1;
      const { length } = pictures.filter(([name]) => name === topic.name);
      expect(image.data).toEqual(pictureOf(camera, camera === 0 ? length : length * 3));
      expect(image.format).toBe(camera === 0 ? 'jpeg' : 'png');
      pictures.push([topic.name, at, clock.ms]);
    };
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
    expect(player.base.twist?.linear.x).toBe(1);
    expect(pictures.filter(([name]) => name === FRONT)).toHaveLength(FRAMES);
    expect(pictures.filter(([name]) => name === REAR)).toHaveLength(FRAMES / 3);
    for (const [, at, shownMs] of pictures) expect(shownMs).toBeCloseTo(at, 3);
    await player.close();
    expect(k).toBe(FRAMES);
  });

  it('every frame named in a message has a pose in the world through tf alone, as viewers need it', async () => {
    const { path } = await recorded('none');
    const recording = await reopened(path);
    const parents = new Map<string, string>();
    const named = new Map<string, string>();
    const pictureFrames = new Set<string>();
    for await (const { topic, data } of recording.messages(
      recording.topics.map(({ name }) => name),
      0n,
    )) {
      const message = topic.decode(data);
      // The position of a camera that is not the clouds' camera is unknown.
      const image = foxgloveCompressedImageSchema.safeParse(message);
      if (image.success) pictureFrames.add(image.data.frame_id);
      for (const { header, child_frame_id } of tfSchema.safeParse(message).data?.transforms ?? [])
        parents.set(child_frame_id, header.frame_id);
      const { header, child_frame_id } = stampedSchema.safeParse(message).data ?? {};
      if (header !== undefined) named.set(header.frame_id, topic.name);
      if (child_frame_id !== undefined) named.set(child_frame_id, topic.name);
    }
    expect(pictureFrames).toEqual(new Set(['camera_optical_frame', '/rear/image_raw', 'Front', 'Mast left']));
    expect([...named.keys()].sort()).toEqual(['base_link', 'camera_optical_frame', 'world']);
    for (const [frame, topic] of named) {
      let root = frame;
      for (let depth = 0; depth < 8 && parents.has(root); depth++) root = parents.get(root) as string;
      expect(root, `${frame} of ${topic}`).toBe('world');
    }
  });

  it.each(['none', 'zstd'] as const)(
    'ends before it exceeds its maximum size (%s), reports it, and every message of it can be read',
    async (compression) => {
      const mostBytes = 2_000_000;
      const { path, recorder, reopen } = await recorderOf(`full-${compression}`, { compression, mostBytes });
      let ended = false;
      recorder.onFull = () => {
        ended = true;
      };
      const tap = new CloudTap(recorder.clouds, { captured: 1000, sent: 1000 });
      // Incompressible data.
      const points = Float32Array.from({ length: 40_000 }, (_, i) => Math.sin(i * i));
      let pushed = 0;
      while (!ended) {
        recorder.json('telemetry', pushed, { pushed });
        capture(tap, points, pushed++);
        await written(tap);
      }
      // Later messages are discarded.
      recorder.json('telemetry', pushed, {});
      capture(tap, points, pushed);
      expect(tap.pending).toBe(0);
      expect(tap.dropped).toBe(0);
      const recording = await reopen(tap);
      const { size } = statSync(path);
      expect(size).toBeLessThanOrEqual(mostBytes);
      expect(size).toBeGreaterThan(mostBytes * 0.8);
      expect(recorder.file.bytes).toBe(size);
      expect(recording.warning).toBeNull();
      const messages = new Map(recording.topics.map((topic) => [topic.name, topic.messages]));
      const { length: clouds } = await timesOf(recording, '/farpoint/captured');
      expect(clouds).toBe(messages.get('/farpoint/captured'));
      expect(clouds).toBeGreaterThan(5);
    },
  );

  it('drops the oldest if the writer does not keep up, counts it, and never waits', async () => {
    const { recorder, reopen } = await recorderOf('fast');
    const tap = new CloudTap(recorder.clouds, {
      captured: Number.POSITIVE_INFINITY,
      sent: Number.POSITIVE_INFINITY,
    });
    const points = new Float32Array(40_000);
    // All in one turn, so that no answer can arrive in between.
    for (let k = 0; k < 50; k++) capture(tap, points, k);
    for (let k = 0; k < 10_000; k++) recorder.json('telemetry', k, { k });
    expect(tap.dropped).toBe(50 - 6);
    expect(recorder.dropped.events).toBe(10_000 - 256 - 4096);
    const recording = await reopen(tap);
    // The first two were in progress at once; the newest four waited.
    expect(await timesOf(recording, '/farpoint/captured')).toEqual([0, 1, 46, 47, 48, 49]);
    expect(recording.topics.find(({ name }) => name === '/farpoint/telemetry')?.messages).toBe(256 + 4096);
  });

  it('drops the oldest pictures if the writer does not keep up, and reports which are missing', async () => {
    const { recorder, reopen } = await recorderOf('many-pictures');
    recorder.cameras([{ name: 'Camera', ofCloud: true }]);
    // All in one turn, so that no answer can arrive in between.
    for (let k = 0; k < 100; k++) recorder.picture(0, k, 'jpeg', pictureOf(0, k));
    recorder.json('telemetry', 0, {});
    expect(recorder.dropped).toEqual({ ...NOTHING_DROPPED, pictures: 100 - 4 - 24 });
    const recording = await reopen();
    expect(recorder.dropped.pictures).toBe(72);
    const times: number[] = [];
    let told: unknown = null;
    for await (const { topic, logNs, data } of recording.messages([FRONT, '/farpoint/recorder'], 0n)) {
      if (topic.name !== FRONT) {
        told = topic.decode(data);
        continue;
      }
      const k = Number(logNs / 1_000_000n);
      expect(foxgloveCompressedImageSchema.parse(topic.decode(data)).data).toEqual(pictureOf(0, k));
      times.push(k);
    }
    // The first four were in progress at once; the newest 24 waited.
    expect(told).toMatchObject({ dropped: { captured: 0, sent: 0, pictures: 72 }, faults: 0 });
    expect(times).toEqual([0, 1, 2, 3, ...Array.from({ length: 24 }, (_, i) => 76 + i)]);
  });

  it('drops whole runs of video frames if the writer does not keep up, and asks for a key frame', async () => {
    const { recorder, reopen } = await recorderOf('many-frames');
    recorder.videos([{ name: 'Front', format: 'h264' }]);
    const asked: number[] = [];
    recorder.onKeyFrameNeeded = (video) => asked.push(video);
    // All in one turn, so that no answer can arrive in between.
    for (let k = 0; k < 700; k++) {
      // As the encoder's output comes: a view of memory that has other uses, too.
      const chunk = Buffer.from(frameOf(0, k));
      const bytes = chunk.subarray(0, chunk.length);
      recorder.video({ video: 0, capturedAtMs: k, key: k === 0, format: 'h264', bytes });
      expect(chunk.length).toBe(900 + k);
    }
    const keptFirst = 64;
    expect(recorder.dropped.videos).toBe(700 - keptFirst);
    expect(asked).toEqual([0]);
    recorder.video({ video: 0, capturedAtMs: 700, key: true, format: 'h264', bytes: frameOf(0, 700) });
    const recording = await reopen();
    const times = await timesOf(recording, VIDEOS[0]!);
    expect(times).toEqual([...Array.from({ length: keptFirst }, (_, k) => k), 700]);
  });

  it('a camera that nobody watched has a topic without messages', async () => {
    const { recorder, reopen } = await recorderOf('no-pictures');
    recorder.cameras(CAMERAS);
    recorder.json('telemetry', 0, {});
    const recording = await reopen();
    for (const name of [FRONT, REAR])
      expect(recording.topics.find((topic) => topic.name === name)).toMatchObject({
        ...{ type: 'foxglove_msgs/msg/CompressedImage', messages: 0 },
      });
  });

  it('does not overwrite a file', async () => {
    const path = join(folder, 'there.mcap');
    writeFileSync(path, 'of somebody');
    await expect(record(path)).rejects.toMatchObject({
      name: 'RecordingError',
      message: expect.stringContaining(path),
    });
    expect(readFileSync(path, 'utf8')).toBe('of somebody');
  });

  it('if it is killed, the file can be read up to its last chunk', async () => {
    const path = join(folder, 'killed.mcap');
    const program = join(import.meta.dirname, 'testing', 'endless-recorder.ts');
    const child = spawn(process.execPath, [program, path], { stdio: ['ignore', 'pipe', 'inherit'] });
    const written = await new Promise<number>((resolve) => {
      child.stdout.on('data', (data: Buffer) => {
        const count = Number(data.toString().trim().split('\n').at(-1));
        if (count >= 100) resolve(count);
      });
    });
    child.kill('SIGKILL');
    await new Promise((resolve) => child.once('exit', resolve));
    const recording = await reopened(path);
    expect(recording.warning).toContain('ends without its index');
    let clouds = 0;
    for await (const { topic, data } of recording.messages(['/farpoint/captured'], 0n)) {
      expect(topic.decode(data)).toMatchObject({ width: 100, height: 100 });
      clouds++;
    }
    // At least what the writer had reported as written.
    expect(clouds).toBeGreaterThan(0);
    const all = recording.topics.reduce((sum, { messages }) => sum + (messages ?? 0), 0);
    expect(all).toBeGreaterThanOrEqual(written);
  });
});

describe('files one after another', { timeout: 30_000 }, () => {
  it('are each complete, with all topics, bookmarks, and videos from a key frame on', async () => {
    const [first, second] = ['first.mcap', 'second.mcap'].map((name) => join(folder, name)) as [
      string,
      string,
    ];
    const recorder = await open(null, { epochNs: 1_700_000_000_000_000_000n });
    const asked: number[] = [];
    recorder.onKeyFrameNeeded = (video) => asked.push(video);
    recorder.cameras(CAMERAS);
    recorder.videos([{ name: 'Front', format: 'h264' }]);
    const tap = new CloudTap(recorder.clouds, { captured: 1000, sent: 0 });
    const depth = new Float32Array(16 * 12).fill(2);
    const colour = new Uint32Array(16 * 12);
    let k = 0;
    /** A frame of everything. */
    const step = async (key: boolean) => {
      const stamp = { cameraPose: poseAt(k), capturedAtMs: k * 100 };
      tap.captured({ form: 'images', depth, colour, ...stamp }, GRID);
      recorder.video({ video: 0, capturedAtMs: k * 100, key, format: 'h264', bytes: frameOf(0, k) });
      recorder.json('telemetry', k * 100, { k });
      k++;
      await written(tap);
    };
    await told(tap, false);
    await step(true);
    expect(recorder.writing).toBe(false);
    await recorder.file.open(first);
    await told(tap, true);
    await expect(recorder.file.open(second)).rejects.toThrow('another file is being written');
    await step(false);
    await step(true);
    recorder.bookmark(k * 100, 'Ann', 'wheel slips – here');
    await step(false);
    await recorder.file.close();
    await told(tap, false);
    await step(false);
    await expect(recorder.file.open(first)).rejects.toThrow('EEXIST');
    await recorder.file.open(second);
    await told(tap, true);
    await step(false);
    await step(true);
    await recorder.close();

    const countsOf = async (path: string) => {
      const recording = await reopened(path);
      expect(recording.warning).toBeNull();
      const counts = Object.fromEntries(recording.topics.map(({ name, messages }) => [name, messages]));
      const marks: unknown[] = [];
      for await (const { topic, data } of recording.messages(['/farpoint/bookmarks'], 0n))
        marks.push(topic.decode(data));
      return { counts, marks };
    };
    const one = await countsOf(first);
    expect(one.counts).toMatchObject({
      ...{ '/farpoint/captured': 3, '/farpoint/telemetry': 3, '/farpoint/videos/Front': 2 },
      [FRONT]: 0,
    });
    expect(one.marks).toMatchObject([
      { message: 'wheel slips – here', name: 'Ann', timestamp: { sec: 1_700_000_000 } },
    ]);
    const two = await countsOf(second);
    expect(two.counts).toMatchObject({
      ...{ '/farpoint/captured': 2, '/farpoint/telemetry': 2, '/farpoint/videos/Front': 1 },
      '/farpoint/bookmarks': 0,
    });
    expect(two.marks).toEqual([]);
    expect(recorder.file.bytes).toBe(statSync(first).size + statSync(second).size);
    expect(asked).toContain(0);
  });
});

const peers = Peers.install();
describe.skipIf(typeof peers === 'string')(
  `recordings read by PyPI’s mcap and rosbags ${typeof peers === 'string' ? `(${peers})` : ''}`,
  { timeout: 60_000 },
  () => {
    it.each(['none', 'zstd'] as const)(
      'every message is there (%s), with its checksums and schemas',
      async (compression) => {
        const { path, recorder } = await recorded(compression);
        const { topics, messages, profile } = (peers as Peers).read(path);
        expect(profile).toBe('ros2');
        expect(messages).toBe(recorder.file.messages);
        for (const topic of ['/farpoint/captured', '/odom', '/farpoint/cmd_vel', '/farpoint/telemetry']) {
          expect(topics[topic]).toMatchObject({ count: FRAMES, sequence: FRAMES - 1 });
        }
        expect(topics['/tf']).toMatchObject({ count: 2 * FRAMES, sequence: 2 * FRAMES - 1 });
        for (const [camera, topic] of [FRONT, REAR].entries()) {
          const pictures = topics[topic]?.pictures ?? [];
          expect(topics[topic]).toMatchObject({
            ...{ type: 'foxglove_msgs/msg/CompressedImage', metadata: { camera: CAMERAS[camera]?.name } },
            ...{ count: pictures.length, sequence: pictures.length - 1 },
          });
          expect(pictures).toHaveLength(camera === 0 ? FRAMES : FRAMES / 3);
          pictures.forEach((picture, i) => {
            const k = camera === 0 ? i : i * 3;
            const data = pictureOf(camera, k);
            const ns = 1_700_000_000_000_000_000n + BigInt(k * 100 + (camera === 0 ? 0 : 40)) * 1_000_000n;
            expect(picture).toEqual({
              ...{ stampNs: String(ns), logNs: String(ns), bytes: data.length },
              frame: camera === 0 ? 'camera_optical_frame' : '/rear/image_raw',
              format: camera === 0 ? 'jpeg' : 'png',
              sha256: createHash('sha256').update(data).digest('hex'),
            });
          });
        }
        for (const [video, topic] of VIDEOS.entries()) {
          const first = video === 0 ? 'h264' : 'vp8';
          const camera = video === 0 ? 'Front' : 'Mast left';
          expect(topics[topic]).toMatchObject({
            ...{ type: 'foxglove_msgs/msg/CompressedVideo', metadata: { camera, format: first } },
            ...{ count: FRAMES, sequence: FRAMES - 1 },
          });
          topics[topic]?.pictures.forEach((frame, k) => {
            const ns = String(1_700_000_000_000_000_000n + BigInt(k * 100 + video * 3) * 1_000_000n);
            const data = frameOf(video, k);
            const format = k < 20 ? first : 'h264';
            expect(frame).toEqual({
              ...{ stampNs: ns, logNs: ns, bytes: data.length, frame: camera, format },
              sha256: createHash('sha256').update(data).digest('hex'),
            });
          });
        }
        expect((peers as Peers).count(path)).toEqual(
          Object.fromEntries(Object.entries(topics).map(([name, { count }]) => [name, count])),
        );
        const clouds = topics['/farpoint/captured']?.sums ?? [];
        clouds.forEach(([points, x, , z], k) => {
          expect(points).toBe(192);
          // 191 pixels have a depth; the one without was the first, whose ray points to the left.
          expect(z).toBeCloseTo(191 * (2 + k), 3);
          expect(x).toBeCloseTo((7.5 / 8) * (2 + k), 3);
        });
      },
    );
  },
);
