/** The robot program recording its cameras' video, with GStreamer, while nobody watches. */
import { spawnSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { LocalStack } from '@farpoint/local-stack';
import { openRecording } from '@farpoint/recording';
import { foxgloveCompressedVideoSchema, stampNs } from '@farpoint/ros';
import { useFolder } from '@farpoint/service/testing/folder';
import { BUILD_REMEDY } from '@farpoint/video/build';
import { describe, expect, it, vi } from 'vitest';
import { metricOf } from './testing/metric-of.ts';
import { hasVideo } from './testing/watched-camera.ts';

const ROBOT = 'recorded-videos';
const folder = useFolder();
const path = join(folder, 'drive.mcap');
const config = join(folder, 'farpoint.yaml');
const size = { width: 320, height: 240 };
const videos = [
  { name: 'Front', source: { kind: 'test' }, encoder: 'x264enc', kbitPerS: 800, ...size },
  { name: 'Rear', source: { kind: 'test', pattern: 'ball' }, encoder: 'vp8enc', ...size },
];
writeFileSync(config, JSON.stringify({ robot: { videos } }));

const NAL_TYPES = { slice: 1, keySlice: 5, sequenceParameters: 7, pictureParameters: 8 };

function nalTypes(accessUnit: Uint8Array): number[] {
  const types: number[] = [];
  for (let i = 0; i + 3 < accessUnit.length; i++) {
    if (accessUnit[i] === 0 && accessUnit[i + 1] === 0 && accessUnit[i + 2] === 1)
      types.push(accessUnit[i + 3]! & 0x1f);
  }
  return types;
}

/** How many pictures GStreamer decodes from an H.264 stream. */
function decodedPictures(stream: Uint8Array): number {
  const pipeline = 'fdsrc fd=0 ! h264parse ! openh264dec ! video/x-raw,format=I420 ! fdsink fd=1';
  const options = { input: stream, maxBuffer: 256 * 1024 * 1024 };
  const { stdout } = spawnSync('gst-launch-1.0', ['-q', ...pipeline.split(' ')], options);
  return stdout.length / (size.width * size.height * 1.5);
}

describe.skipIf(!hasVideo)(`cameras in a recording (needs: ${BUILD_REMEDY})`, { timeout: 60_000 }, () => {
  it('are recorded whole, one access unit a message, although nobody watches', async () => {
    const args = ['--config', config, '--sim-size', '64', '--record', path];
    const stack = await LocalStack.start({ robots: [{ id: ROBOT, name: 'Robot', args }] });
    const frames = (camera: string) =>
      metricOf(stack.robotAdminUrl(ROBOT), `farpoint_robot_video_frames_total{camera="${camera}"}`);
    const enough = async () => {
      expect(await frames('Front')).toBeGreaterThan(150);
      expect(await frames('Rear')).toBeGreaterThan(30);
    };
    await vi.waitFor(enough, { interval: 100, timeout: 50_000 });
    // By a machine that stalls; counted, and gone from one key frame to the next.
    const metric = 'farpoint_robot_recording_dropped_total{kind="videos"}';
    const dropped = await metricOf(stack.robotAdminUrl(ROBOT), metric);
    await stack.stop();

    const recording = await openRecording(path);
    const recorded = new Map<string, { key: boolean; ns: bigint; data: Uint8Array }[]>();
    const topics = ['/farpoint/videos/Front', '/farpoint/videos/Rear'];
    for await (const { topic, data, logNs } of recording.messages(topics, recording.startNs)) {
      const message = foxgloveCompressedVideoSchema.parse(topic.decode(data));
      expect(topic.type).toBe('foxglove_msgs/msg/CompressedVideo');
      expect(stampNs(message.timestamp)).toBe(logNs);
      const isFront = topic.name === topics[0];
      expect(message).toMatchObject(
        isFront ? { format: 'h264', frame_id: 'Front' } : { format: 'vp8', frame_id: 'Rear' },
      );
      const of = recorded.get(topic.name) ?? [];
      recorded.set(topic.name, of);
      const key = isFront
        ? nalTypes(message.data).includes(NAL_TYPES.keySlice)
        : (message.data[0]! & 1) === 0;
      of.push({ key, ns: logNs, data: message.data.slice() });
    }
    await recording.close();

    for (const [, each] of recorded) {
      expect(each[0]?.key).toBe(true);
      expect(each.every(({ ns }, i) => i === 0 || ns > each[i - 1]!.ns)).toBe(true);
    }
    const front = recorded.get(topics[0]!) ?? [];
    expect(front.length + dropped).toBeGreaterThanOrEqual(150);
    for (const { key, data } of front) {
      const types = nalTypes(data);
      const { slice, keySlice, sequenceParameters, pictureParameters } = NAL_TYPES;
      expect(types.filter((type) => type === slice || type === keySlice).length).toBeGreaterThan(0);
      for (const type of [sequenceParameters, pictureParameters]) expect(types.includes(type)).toBe(key);
    }
    // Key frames come often enough to jump into the video.
    const keys = front.filter(({ key }) => key).map(({ ns }) => Number(ns - front[0]!.ns) / 1e9);
    expect(keys.length).toBeGreaterThan(1);
    expect(Math.max(...keys.slice(1).map((s, i) => s - keys[i]!))).toBeLessThan(6);
    // The decoder keeps the last pictures of a stream to itself.
    expect(decodedPictures(Buffer.concat(front.map(({ data }) => data)))).toBeGreaterThan(front.length - 10);
  });
});
