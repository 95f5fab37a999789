/** A camera that changes its codec for those who watch, in all ways to receive it. */
import type { Page } from '@playwright/test';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, LONG, simulatedRobot, test } from '../src/stack-test.ts';
import { hasVideo, testCamera, videoRobot } from '../src/video-robot.ts';

test.skip(!hasVideo, 'needs GStreamer and `pnpm build:native video`');

const light = {
  ...simulatedRobot,
  args: [...simulatedRobot.args, '--max-points', '600', '--sim-size', '64', '--fps', '10'],
};
const size = { width: 320, height: 240, framesPerS: 15 };
const more = { ...size, kbitPerS: 400 };
const cameras = [
  testCamera('Front', 'auto', { ...more, source: { kind: 'test', pattern: 'pinwheel', ...size } }),
  testCamera('Rear', 'h264', { ...more, source: { kind: 'test', pattern: 'ball', ...size } }),
];

const videos = (page: Page) => page.evaluate(() => window.farpoint.videos());

async function seesMore(page: Page, codec: string): Promise<void> {
  await expect.poll(async () => (await videos(page))[0]?.codec).toBe(codec);
  const frames = async () => (await videos(page))[0]?.frames ?? 0;
  const before = await frames();
  await expect.poll(frames).toBeGreaterThan(before + 20);
  expect((await videos(page))[0]?.fault).toBeNull();
}

/** As a Chromium that was built without H.264. */
function withoutH264(page: Page): Promise<unknown> {
  return page.addInitScript(() => {
    const { prototype } = RTCPeerConnection;
    const apply = prototype.setRemoteDescription as (description: RTCSessionDescriptionInit) => Promise<void>;
    prototype.setRemoteDescription = function (
      this: RTCPeerConnection,
      description: RTCSessionDescriptionInit,
    ) {
      const sections = (description.sdp ?? '').split(/^(?=m=)/m).map((section) => {
        const type = /^a=rtpmap:(\d+) H264\//m.exec(section)?.[1];
        if (type === undefined) return section;
        const others = section.split('\r\n').filter((line) => !line.match(`^a=[a-z-]+:${type} `));
        const left = others.join('\r\n').replace(new RegExp(`^(m=.*) ${type}(?= |\\r)`), '$1');
        // A line of H.264 only is one that it cannot decode.
        return /^m=\S+ \d+ \S+ /.test(left) ? left : section.replaceAll('H264/', 'none/');
      });
      return apply.call(this, { type: description.type ?? 'offer', sdp: sections.join('') });
    } as typeof prototype.setRemoteDescription;
  });
}

for (const video of ['track', 'webcodecs', 'native'] as const) {
  test(
    `${video} goes on when a camera changes its codec`,
    { tag: video === 'track' ? [] : LONG },
    async ({ page, context, startStack }, testInfo) => {
      const stack = await startStack({ robots: [videoRobot(light, cameras)] });
      const options = { robot: light.id, canvas: '160x90' };
      const operator = await OperatorPage.open(page, stack, { ...options, video });
      await operator.expectPoints(300);
      await seesMore(page, 'H264');
      expect((await operator.stats()).videos.receiver).toBe(video);

      const other = await context.newPage();
      await withoutH264(other);
      const second = await OperatorPage.open(other, stack, options);
      await second.expectPoints(300);
      await seesMore(other, 'VP8');
      await page.bringToFront();
      await seesMore(page, 'VP8');
      // The camera that has H.264 only is one that the second cannot see, and that goes on for the first.
      expect((await videos(other))[1]).toMatchObject({ codec: 'H264', frames: 0 });
      expect((await videos(other))[1]?.fault).toMatch(/cannot decode|does not decode/);
      expect((await videos(page))[1]).toMatchObject({ codec: 'H264', fault: null });
      await operator.look(testInfo, `codec-${video}`);

      await other.close();
      await seesMore(page, 'H264');
    },
  );
}
