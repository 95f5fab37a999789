/** The real robot program with cameras that it can encode with several codecs, by GStreamer. */
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import type { VideoCodec } from '@farpoint/protocol';
import { useFolder } from '@farpoint/service/testing/folder';
import { availableEncoders } from '@farpoint/video';
import { BUILD_REMEDY } from '@farpoint/video/build';
import { describe, expect, it } from 'vitest';
import type { SignaledOperator } from '../../testing/signaled-operator.ts';
import { useRobot } from '../../testing/use-robot.ts';

const codecs = await availableEncoders().then(
  ({ encoders }) => new Set(encoders.map(({ codec }) => codec)),
  () => new Set(),
);
const folder = useFolder();
const config = join(folder, 'farpoint.yaml');
const size = { width: 320, height: 240, kbitPerS: 400 };
writeFileSync(
  config,
  JSON.stringify({
    robot: {
      videos: [
        { name: 'Front', source: { kind: 'test' }, ...size },
        { name: 'Left', source: { kind: 'sim', left: 0.3, width: 320, height: 240 }, ...size },
        { name: 'Rear', source: { kind: 'test', pattern: 'ball' }, encoder: 'h264', ...size },
      ],
    },
  }),
);

describe.skipIf(codecs.size < 2)(
  `cameras with encoder: auto (needs: ${BUILD_REMEDY}, and encoders of both codecs)`,
  { timeout: 60_000 },
  () => {
    const robot = useRobot('sim-1', [
      ...['--config', config, '--sim-size', '64', '--max-points', '600'],
      ...['--rate-control', 'fixed', '--bitrate-mbps', '10'],
    ]);

    const codecsOf = async ({ client }: SignaledOperator, wanted: readonly VideoCodec[]) => {
      const { videos } = await client.message('videos', (message) =>
        message.videos.every(({ codec }, video) => codec === wanted[video]),
      );
      return videos;
    };
    const watch = ({ client }: SignaledOperator) => client.sendSession({ type: 'videos', videos: [0, 1, 2] });
    /** Resolves when this many frames more have come, with a key frame among them. */
    const more = ({ client }: SignaledOperator, mid: string) => {
      const before = client.videos.get(mid)?.frames.length ?? 0;
      return client.until(() => {
        const frames = client.videos.get(mid)?.frames.slice(before) ?? [];
        return frames.length >= 15 && frames.some(({ isKeyFrame }) => isKeyFrame);
      });
    };

    it('are encoded with what all who watch decode, and with the preferred codec again when that suits', async () => {
      const browser = await robot.connect();
      await codecsOf(browser, ['H264', 'H264', 'H264']);
      watch(browser);
      await Promise.all(['1', '2', '3'].map((mid) => more(browser, mid)));

      const firefox = await robot.connect({ videoCodecs: ['VP8'] });
      watch(firefox);
      const told = await codecsOf(firefox, ['VP8', 'VP8', 'H264']);
      expect(told.map(({ fault }) => fault)).toEqual([
        undefined,
        undefined,
        expect.stringMatching(/does not decode H264/),
      ]);
      await Promise.all([
        ...['1', '2'].flatMap((mid) => [more(browser, mid), more(firefox, mid)]),
        codecsOf(browser, ['VP8', 'VP8', 'H264']),
      ]);
      expect(firefox.client.videos.has('3')).toBe(false);
      const frames = browser.client.videos.get('1')!.frames;
      const steps = frames.slice(1).map(({ timestamp }, i) => (timestamp - frames[i]!.timestamp) >>> 0);
      expect(steps.filter((step) => step === 0 || step >= 2 ** 31)).toEqual([]);

      await firefox.close();
      await codecsOf(browser, ['H264', 'H264', 'H264']);
      await Promise.all(['1', '2'].map((mid) => more(browser, mid)));
    });
  },
);
