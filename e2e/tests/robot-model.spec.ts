/** The robot's model: seen from outside with its joints where they are, never from the robot's own eyes. */
import { Headset, headsetViewport } from '../src/headset.ts';
import { OperatorPage } from '../src/operator-page.ts';
import { LAPTOP, screenSizes } from '../src/screens.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';

const robot = { ...lightRobot, args: [...lightRobot.args, '--sim-size', '160'] };
/** Base, its lid, its front, caster, mast and camera; tyre and mark of two wheels. */
const SHAPES = 10;

const model = async (operator: OperatorPage) => (await operator.state()).model;

async function expectDrawn(operator: OperatorPage, drawn: boolean): Promise<void> {
  await expect.poll(() => model(operator)).toMatchObject({ links: 2, shapes: SHAPES, drawn });
}

test('it is seen from behind and from above, its wheels turn, and it can be hidden', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [robot] });
  const operator = await OperatorPage.open(page, stack, { robot: robot.id });
  await operator.expectPoints(300);
  await expectDrawn(operator, false);
  await operator.screenshot(testInfo, 'own-eyes');
  for (const [key, view] of [
    ['v', 'behind'],
    ['t', 'above'],
  ] as const) {
    await page.keyboard.press(key);
    await expectDrawn(operator, true);
    for (const size of screenSizes) {
      await page.setViewportSize(size);
      await operator.expectFrames(3);
      await operator.screenshot(testInfo, `${view}-${size.width}`);
    }
  }
  await page.setViewportSize(LAPTOP);
  await page.keyboard.press('t');
  const before = (await model(operator)).positions;
  await page.evaluate(() => window.farpoint.drive({ forward: 1, left: 0 }, 600));
  await expect
    .poll(async () => (await model(operator)).positions, { message: 'angles of the wheels' })
    .not.toEqual(before);
  await operator.screenshot(testInfo, 'driven');
  await page.locator('#colours-open').click();
  const shown = page.locator('#robot-model');
  await expect(shown).toHaveText('Drawn');
  await shown.click();
  await expect.poll(() => model(operator)).toMatchObject({ shapes: 0, drawn: false });
  await operator.expectFrames(3);
  await operator.screenshot(testInfo, 'hidden');
  await shown.click();
  await expectDrawn(operator, true);
});

test('a robot without a model has its outline', async ({ page, startStack }, testInfo) => {
  const stack = await startStack({ robots: [{ ...robot, args: [...robot.args, '--urdf', 'none'] }] });
  const operator = await OperatorPage.open(page, stack, { robot: robot.id });
  await operator.expectPoints(300);
  await page.keyboard.press('v');
  await operator.expectFrames(3);
  expect(await model(operator)).toMatchObject({ links: 0, shapes: 0, drawn: false });
  await operator.screenshot(testInfo, 'without');
});

test.describe('in the headset', () => {
  test.use({ viewport: headsetViewport });

  test('it is seen over the shoulder, not from the robot’s own eyes', async ({
    page,
    startStack,
  }, testInfo) => {
    const stack = await startStack({ robots: [robot] });
    const headset = await Headset.wear(page);
    const operator = await OperatorPage.open(page, stack, { robot: robot.id });
    await operator.expectPoints(300);
    await page.getByRole('button', { name: /VR/ }).click();
    await operator.expectState('vr', true);
    await expectDrawn(operator, false);
    await headset.press('left', 'x-button');
    await expectDrawn(operator, true);
    await operator.expectFrames(5);
    await operator.screenshot(testInfo, 'headset');
  });
});
