import { BridgeProcess } from '@farpoint/local-stack';
import { OperatorPage } from '../src/operator-page.ts';
import { readPicture } from '../src/picture.ts';
import { expect, simulatedRobot, test, twoRobots } from '../src/stack-test.ts';

/** Robots that also offer the reference profile, and the bridge between them and the page. */
const inReferenceProfile = <T extends object>(robot: T) => ({ ...robot, reference: true });

test('through the bridge: see the robot’s world, drive it, stop it and measure, beside a Farpoint operator', async ({
  page,
  context,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [inReferenceProfile(simulatedRobot)] });
  const bridge = await BridgeProcess.start(stack);
  try {
    const operator = await OperatorPage.open(page, stack, { bridge: bridge.address, canvas: 'full' });
    await page.getByRole('button', { name: /Simulated robot 1/ }).click();
    await operator.expectPoints(5000);
    const picture = await operator.picture(testInfo, 'through-the-bridge');
    const [room] = await readPicture(page, picture, [{ left: 0, top: 0, width: 1, height: 1 }]);
    expect(room?.drawnShare).toBeGreaterThan(0.15);
    expect(room?.colours).toBeGreaterThan(20);

    // Directly and through the bridge at the same time. The direct one shows where the robot is.
    const watcher = await OperatorPage.open(await context.newPage(), stack, {
      robot: simulatedRobot.id,
      canvas: '64x36',
    });
    await watcher.expectPoints();
    const start = await watcher.body();
    await page.bringToFront();
    await operator.holdForward();
    await operator.expectState('holder', 'you');
    await expect
      .poll(async () => {
        await operator.gripAnew(watcher);
        return (await watcher.state()).holder;
      })
      .toBe('other');
    await watcher.expectMovedFrom(start, 0.3, operator);
    await operator.release();
    await watcher.expectStanding();

    // The page's own stop: held keys do not move the robot until the stop is released and the grip was let go.
    await page.keyboard.press('KeyX');
    await operator.expectState('estop', true);
    const stopped = await watcher.body();
    await operator.holdForward();
    await operator.expectFrames(20);
    expect(await watcher.body()).toEqual(stopped);
    await operator.release();
    await operator.releaseEstop();
    await operator.holdForward();
    await watcher.expectMovedFrom(stopped, 0.2, operator);
    await operator.release();
    await watcher.expectStanding();

    const result = await page.evaluate(() => window.farpoint.latencyTest());
    expect(result.points).toBe(result.totalPoints);
    expect(result.mtpMs).toBeGreaterThan(0);
  } finally {
    await bridge.stop();
  }
});

test('through the bridge: switch from one robot to another, and recover after the bridge was away', async ({
  page,
  startStack,
}) => {
  const stack = await startStack({ robots: twoRobots.map(inReferenceProfile) });
  let bridge = await BridgeProcess.start(stack);
  try {
    const operator = await OperatorPage.open(page, stack, { bridge: bridge.address });
    await page.getByRole('button', { name: /Simulated robot 2/ }).click();
    await operator.expectPoints();
    const listed = await page.evaluate(() => window.farpoint.robots());
    expect(listed.map(({ name }) => name).sort()).toEqual(['Simulated robot 1', 'Simulated robot 2']);
    const first = listed.find(({ name }) => name === 'Simulated robot 1');
    await page.evaluate((id) => window.farpoint.connect(id), first?.id ?? '');
    await operator.expectPoints();

    const { ports } = bridge;
    await bridge.process.kill();
    await expect.poll(async () => (await operator.state()).session).toBe('waiting');
    bridge = await BridgeProcess.start(stack, { ports });
    await operator.expectPoints();
  } finally {
    await bridge.stop();
  }
});
