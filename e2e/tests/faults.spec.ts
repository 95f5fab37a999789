import { chromiumLaunchOptions } from '@farpoint/local-stack';
import { chromium } from '@playwright/test';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, test } from '../src/stack-test.ts';

/** m/s and m/s²: the simulated robot's limits. */
const MAX_SPEED = 1;
const DECELERATION = 2;
const WATCHDOG_S = 0.15;
/** The watcher's page may know the robot's state with this much delay, s. */
const OBSERVATION_S = 0.3;

test('the robot stops by itself when the browser that drives it is killed', async ({ openRobot }) => {
  const { stack, operator: watcher } = await openRobot();
  const start = await watcher.body();

  const server = await chromium.launchServer(chromiumLaunchOptions());
  try {
    const browser = await chromium.connect(server.wsEndpoint());
    const driver = await OperatorPage.open(await browser.newPage(), stack, { robot: 'sim-1' });
    await driver.expectPoints();
    await driver.holdForward();
    await watcher.expectMovedFrom(start, 0.3, driver);
    await server.kill();
    // From here on, no command can arrive.
    const atKill = await watcher.body();
    await watcher.expectStanding();
    const stopped = await watcher.body();
    const distance = Math.hypot(stopped.x - atKill.x, stopped.y - atKill.y);
    const braking = MAX_SPEED ** 2 / (2 * DECELERATION);
    expect(distance).toBeLessThan(MAX_SPEED * (WATCHDOG_S + OBSERVATION_S) + braking);
    expect(['watchdog', 'idle', 'blocked']).toContain((await watcher.state()).drive);
  } finally {
    await server.kill();
  }
});

test('the robot process is killed and restarted: the page says so and reconnects, and the robot stays stopped until released', async ({
  page,
  openRobot,
}) => {
  const { stack, operator } = await openRobot();

  await stack.robot('sim-1').kill();
  await operator.expectState('robotListed', false);
  await expect(page.getByText(/lost|offline|restarted/i).first()).toBeVisible();

  await stack.restartRobot('sim-1');
  await operator.expectState('session', 'live');
  await operator.expectPoints();
  expect((await operator.state()).sessionsOpened).toBe(2);
  // The robot did not end cleanly. It starts with its emergency stop latched, until the driver releases it on
  // purpose.
  await operator.expectState('estop', true);
  const start = await operator.body();
  await operator.holdForward();
  await operator.expectState('holder', 'you');
  await operator.expectFrames(20);
  expect(await operator.body()).toEqual(start);
  await operator.release();
  await operator.releaseEstop();
  await operator.holdForward();
  await operator.expectMovedFrom(start, 0.2);
  await operator.release();
});
