/** The robot's world in the operator's own room. */
import { Headset, headsetViewport } from '../src/headset.ts';
import { OperatorPage } from '../src/operator-page.ts';
import { readPicture } from '../src/picture.ts';
import { expect, simulatedRobot, test } from '../src/stack-test.ts';

test.use({ viewport: headsetViewport });

const robot = { ...simulatedRobot, args: [...simulatedRobot.args, '--max-points', '6000', '--fps', '15'] };

test('in AR the model stands in the operator’s room, or the world around them at true scale; it drives as in VR', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [robot] });
  const headset = await Headset.wear(page);
  const operator = await OperatorPage.open(page, stack, { robot: robot.id });
  await operator.expectPoints();
  await page.getByRole('button', { name: 'Enter AR' }).click();
  await operator.expectState('vr', true);
  const shown = () => page.evaluate(() => window.farpoint.headset());
  expect(await shown()).toMatchObject({ view: 'tabletop', passthrough: true });
  await headset.frames(5);
  // Where nothing is drawn, the headset shows the room: the emulated one shows black.
  expect(await page.evaluate(() => window.farpoint.pixel(0.01, 0.01))).toEqual([0, 0, 0]);
  const table = await operator.screenshot(testInfo, 'ar-tabletop');
  const [model] = await readPicture(page, table, [{ left: 0, top: 0.3, width: 0.5, height: 0.7 }]);
  expect(model?.colours).toBeGreaterThan(10);
  const from = await operator.body();
  await operator.hold(headset.grip('right'));
  await headset.thumbstick('right', 0, -1);
  await operator.expectMovedFrom(from, 0.2);
  await operator.release();
  await operator.expectStanding();

  await headset.press('left', 'x-button');
  expect(await shown()).toMatchObject({ view: 'first-person' });
  await headset.frames(3);
  await operator.look(testInfo, 'ar-true-scale');

  // Back in VR, the view is the one from before.
  // The emulated headset's picture lies over the page.
  await page.getByRole('button', { name: 'Leave AR' }).dispatchEvent('click');
  await operator.expectState('vr', false);
  await page.getByRole('button', { name: 'Enter VR' }).click();
  await operator.expectState('vr', true);
  expect(await shown()).toMatchObject({ view: 'first-person', passthrough: false });
  await headset.frames(3);
  expect(await page.evaluate(() => window.farpoint.pixel(0.01, 0.01))).not.toEqual([0, 0, 0]);
});
