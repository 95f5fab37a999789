/** Those who watch through a real Janus, with the page that drives nothing. */
import { writeFileSync } from 'node:fs';
import { findJanus, JANUS_REMEDY, JanusServer } from '@farpoint/local-stack';
import type { WatchStats } from '@farpoint/webxr/watch-api';
import type { Page } from '@playwright/test';
import { hasVideo, NEEDS_VIDEO, robotLike, testCamera } from '../src/robots.ts';
import { expect, test } from '../src/smoke-test.ts';

const stats = (page: Page): Promise<WatchStats | undefined> =>
  page.evaluate(() => window.farpointWatch?.stats());
const videoFrames = async (page: Page): Promise<number> => {
  const videos = (await stats(page))?.videos.videos ?? [];
  return videos.length < 2 ? 0 : Math.min(...videos.map(({ frames }) => frames));
};
const cloudFrames = async (page: Page): Promise<number> => (await stats(page))?.cloud.frames ?? 0;

test('cameras and clouds come through Janus in step, and again after Janus and the robot were killed', async ({
  page,
  shared,
  startRobot,
}, testInfo) => {
  test.skip(findJanus() === null, `needs Janus: ${JANUS_REMEDY}`);
  test.skip(!hasVideo, NEEDS_VIDEO);
  const { stack } = shared;
  const janus = await JanusServer.start();
  try {
    const config = testInfo.outputPath('farpoint.yaml');
    const videos = [testCamera('Front', 'x264enc', 'pinwheel'), testCamera('Rear', 'vp8enc', 'ball')];
    const broadcast = { janus: janus.url, adminKey: janus.adminKey, mountpoint: 3, pin: 'look', mbps: 6 };
    // JSON is valid YAML.
    writeFileSync(config, JSON.stringify({ robot: { videos, broadcast } }));
    const robot = robotLike('broadcast', '--config', config);
    const watch = `${stack.webUrl}watch.html?janus=${janus.url}&mountpoint=3&pin=look`;
    const link = page.locator('#link');
    const expectLive = async () => {
      await expect(link).toHaveText(`Live · ${robot.name}`);
      const [video, cloud] = [await videoFrames(page), await cloudFrames(page)];
      await expect.poll(() => videoFrames(page)).toBeGreaterThan(video + 5);
      await expect.poll(() => cloudFrames(page)).toBeGreaterThan(cloud + 5);
    };
    await page.goto(watch);
    await expect(link).toContainText('not broadcasting');
    await startRobot(robot);
    await expectLive();
    const states = async () =>
      ((await stats(page))?.videos.sources ?? [])
        .filter(({ source }) => source.startsWith('video:'))
        .map(({ state }) => state);
    await expect.poll(states).toEqual(['in-step', 'in-step']);

    await janus.kill();
    await expect(link).not.toContainText('Live');
    await expect(page.locator('#pictures figure[data-state="frozen"]')).toHaveCount(2);
    await janus.restart();
    await expectLive();

    await stack.robot(robot.id).kill();
    await expect(link).not.toContainText('Live');
    await stack.restartRobot(robot.id);
    await expectLive();
  } finally {
    await janus.stop();
  }
});
