/** The real robot program with cameras encoded by GStreamer. */
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { useFolder } from '@farpoint/service/testing/folder';
import { BUILD_REMEDY } from '@farpoint/video/build';
import { describe, expect, it } from 'vitest';
import { useRobot } from '../../testing/use-robot.ts';
import { hasVideo } from '../../testing/watched-camera.ts';

const folder = useFolder();
const config = join(folder, 'farpoint.yaml');
writeFileSync(
  config,
  JSON.stringify({
    robot: {
      videos: [
        {
          name: 'Front',
          source: { kind: 'test' },
          encoder: 'vp8enc',
          width: 320,
          height: 240,
          kbitPerS: 400,
        },
        {
          name: 'Rear',
          source: { kind: 'test', pattern: 'ball' },
          encoder: 'x264enc',
          width: 320,
          height: 240,
        },
        {
          name: 'Left',
          source: { kind: 'sim', left: 0.3, width: 320, height: 240 },
          encoder: 'vp8enc',
          framesPerS: 20,
        },
        { name: 'Broken', source: { kind: 'gst', pipeline: 'nonsense ! more' }, encoder: 'vp8enc' },
      ],
    },
  }),
);

describe.skipIf(!hasVideo)(`cameras with video (needs: ${BUILD_REMEDY})`, { timeout: 60_000 }, () => {
  const robot = useRobot('sim-1', [
    ...['--config', config, '--sim-size', '64', '--max-points', '600'],
    ...['--rate-control', 'fixed', '--bitrate-mbps', '10'],
  ]);

  it('stream what an operator asks for, and say what does not work', async () => {
    const { client } = await robot.connect();
    const described = await client.message('videos');
    expect(described.videos.map(({ name, codec }) => [name, codec])).toEqual([
      ['Front', 'VP8'],
      ['Rear', 'H264'],
      ['Left', 'VP8'],
      ['Broken', 'VP8'],
    ]);
    expect(client.videos.size).toBe(0);
    client.sendSession({ type: 'videos', videos: [0, 1, 2, 3] });
    const [front = '', rear = '', left = ''] = described.videos.map(({ mid }) => mid);
    const frames = (mid: string) => client.videos.get(mid)?.frames ?? [];
    // On a busy machine, a packet of the first may be lost: another key frame follows.
    const received = (mid: string) =>
      frames(mid).length >= 20 && frames(mid).some(({ isKeyFrame }) => isKeyFrame);
    await client.until(() => [front, rear, left].every(received));
    for (const mid of [front, rear, left]) {
      const stamps = frames(mid).map(({ timestamp }) => timestamp);
      const steps = stamps.slice(1).map((stamp, i) => (stamp - stamps[i]!) >>> 0);
      // Each is newer than the one before, in arithmetic modulo 2³².
      expect(steps.filter((step) => step === 0 || step >= 2 ** 31)).toEqual([]);
    }
    const told = await client.message('videos', ({ videos }) => videos[3]?.fault !== undefined);
    expect(told.videos[3]?.fault).toMatch(/element.*nonsense/);
    for (const { fault } of told.videos.slice(0, 3)) expect(fault).toBeUndefined();
  });
});
