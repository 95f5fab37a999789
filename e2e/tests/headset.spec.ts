import { enterVr, Headset, headsetViewport } from '../src/headset.ts';
import { OperatorPage } from '../src/operator-page.ts';
import { differingShare, leftEye, readPicture, rightEye } from '../src/picture.ts';
import { expect, lightRobot, test, twoRobots } from '../src/stack-test.ts';

test.use({ viewport: headsetViewport });

test('in the headset: both eyes show the room, the thumbstick drives, the world stands still', async ({
  page,
  startStack,
}, testInfo) => {
  // Light: a picture that is drawn slowly lets the grip go, and the robot would start and stop instead of driving.
  // λ = 0 samples near and far points alike, so that the far wall can be used for measurements.
  const stack = await startStack({
    robots: [
      {
        ...lightRobot,
        args: [...lightRobot.args, '--max-points', '1500', '--lambda', '0'],
      },
    ],
  });
  const headset = await Headset.wear(page);
  const operator = await OperatorPage.open(page, stack, { robot: 'sim-1' });
  await operator.expectPoints(1200);

  await enterVr(page, operator);
  await operator.expectPoints(1200);
  const before = await operator.screenshot(testInfo, 'both-eyes');
  const [left, right] = await readPicture(page, before, [leftEye, rightEye]);
  for (const eye of [left, right]) {
    expect(eye?.drawnShare).toBeGreaterThan(0.2);
    expect(eye?.colours).toBeGreaterThan(15);
  }
  // Two eyes, not the same picture twice.
  expect(await differingShare(page, before, leftEye, rightEye)).toBeGreaterThan(0.02);

  const start = await operator.body();
  const drawnBefore = await operator.probe();
  await operator.hold(headset.grip('right'));
  await headset.thumbstick('right', 0, -1);
  await operator.expectMovedFrom(start, 1);
  await headset.thumbstick('right', 0, 0);
  await operator.expectStanding();
  await operator.release();
  await operator.expectPoints(1200);
  await operator.look(testInfo, 'both-eyes-after-driving');

  // The camera moved with the wheels; what it sees of the world stayed in place.
  const end = await operator.body();
  const drawnAfter = await operator.probe();
  const moved = { x: end.x - start.x, y: end.y - start.y };
  expect((drawnAfter.camera?.x ?? 0) - (drawnBefore.camera?.x ?? 0)).toBeCloseTo(moved.x, 1);
  expect((drawnAfter.camera?.y ?? 0) - (drawnBefore.camera?.y ?? 0)).toBeCloseTo(moved.y, 1);
  const floorBefore = drawnBefore.bounds?.min[2] ?? Number.NaN;
  const floorAfter = drawnAfter.bounds?.min[2] ?? Number.NaN;
  expect(Math.abs(floorAfter - floorBefore)).toBeLessThan(0.3);

  // Turning left increases the yaw (REP-103).
  await operator.hold(headset.grip('right'));
  await headset.thumbstick('right', -1, 0);
  await expect
    .poll(
      async () => {
        await operator.gripAnew();
        return (await operator.body()).yaw - end.yaw;
      },
      { message: 'yaw' },
    )
    .toBeGreaterThan(0.3);
  await operator.release();
  await operator.expectStanding();
});

test('in the headset: pressing the stick switches to the next robot, without leaving VR', async ({
  page,
  startStack,
}) => {
  const stack = await startStack({ robots: twoRobots });
  const headset = await Headset.wear(page);
  const operator = await OperatorPage.open(page, stack, { robot: 'sim-1' });
  await operator.expectPoints();
  await enterVr(page, operator);
  await headset.button('right', 'thumbstick', 1);
  await operator.expectState('robotId', 'sim-2');
  await headset.button('right', 'thumbstick', 0);
  await operator.expectPoints();
  expect((await operator.state()).vr).toBe(true);
});
