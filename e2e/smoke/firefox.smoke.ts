/**
 * The operator's page in an unmodified Firefox, which hides its addresses behind mDNS names, trickles TCP candidates, and
 * decodes videos itself.
 */
import { expect, test } from '../src/firefox-test.ts';
import { type BrowserPage, expectStanding, OperatorPage, poseOf } from '../src/operator-page.ts';
import { hasVideo, NEEDS_VIDEO, wholeRobot } from '../src/robots.ts';

test('sees the whole cloud, drives, and stops while the hand still drives', async ({
  firefoxPage,
  shared,
  startRobot,
}) => {
  const { stack } = shared;
  await startRobot(wholeRobot);
  const operator = await OperatorPage.open(firefoxPage, stack.webUrl, { robot: wholeRobot.id, every: '1' });
  await operator.expectPoints(10_000);
  // 480 × 480 pixels, about 15 % of which a stereo camera cannot see.
  await expect.poll(async () => (await operator.stats()).pointsPerFrame).toBeGreaterThan(170_000);
  const start = await poseOf(operator);
  await operator.hold(operator.keys);
  await operator.expectState('holder', 'you');
  await operator.expectMovedFrom(start, 0.2);
  await firefoxPage.keyboard.press('x');
  await operator.expectState('estop', true);
  await expectStanding(operator);
  await operator.release();
  await operator.cannotDrive();
});

test('shows videos in step, in VP8 if it has no H.264; one that it cannot decode says why', async ({
  firefoxPage,
  shared,
}) => {
  test.skip(!hasVideo, NEEDS_VIDEO);
  const { spec } = await shared.media();
  const options = { robot: spec.id, canvas: '160x90' };
  const operator = await OperatorPage.open(firefoxPage, shared.stack.webUrl, options);
  await operator.expectPoints();
  const videos = () => (firefoxPage as BrowserPage).evaluate(() => window.farpoint.videos());
  await expect.poll(async () => (await videos())[0]?.frames ?? 0).toBeGreaterThan(5);
  const [front, rear] = await videos();
  expect([front?.fault, front?.width, front?.height]).toEqual([null, 320, 240]);
  // Firefox decodes H.264 only once it has fetched a plugin.
  if (front?.codec === 'H264') await expect.poll(async () => (await videos())[1]?.frames).toBeGreaterThan(0);
  else expect([front?.codec, rear?.fault]).toEqual(['VP8', expect.stringContaining('cannot decode')]);
  expect((await operator.stats()).videos.receiver).toBe('native');

  await firefoxPage.keyboard.press('f');
  await firefoxPage.waitForFunction(() => document.querySelector('#camera-stage canvas') !== null);
  await operator.expectFrames(2);
});
