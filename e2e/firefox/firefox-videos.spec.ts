/** Cameras' videos in an unmodified Firefox, which receives and decodes them itself. */
import { expect, test } from '../src/firefox-test.ts';
import { type BrowserPage, OperatorPage } from '../src/operator-page.ts';
import { simulatedRobot } from '../src/stack-test.ts';
import { hasVideo, testCamera, videoRobot } from '../src/video-robot.ts';

test.skip(!hasVideo, 'needs GStreamer and `pnpm build:native video`');

const light = {
  ...simulatedRobot,
  args: [...simulatedRobot.args.slice(0, -1), '600', '--sim-size', '64', '--fps', '10'],
};
const small = { width: 320, height: 240, framesPerS: 15, kbitPerS: 400 };
const videosOf = (page: Pick<BrowserPage, 'evaluate'>) => page.evaluate(() => window.farpoint.videos());
const source = (pattern: string) => ({ kind: 'test', pattern, width: 320, height: 240, framesPerS: 15 });

function decodesH264(page: Pick<BrowserPage, 'evaluate'>): Promise<boolean> {
  return page.evaluate(() =>
    (RTCRtpReceiver.getCapabilities('video')?.codecs ?? []).some(
      ({ mimeType }) => mimeType.toLowerCase() === 'video/h264',
    ),
  );
}

test('shows VP8 live and in step; one that it cannot decode says why', async ({
  firefoxPage,
  startStack,
}, testInfo) => {
  const cameras = [
    testCamera('Front', 'vp8enc', { ...small, source: source('pinwheel') }),
    testCamera('Rear', 'vp8enc', { ...small, source: source('ball') }),
    testCamera('Arm', 'x264enc', { ...small, source: source('smpte') }),
  ];
  const stack = await startStack({ robots: [videoRobot(light, cameras)] });
  const operator = await OperatorPage.open(firefoxPage, stack, { robot: light.id, canvas: '160x90' });
  await operator.expectPoints(300);
  const videos = () => videosOf(firefoxPage);
  await expect
    .poll(async () => Math.min(...(await videos()).slice(0, 2).map(({ frames }) => frames)), {
      timeout: 30_000,
    })
    .toBeGreaterThan(30);
  const [front, rear, arm] = await videos();
  expect([front?.fault, rear?.fault, front?.width, rear?.height]).toEqual([null, null, 320, 240]);
  // Firefox decodes H.264 only once it has fetched a plugin.
  if (await decodesH264(firefoxPage))
    await expect.poll(async () => (await videos())[2]?.frames).toBeGreaterThan(0);
  else expect(arm?.fault).toContain('cannot decode');
  const { receiver, spreadMs, videos: shown, undated } = (await operator.stats()).videos;
  // Frames may come before the clocks of robot and page have been compared.
  expect(receiver).toBe('native');
  expect(undated).toBeLessThan(30);
  expect(spreadMs).not.toBeNull();
  console.log(
    `age ms ${shown.map(({ ageMs }) => ageMs?.p50.toFixed(0))}, spread ${spreadMs?.p50.toFixed(1)}`,
  );
  console.log(`H.264: ${arm?.fault ?? `${arm?.frames} frames`}`);

  await firefoxPage.keyboard.press('f');
  await firefoxPage.waitForFunction(() => document.querySelector('#camera-stage canvas') !== null);
  await operator.expectFrames(5);
  expect((await operator.stats()).videos.undated).toBe(undated);
  await operator.screenshot(testInfo, 'firefox-videos');
});

test('with `auto`, a Firefox without H.264 sees VP8 like everyone, until it has left', async ({
  page,
  firefoxPage,
  startStack,
}, testInfo) => {
  test.skip(await decodesH264(firefoxPage), 'this Firefox has fetched its H.264 plugin');
  const cameras = [testCamera('Front', 'auto', { ...small, source: source('pinwheel') })];
  const stack = await startStack({ robots: [videoRobot(light, cameras)] });
  const options = { robot: light.id, canvas: '160x90' };
  const chromium = await OperatorPage.open(page, stack, options);
  await chromium.expectPoints(300);
  const seen = async (of: Pick<BrowserPage, 'evaluate'>) => {
    const [video] = await videosOf(of);
    return { codec: video?.codec, frames: video?.frames ?? 0, fault: video?.fault ?? null };
  };
  const seesMore = async (of: Pick<BrowserPage, 'evaluate'>, codec: string) => {
    await expect.poll(async () => (await seen(of)).codec, { timeout: 30_000 }).toBe(codec);
    const { frames } = await seen(of);
    await expect.poll(async () => (await seen(of)).frames, { timeout: 30_000 }).toBeGreaterThan(frames + 30);
    expect((await seen(of)).fault).toBeNull();
  };
  await seesMore(page, 'H264');

  const firefox = await OperatorPage.open(firefoxPage, stack, options);
  await firefox.expectPoints(300);
  await seesMore(firefoxPage, 'VP8');
  await seesMore(page, 'VP8');
  await firefox.screenshot(testInfo, 'firefox-auto');
  await chromium.screenshot(testInfo, 'chromium-beside-firefox');

  await firefoxPage.goto('about:blank');
  await seesMore(page, 'H264');
});
