import { Headset, headsetViewport } from '../src/headset.ts';
import { expectStanding, OperatorPage, poseOf } from '../src/operator-page.ts';
import { robotLike } from '../src/robots.ts';
import { expect, test } from '../src/smoke-test.ts';

test.use({ viewport: headsetViewport });

test('in the headset: the room is drawn, the thumbstick drives and turns, and the view goes with the robot', async ({
  page,
  shared,
  startRobot,
}, testInfo) => {
  const { id } = await startRobot(robotLike('worn'));
  const headset = await Headset.wear(page);
  const operator = await OperatorPage.open(page, shared.stack.webUrl, { robot: id });
  await operator.expectPoints();
  await page.getByRole('button', { name: /VR/ }).click();
  await operator.expectState('vr', true);
  await operator.expectPoints();
  await operator.picture(testInfo, 'both-eyes');

  const start = await poseOf(operator);
  const before = (await operator.probe()).camera;
  await operator.hold(headset.grip('right'));
  await headset.thumbstick('right', 0, -1);
  await operator.expectMovedFrom(start, 0.1);
  await headset.thumbstick('right', 0, 0);
  await operator.release();
  await expectStanding(operator);
  await operator.expectFrames(1);
  const end = await poseOf(operator);
  const after = (await operator.probe()).camera;
  expect((after?.x ?? 0) - (before?.x ?? 0)).toBeCloseTo(end.x - start.x, 1);
  expect((after?.y ?? 0) - (before?.y ?? 0)).toBeCloseTo(end.y - start.y, 1);

  // Turning left increases the yaw (REP-103).
  await operator.hold(headset.grip('right'));
  await headset.thumbstick('right', -1, 0);
  await expect
    .poll(
      async () => {
        await operator.gripAnew();
        return (await poseOf(operator)).yaw - end.yaw;
      },
      { message: 'yaw' },
    )
    .toBeGreaterThan(0.2);
  await headset.thumbstick('right', 0, 0);
  await operator.release();
  await expectStanding(operator);
});
