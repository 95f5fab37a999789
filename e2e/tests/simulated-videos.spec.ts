import type { Page } from '@playwright/test';
import { OperatorPage } from '../src/operator-page.ts';
import { readShownVideos, type ShownVideos } from '../src/shown-videos.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';
import { hasVideo, testCamera, videoRobot } from '../src/video-robot.ts';

test.skip(!hasVideo, 'needs GStreamer and `pnpm build:native video`');

const panel = (page: Page, name: string) => page.locator('#pictures figure', { hasText: name });
const small = { width: 320, height: 240, framesPerS: 15, kbitPerS: 400 };
const placed = (left: number, yaw: number) => ({
  ...small,
  source: { kind: 'sim', left, yaw, width: 320, height: 240, framesPerS: 15 },
});
const videos = (page: Page) => page.evaluate(() => window.farpoint.videos());
const fewestFrames = async (page: Page) => Math.min(...(await videos(page)).map(({ frames }) => frames));

test('two simulated cameras show what the robot sees, captured at the same instants', async ({
  page,
  startStack,
}, testInfo) => {
  const cameras = [
    testCamera('Left', 'vp8enc', placed(0.3, 0.4)),
    testCamera('Right', 'x264enc', placed(-0.3, -0.4)),
  ];
  const stack = await startStack({ robots: [videoRobot(lightRobot, cameras)] });
  const operator = await OperatorPage.open(page, stack, {
    ...{ robot: lightRobot.id, barcode: '1', canvas: '160x90' },
  });
  await operator.expectPoints(300);
  for (const { name } of cameras) await expect(panel(page, name).locator('canvas')).toBeVisible();
  await expect.poll(() => fewestFrames(page), { timeout: 20_000 }).toBeGreaterThan(20);
  expect((await videos(page)).map(({ name, width, height, fault }) => [name, width, height, fault])).toEqual([
    ['Left', 320, 240, null],
    ['Right', 320, 240, null],
  ]);
  const samples: ShownVideos[] = [];
  for (let i = 0; i < 20; i++) {
    samples.push(await readShownVideos(page, [0, 1]));
    const before = await fewestFrames(page);
    await expect.poll(() => fewestFrames(page)).toBeGreaterThan(before);
  }
  await operator.look(testInfo, 'simulated-videos');
  const times = samples.map((sample) => sample.videos.map(({ drawnMs }) => drawnMs ?? Number.NaN));
  // Equal to the nanosecond, where both show the same capture; on a busy machine, one of them may be left out.
  const together = times.filter(([left = 0, right = 1]) => Math.abs(left - right) < 0.001);
  expect(together.length / times.length).toBeGreaterThan(0.5);
});
