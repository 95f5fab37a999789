/** Signals that end a process at once. How far a robot goes on is asked in virtual time: tools/scenario. */
import { chromiumLaunchOptions } from '@farpoint/local-stack';
import { chromium } from '@playwright/test';
import { expectStanding, OperatorPage, poseOf } from '../src/operator-page.ts';
import { robotLike } from '../src/robots.ts';
import { expect, test } from '../src/smoke-test.ts';
import { WatchingOperator } from '../src/watching-operator.ts';

test('a browser that is killed while it drives: the robot stops by itself', async ({
  shared,
  startRobot,
}) => {
  const { id } = await startRobot(robotLike('bereft'));
  const watcher = await WatchingOperator.open(shared.stack, id);
  const start = await poseOf(watcher);
  const server = await chromium.launchServer(chromiumLaunchOptions());
  try {
    const browser = await chromium.connect(server.wsEndpoint());
    const driver = await OperatorPage.open(await browser.newPage(), shared.stack.webUrl, { robot: id });
    await driver.expectPoints();
    await driver.hold(driver.script);
    await driver.expectMovedFrom(start, 0.1, watcher);
    await server.kill();
    await expectStanding(watcher);
    expect(['watchdog', 'idle', 'blocked']).toContain(watcher.drive);
  } finally {
    await server.kill();
    await watcher.close();
  }
});

test('a robot that is killed: the page says so, comes back with it, and the stop stays latched until it is released', async ({
  page,
  shared,
  startRobot,
}) => {
  const { stack } = shared;
  const robot = await startRobot(robotLike('killed'));
  const operator = await OperatorPage.open(page, stack.webUrl, { robot: robot.id });
  await operator.expectPoints();
  await operator.drives(0.1);

  await stack.robot(robot.id).kill();
  await operator.expectState('robotListed', false);
  await expect(page.getByText(/lost|offline|restarted/i).first()).toBeVisible();
  await stack.restartRobot(robot.id);
  await operator.expectPoints();
  expect((await operator.state()).sessionsOpened).toBe(2);
  // The robot did not end cleanly.
  await operator.expectState('estop', true);
  await operator.cannotDrive();
  await operator.expectState('holder', 'you');
  await operator.releaseEstop();
  await operator.drives(0.1);
});
