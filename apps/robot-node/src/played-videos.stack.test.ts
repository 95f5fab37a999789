/** The robot program records a drive with video, and plays it: its videos are cameras again, in step with the clouds. */
import { spawnSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { LocalStack } from '@farpoint/local-stack';
import {
  emptyPlacement,
  emptyPointPacketHeader,
  msOfBarcodeTime,
  readBarcode,
  readCloudPayload,
} from '@farpoint/protocol';
import { openRecording } from '@farpoint/recording';
import { foxgloveCompressedVideoSchema } from '@farpoint/ros';
import { useFolder } from '@farpoint/service/testing/folder';
import { BUILD_REMEDY } from '@farpoint/video/build';
import { beforeAll, describe, expect, it } from 'vitest';
import * as z from 'zod';
import { monotonicMs } from './ground/clock.ts';
import { SignaledOperator } from './testing/signaled-operator.ts';
import { hasVideo } from './testing/watched-camera.ts';

const folder = useFolder();
const path = join(folder, 'drive.mcap');
const config = join(folder, 'farpoint.yaml');
const size = { width: 320, height: 240 };
const videos = [
  { name: 'Front', source: { kind: 'test' }, encoder: 'x264enc', kbitPerS: 2000, ...size },
  { name: 'Rear', source: { kind: 'test', pattern: 'ball' }, encoder: 'vp8enc', ...size },
];
writeFileSync(config, JSON.stringify({ robot: { videos } }));

async function withRobot(id: string, args: string[], use: (operator: SignaledOperator) => Promise<void>) {
  const stack = await LocalStack.start({
    robots: [{ id, name: 'Robot', args: [...args, '--rate-control', 'fixed', '--bitrate-mbps', '20'] }],
  });
  try {
    const operator = await SignaledOperator.connect(stack.signalingUrl, id);
    await use(operator);
    await operator.close();
  } finally {
    await stack.stop();
  }
}

/** The times in the barcodes of an H.264 stream's pictures, ms; NaN where there is none. */
function barcodeTimes(stream: Uint8Array): number[] {
  const pipeline = 'fdsrc fd=0 ! h264parse ! openh264dec ! video/x-raw,format=I420 ! fdsink fd=1';
  const options = { input: stream, maxBuffer: 512 * 1024 * 1024 };
  const { stdout } = spawnSync('gst-launch-1.0', ['-q', ...pipeline.split(' ')], options);
  const { width, height } = size;
  const bytes = width * height * 1.5;
  return Array.from({ length: Math.floor(stdout.length / bytes) }, (_, i) => {
    const { time } = readBarcode(stdout.subarray(i * bytes, (i + 1) * bytes), width, height, width, 1);
    return time === null ? Number.NaN : msOfBarcodeTime(time);
  });
}

/** The value near `nearMs` whose remainder is known. */
function unwrap(remainderMs: number, periodMs: number, nearMs: number): number {
  return remainderMs + Math.round((nearMs - remainderMs) / periodMs) * periodMs;
}

const tfSchema = z.object({
  transforms: z.array(
    z.object({
      child_frame_id: z.string(),
      transform: z.object({ translation: z.object({ x: z.number() }) }),
    }),
  ),
});

describe.skipIf(!hasVideo)(`videos of a recording (needs: ${BUILD_REMEDY})`, { timeout: 90_000 }, () => {
  /** Of the recording: where the camera was, by time, ms on the recorded robot's clock. */
  const poses: { x: number; ms: number }[] = [];

  beforeAll(async () => {
    const args = ['--config', config, '--sim-size', '64', '--max-points', '600', '--record', path];
    args.push('--record-clouds', 'captured', '--record-fps', '30');
    await withRobot('recorded-drive', args, async ({ client }) => {
      const { videos: described } = await client.message('videos');
      // The pictures carry their capture time, which the played ones then still carry.
      client.sendSession({ type: 'videos', videos: [0], barcode: true });
      const lease = await client.takeLease();
      const frames = () => client.videos.get(described[0]?.mid ?? '')?.frames ?? [];
      const timer = setInterval(() => client.drive(lease, 0.3), 20);
      await client.until(() => frames().length >= 120);
      clearInterval(timer);
    });
    const recording = await openRecording(path);
    const accessUnits: Uint8Array[] = [];
    const videoNs: bigint[] = [];
    const cloudNs = new Set<bigint>();
    const transforms: { x: number; ns: bigint }[] = [];
    const names = ['/farpoint/captured', '/farpoint/videos/Front', '/tf'];
    for await (const { topic, logNs, data } of recording.messages(names, recording.startNs)) {
      if (topic.name === names[0]) cloudNs.add(logNs);
      else if (topic.name === names[1]) {
        accessUnits.push(foxgloveCompressedVideoSchema.parse(topic.decode(data)).data.slice());
        videoNs.push(logNs);
      } else {
        for (const { child_frame_id, transform } of tfSchema.parse(topic.decode(data)).transforms)
          if (child_frame_id === 'camera_optical_frame')
            transforms.push({ x: transform.translation.x, ns: logNs });
      }
    }
    await recording.close();
    // The recorded times are those in the pictures, but for the beginning of the clock.
    const times = barcodeTimes(Buffer.concat(accessUnits));
    const epochs = times.map((ms, i) => Number(videoNs[i]) / 1e6 - ms).filter((ms) => !Number.isNaN(ms));
    expect(epochs.length).toBeGreaterThan(80);
    const [epochMs = 0] = epochs;
    for (const each of epochs) expect(each).toBeCloseTo(epochMs, 1);
    for (const { x, ns } of transforms)
      if (cloudNs.has(ns)) poses.push({ x, ms: Number(ns) / 1e6 - epochMs });
    expect(poses.length).toBeGreaterThan(30);
  }, 90_000);

  it('are cameras of the playing robot, and as far from the clouds as they were', async () => {
    const clouds: { x: number; ms: number }[] = [];
    const frames: { timestampMs: number; key: boolean; bytes: Uint8Array }[] = [];
    let rear = 0;
    const nearMs = monotonicMs();
    await withRobot(
      'played-drive',
      ['--source', 'recording', '--path', path, '--max-points', '300'],
      async ({ client }) => {
        const { videos: described } = await client.message('videos');
        expect(described.map(({ name }) => name)).toEqual(['Front', 'Rear']);
        const [header, placement] = [emptyPointPacketHeader(), emptyPlacement()];
        client.onCloudPacket = (payload) => {
          const view = new DataView(payload.buffer, payload.byteOffset, payload.byteLength);
          if (readCloudPayload(view, header, placement) !== null) return;
          const ms = unwrap(placement.captureTimeUs / 1000, 2 ** 32 / 1000, nearMs);
          if (clouds.at(-1)?.ms !== ms) clouds.push({ x: placement.pose.position.x, ms });
        };
        client.sendSession({ type: 'videos', videos: [0, 1] });
        const of = (video: number) => client.videos.get(described[video]?.mid ?? '')?.frames ?? [];
        await client.until(() => of(0).length >= 90 && of(1).length >= 20 && clouds.length >= 40);
        for (const { timestamp, isKeyFrame: key, bytes } of of(0))
          frames.push({
            timestampMs: unwrap(timestamp / 90, 2 ** 32 / 90, nearMs),
            key,
            bytes: bytes.slice(),
          });
        rear = of(1).length;
        expect(of(1)[0]?.isKeyFrame).toBe(true);
      },
    );
    expect(rear).toBeGreaterThanOrEqual(20);
    expect(frames[0]?.key).toBe(true);
    const recorded = barcodeTimes(Buffer.concat(frames.map(({ bytes }) => bytes)));
    // By how much a picture was played later than it was captured, at the first pass.
    const pictures: { ms: number; delay: number }[] = [];
    for (const [i, ms] of recorded.entries()) {
      if (i > 0 && ms < recorded[i - 1]!) break;
      if (!Number.isNaN(ms)) pictures.push({ ms, delay: frames[i]!.timestampMs - ms });
    }
    expect(pictures.length).toBeGreaterThan(20);
    // A cloud is known by the place of its camera while the robot drives.
    const lates: number[] = [];
    for (const { x, ms } of clouds) {
      const same = poses.filter((pose) => Math.abs(pose.x - x) < 0.0005);
      if (same.length !== 1) continue;
      const captured = same[0]!.ms;
      const after = pictures.findIndex((picture) => picture.ms > captured);
      const [before, next] = [pictures[after - 1], pictures[after]];
      // Playing pauses while nobody watches, or while the machine does: then nothing is known of what is between.
      if (before === undefined || next === undefined || Math.abs(before.delay - next.delay) > 2) continue;
      const late = ms - captured - before.delay;
      // Those of later passes are later by the length of the recording.
      if (Math.abs(late) > 1000) continue;
      lates.push(late);
    }
    expect(lates.length).toBeGreaterThan(10);
    // A machine that pauses moves some of them. To the ms: recorded-videos.test.ts.
    const middle = lates.sort((a, b) => a - b)[lates.length >> 1] ?? Number.NaN;
    expect(Math.abs(middle)).toBeLessThan(2);
  });
});
