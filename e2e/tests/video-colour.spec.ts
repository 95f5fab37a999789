/** The depth camera's surface with the colours of its own video. */
import type { Page, TestInfo } from '@playwright/test';
import { enterVr, Headset, headsetViewport } from '../src/headset.ts';
import { OperatorPage } from '../src/operator-page.ts';
import { leftEye, meanDifference, rightEye, sharesNear } from '../src/picture.ts';
import { expect, LONG, test } from '../src/stack-test.ts';
import { hasVideo, testCamera, videoRobot } from '../src/video-robot.ts';

test.skip(!hasVideo, 'needs GStreamer and `pnpm build:native video`');

const CANVAS = '160x120';
/** Of the page, where no panel lies. */
const MIDDLE = { left: 0.35, top: 0.25, width: 0.3, height: 0.5 };
const WHITE = [255, 255, 255] as const;
/** Slow, so that each picture comes while its cloud is still drawn, also where robot and page share a busy processor. */
const RATE = 2;
/**
 * A cloud whose picture comes after it is white only once the colours have blended. Looked at in the rhythm of the clouds, each
 * might be seen just before that.
 */
const UNEVEN_MS = Array.from({ length: 20 }, (_, i) => 100 + 70 * i);
const robot = {
  id: 'painted',
  name: 'Painted',
  args: ['--source', 'sim', '--sim-seed', '1', '--sim-size', '96', '--start-mbps', '20'],
};
const size = { width: 240, height: 240, framesPerS: RATE };
const camera = (source: object) =>
  testCamera('Depth camera', 'vp8enc', {
    ...{ ...size, kbitPerS: 1000, ofCloud: true },
    source: { ...size, ...source },
  });
const whiteCamera = camera({ kind: 'test', pattern: 'white' });

const colour = async (operator: OperatorPage) => (await operator.stats()).videoColour;
const expectState = (operator: OperatorPage, state: string) =>
  expect.poll(async () => (await colour(operator))?.state).toBe(state);

async function whiteShare(page: Page, operator: OperatorPage, testInfo: TestInfo, name: string) {
  const picture = await operator.screenshot(testInfo, name);
  const [share] = await sharesNear(page, picture, MIDDLE, [WHITE], 30);
  return share as number;
}

test(
  'a white video paints the surface white; without it, the surface has the packets’ colours',
  { tag: LONG },
  async ({ page, startStack }, testInfo) => {
    const stack = await startStack({ robots: [videoRobot(robot, [whiteCamera])] });
    const operator = await OperatorPage.open(page, stack, {
      ...{ robot: robot.id, canvas: CANVAS, surface: '1', every: '1' },
    });
    await operator.expectPoints(5000);
    await expectState(operator, 'painted');
    await expect
      .poll(() => whiteShare(page, operator, testInfo, 'painted-white'), { intervals: UNEVEN_MS })
      .toBeGreaterThan(0.9);

    await page.getByRole('button', { name: 'Colours', exact: true }).click();
    const button = page.getByRole('button', { name: 'Video', exact: true });
    await expect(button).toHaveAttribute('aria-pressed', 'true');
    await button.click();
    await expectState(operator, 'switched-off');
    await operator.expectFrames(1);
    expect(await whiteShare(page, operator, testInfo, 'switched-off')).toBeLessThan(0.3);
    await button.click();
    await expectState(operator, 'painted');

    // Nobody watches the video: it stops, and the next clouds have the packets' colours.
    await page.getByRole('button', { name: 'Hide Depth camera' }).click();
    await expectState(operator, 'not-watched');
    await operator.expectFrames(2);
    expect(await whiteShare(page, operator, testInfo, 'video-stopped')).toBeLessThan(0.3);
  },
);

test('the simulated depth camera’s own picture lies where the packets’ colours do', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [videoRobot(robot, [camera({ kind: 'sim' })])] });
  const operator = await OperatorPage.open(page, stack, {
    ...{ robot: robot.id, canvas: CANVAS, surface: '1', every: '1' },
  });
  await operator.expectPoints(5000);
  await page.getByRole('button', { name: 'Colours', exact: true }).click();
  await expect.poll(async () => (await colour(operator))?.share).toBeGreaterThan(0.3);
  const painted = await operator.screenshot(testInfo, 'own-video');
  await page.getByRole('button', { name: 'Video', exact: true }).click();
  await expectState(operator, 'switched-off');
  await operator.expectFrames(1);
  const own = await operator.screenshot(testInfo, 'packets-own-colours');
  // People walk by, and the packets' colours are coarse. A picture in a wrong place would differ everywhere.
  const difference = await meanDifference(page, painted, own, MIDDLE);
  expect(difference).toBeLessThan(40);
});

test(
  'while the video paints, the packets have coarse colours; without it, full ones again',
  { tag: LONG },
  async ({ page, startStack }, testInfo) => {
    // Large enough for packets to have colours to look at within their bits a point.
    const large = { ...robot, args: [...robot.args, '--sim-size', '144'] };
    const stack = await startStack({ robots: [videoRobot(large, [camera({ kind: 'sim' })])] });
    const operator = await OperatorPage.open(page, stack, {
      ...{ robot: robot.id, canvas: CANVAS, surface: '1', every: '1', coarse: '1' },
    });
    await operator.expectPoints(10_000);
    const coarseFrames = async () => {
      const text = await (await fetch(`${stack.robotAdminUrl(robot.id)}/metrics`)).text();
      return Number(/^farpoint_robot_frames_coarse_total (\d+)$/m.exec(text)?.[1]);
    };
    await expect.poll(async () => (await colour(operator))?.claimed).toEqual([0]);
    await expect.poll(coarseFrames).toBeGreaterThan(1);
    await operator.look(testInfo, 'painted-over-coarse-colours');

    await page.getByRole('button', { name: 'Hide Depth camera' }).click();
    await expect.poll(async () => (await colour(operator))?.claimed).toEqual([]);
    await operator.look(testInfo, 'the-video-has-just-stopped');
    await operator.expectFrames(3);
    const count = await coarseFrames();
    await operator.expectFrames(10);
    expect(await coarseFrames()).toBe(count);
    await operator.look(testInfo, 'full-colours-again');
  },
);

test.describe('in the headset', () => {
  test.use({ viewport: headsetViewport });

  test('both eyes see the surface in the video’s colours', async ({ page, startStack }, testInfo) => {
    const stack = await startStack({ robots: [videoRobot(robot, [whiteCamera])] });
    await Headset.wear(page);
    const operator = await OperatorPage.open(page, stack, { robot: robot.id, surface: '1' });
    await operator.expectPoints(5000);
    await enterVr(page, operator);
    await expectState(operator, 'painted');
    const whiteOfBoth = async () => {
      const picture = await operator.screenshot(testInfo, 'painted-both-eyes');
      const shares: number[] = [];
      for (const eye of [leftEye, rightEye])
        shares.push(...(await sharesNear(page, picture, eye, [WHITE], 30)));
      return Math.min(...shares);
    };
    await expect.poll(whiteOfBoth).toBeGreaterThan(0.2);
  });
});
