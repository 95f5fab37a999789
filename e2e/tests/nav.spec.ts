/** What the robot's own navigator has planned and its map are on the floor, while they hold. */
import { EmulatedLink } from '@farpoint/local-stack';
import { enterVr, Headset, headsetViewport } from '../src/headset.ts';
import { OperatorPage, screenSizes } from '../src/operator-page.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';

/** From the hall through its opening into the corridor. */
const GOAL = '12.2,6';
const robot = {
  ...lightRobot,
  args: [...lightRobot.args, '--sim-size', '160', '--sim-map', '--sim-plan-to', GOAL],
};

const navigation = async (operator: OperatorPage) => (await operator.state()).navigation;

async function expectDrawn(operator: OperatorPage): Promise<void> {
  await expect
    .poll(async () => (await navigation(operator)).pathPoints, { message: 'points of the path' })
    .toBeGreaterThan(3);
  // The building has 20 × 12 m, and the map's cells 0.1 m.
  await expect
    .poll(async () => (await navigation(operator)).mapCells, { message: 'known cells of the map' })
    .toBeGreaterThan(20_000);
}

test('path and map are on the floor, from behind and from above, and can be hidden', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [robot] });
  const operator = await OperatorPage.open(page, stack, { robot: robot.id });
  await operator.expectPoints(300);
  await expectDrawn(operator);
  const facts = page.locator('#facts');
  await expect(facts).toContainText(/Path\s*\d+\.\d m/);
  await expect(facts).toContainText(/Map\s*2\d\.\d × 1\d\.\d m, cells of 0\.1 m, \d s old/);
  for (const [key, view] of [
    ['v', 'behind'],
    ['t', 'above'],
  ] as const) {
    await page.keyboard.press(key);
    for (const size of screenSizes) {
      await page.setViewportSize(size);
      await operator.expectFrames(3);
      await operator.look(testInfo, `${view}-${size.width}`);
    }
  }
  await page.setViewportSize(screenSizes[1]);
  await page.locator('#colours-open').click();
  const shown = page.locator('#navigation');
  await expect(shown).toHaveText('Drawn');
  await shown.click();
  await expect(shown).toHaveText('Not drawn');
  await expect.poll(() => navigation(operator)).toEqual({ pathPoints: 0, mapCells: 0 });
  await shown.click();
  await expectDrawn(operator);
});

test('what no longer holds is not drawn, and its age is told', async ({ page, startStack }, testInfo) => {
  const stack = await startStack({ robots: [] });
  const link = await EmulatedLink.start(stack, { args: ['--rate-mbps', '20', '--rtt-ms', '30'] });
  try {
    const { id } = robot;
    await stack.startRobot({ ...robot, args: [...robot.args, '--signaling', link.signalingUrl] });
    const operator = await OperatorPage.open(page, stack, { robot: id });
    await operator.expectPoints(300);
    await expectDrawn(operator);
    link.tell({ type: 'blackhole', direction: 'both', active: true });
    await expect(page.locator('#facts')).toContainText(/Path.*\d+ s old: not drawn/);
    expect((await navigation(operator)).pathPoints).toBe(0);
    await operator.look(testInfo, 'stale');
    link.tell({ type: 'blackhole', direction: 'both', active: false });
    await expectDrawn(operator);
  } finally {
    await link.stop();
  }
});

test('a robot without a navigator has neither', async ({ page, startStack }) => {
  const stack = await startStack({ robots: [lightRobot] });
  const operator = await OperatorPage.open(page, stack, { robot: lightRobot.id });
  await operator.expectPoints(300);
  expect(await navigation(operator)).toEqual({ pathPoints: 0, mapCells: 0 });
  await expect(page.locator('#facts')).not.toContainText('Path');
});

test.describe('in the headset', () => {
  test.use({ viewport: headsetViewport });

  test('path and map are on the floor', async ({ page, startStack }, testInfo) => {
    const stack = await startStack({ robots: [robot] });
    await Headset.wear(page);
    const operator = await OperatorPage.open(page, stack, { robot: robot.id });
    await operator.expectPoints(300);
    await enterVr(page, operator);
    await expectDrawn(operator);
    await operator.expectFrames(5);
    await operator.look(testInfo, 'headset');
  });
});
