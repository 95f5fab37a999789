/** The headset is taken off with the grip held: nobody looks, so the robot stops, and others may drive. */
import { enterVr, Headset, headsetViewport } from '../src/headset.ts';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';

test.use({ viewport: headsetViewport });

test('taken off with the grip held: the robot stops, is free for others, and waits for a fresh grip', async ({
  page,
  startStack,
}) => {
  const stack = await startStack({ robots: [lightRobot] });
  const headset = await Headset.wear(page);
  const operator = await OperatorPage.open(page, stack, { robot: 'sim-1' });
  await operator.expectPoints(300);
  await enterVr(page, operator);
  await operator.expectPoints(300);
  await headset.thumbstick('right', 0, -1);
  await operator.hold(headset.grip('right'));
  const from = await operator.body();
  await operator.expectMovedFrom(from, 0.1);

  await headset.worn(false);
  await operator.expectStanding();
  await operator.expectState('driving', false);
  // The robot lets go of a driver that it no longer hears from.
  await operator.expectState('holder', 'nobody');
  const stood = await operator.body();

  await headset.worn(true);
  await operator.expectFrames(10);
  const { driving } = await operator.state();
  expect(driving).toBe(false);
  const later = await operator.body();
  expect(Math.hypot(later.x - stood.x, later.y - stood.y)).toBeLessThan(0.01);

  await operator.release();
  await operator.hold(headset.grip('right'));
  await operator.expectMovedFrom(later, 0.05);
  await operator.release();
  await operator.expectStanding();
});
