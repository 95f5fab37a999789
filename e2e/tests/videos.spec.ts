import type { Page } from '@playwright/test';
import { OperatorPage } from '../src/operator-page.ts';
import { readShownVideos, type ShownVideos } from '../src/shown-videos.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';
import { hasVideo, testCamera, videoRobot } from '../src/video-robot.ts';

test.skip(!hasVideo, 'needs GStreamer and `pnpm build:native video`');

const panel = (page: Page, name: string) => page.locator('#pictures figure', { hasText: name });
const small = { width: 320, height: 240, framesPerS: 15, kbitPerS: 400 };
const pictured = (pattern: string) => ({ source: { kind: 'test', pattern, ...sizeOf(small) }, ...small });

function sizeOf({ width, height, framesPerS }: typeof small) {
  return { width, height, framesPerS };
}

const videos = (page: Page) => page.evaluate(() => window.farpoint.videos());
const fewestFrames = async (page: Page) => Math.min(...(await videos(page)).map(({ frames }) => frames));

test('three cameras are shown live and in step, each picture with its own time', async ({
  page,
  startStack,
}) => {
  const cameras = [
    testCamera('Front', 'vp8enc', pictured('pinwheel')),
    testCamera('Left', 'x264enc', pictured('ball')),
    testCamera('Right', 'vp8enc', pictured('smpte')),
  ];
  const stack = await startStack({ robots: [videoRobot(lightRobot, cameras)] });
  const operator = await OperatorPage.open(page, stack, {
    ...{ robot: lightRobot.id, barcode: '1', canvas: '160x90' },
  });
  await operator.expectPoints(300);
  for (const { name } of cameras) await expect(panel(page, name).locator('canvas')).toBeVisible();
  await expect.poll(() => fewestFrames(page), { timeout: 20_000 }).toBeGreaterThan(20);
  expect((await videos(page)).map(({ name, width, height, fault }) => [name, width, height, fault])).toEqual(
    cameras.map(({ name }) => [name, 320, 240, null]),
  );
  // On a busy machine, an encoder may leave out a picture for which the others do not wait.
  await expect
    .poll(
      async () => {
        const { videos: each }: ShownVideos = await readShownVideos(page, [0, 1, 2]);
        // What the page knows is what is drawn.
        for (const { knownMs, drawnMs } of each)
          if (drawnMs !== null) expect(Math.abs(knownMs - drawnMs)).toBeLessThan(0.1);
        const drawn = each.map(({ drawnMs }) => drawnMs ?? Number.NaN);
        return Math.max(...drawn) - Math.min(...drawn);
      },
      { message: 'from the oldest to the newest that are shown together, ms', timeout: 60_000 },
    )
    .toBeLessThan(1);
});

test('a camera without pictures says why, one that is hidden is not sent, and the others go on', async ({
  page,
  startStack,
}) => {
  const cameras = [
    testCamera('Front', 'vp8enc', pictured('pinwheel')),
    testCamera('Rear', 'vp8enc', { ...small, source: { kind: 'v4l2', device: '/dev/no-such-camera' } }),
  ];
  const stack = await startStack({ robots: [videoRobot(lightRobot, cameras)] });
  const operator = await OperatorPage.open(page, stack, { robot: lightRobot.id, canvas: '160x90' });
  await operator.expectPoints(300);
  await expect.poll(async () => (await videos(page))[0]?.frames, { timeout: 20_000 }).toBeGreaterThan(5);
  await expect(panel(page, 'Rear')).toContainText('/dev/no-such-camera');

  await page.getByRole('button', { name: 'Hide Front' }).click();
  await expect(panel(page, 'Front').locator('canvas')).toBeHidden();
  const encoded = async () => {
    const text = await (await fetch(`${stack.robotAdminUrl(lightRobot.id)}/metrics`)).text();
    return Number(/^farpoint_robot_video_frames_total\{camera="Front"\} (\d+)/m.exec(text)?.[1]);
  };
  await expect
    .poll(
      async () => {
        const before = await encoded();
        await operator.expectFrames(10);
        return (await encoded()) - before;
      },
      { timeout: 20_000 },
    )
    .toBe(0);
  const frames = (await videos(page))[0]?.frames ?? 0;
  await page.getByRole('button', { name: 'Show Front' }).click();
  await expect
    .poll(async () => (await videos(page))[0]?.frames, { timeout: 20_000 })
    .toBeGreaterThan(frames + 5);
});
