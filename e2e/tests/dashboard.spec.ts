import { writeFileSync } from 'node:fs';
import type { Page } from '@playwright/test';
import { expectOnScreenAndApart } from '../src/layout.ts';
import { OperatorPage } from '../src/operator-page.ts';
import { screenSizes } from '../src/screens.ts';
import { expect, simulatedRobot, test } from '../src/stack-test.ts';

const ROBOT = {
  ...simulatedRobot,
  args: [...simulatedRobot.args.slice(0, -1), '4000', '--fps', '15', '--sim-charge', '15'],
};
const ALARMS = [
  { of: 'charge', low: { warn: 20, error: 10 }, hysteresis: 2, text: 'The battery is low' },
  { of: 'speed', high: { warn: 0.3 }, hysteresis: 0.05, text: 'The robot is fast' },
  { of: '/motors', field: 'left', high: { warn: 80 } },
];

const dashboard = (page: Page) => page.locator('#dashboard');
const tile = (page: Page, title: string) => dashboard(page).getByRole('region', { name: title, exact: true });
const titles = (page: Page) => dashboard(page).locator('.tile h3').allTextContents();

async function openDashboard(page: Page): Promise<void> {
  await page.keyboard.press('KeyB');
  await expect(tile(page, 'Speed')).toBeVisible();
}

test('values, curves, diagnostics and alarms of a robot, live', async ({ page, startStack }, testInfo) => {
  const config = testInfo.outputPath('farpoint.yaml');
  // JSON is valid YAML.
  writeFileSync(config, JSON.stringify({ robot: { alarms: ALARMS } }));
  await page.setViewportSize({ width: 1280, height: 720 });
  const loaded: string[] = [];
  page.on('request', (request) => loaded.push(request.url()));
  const stack = await startStack({ robots: [{ ...ROBOT, args: [...ROBOT.args, '--config', config] }] });
  const operator = await OperatorPage.open(page, stack, { robot: ROBOT.id });
  await operator.expectPoints();
  // The page starts without the dashboard's code, and shows alarms without it.
  expect(loaded.filter((url) => /dashboard/.test(url))).toEqual([]);
  await expect(page.locator('#alarm')).toHaveText('⚠ The battery is low (15 %, limit 20 %)');
  await openDashboard(page);
  await expect(dashboard(page).locator('.alarms li')).toHaveText(['⚠ The battery is low (15 %, limit 20 %)']);
  await expect(dashboard(page).locator('.state')).toHaveText(/^In step with the picture, \d+ ms old$/);
  await expect(tile(page, 'Speed').locator('.number')).toHaveText('0.00 m/s');
  await expect(tile(page, 'Battery').locator('.number')).toHaveText('15 %');
  await expect(tile(page, 'Battery').locator('.below')).toHaveText('22.1 V');
  await expect(tile(page, 'Diagnostics').locator('.counts')).toHaveText('1 warning, 3 OK');
  await expect(tile(page, 'Diagnostics').locator('li').first()).toContainText(
    /^warningBattery: 15 %, 22.1 V/,
  );
  // A curve is drawn while it can be seen.
  await tile(page, 'Left motor, °C').scrollIntoViewIfNeeded();
  await expect(tile(page, 'Left motor, °C').locator('.now')).toContainText(/^2[2-9]\.\d °C$/);

  await tile(page, 'Speed, m/s').scrollIntoViewIfNeeded();
  const position = await tile(page, 'Position').locator('.number').textContent();
  await operator.holdForward();
  await expect
    .poll(async () => {
      await operator.gripAnew();
      return dashboard(page).locator('.alarms li').count();
    })
    .toBe(2);
  await expect(dashboard(page).locator('.alarms li').first()).toContainText('The robot is fast (0.3');
  await expect(tile(page, 'Speed, m/s').locator('.now')).toHaveText(/^(0\.[3-9]\d|1\.00) m\/s$/);
  await operator.screenshot(testInfo, 'driving');
  await operator.release();
  await expect(dashboard(page).locator('.alarms li')).toHaveCount(1);
  // The window still has the drive.
  await expect(tile(page, 'Speed, m/s').locator('.figures > :nth-child(3)')).toHaveText(
    /^max (0\.[3-9]|1\.00)/,
  );
  await tile(page, 'Speed').scrollIntoViewIfNeeded();
  await expect(tile(page, 'Speed').locator('.number')).toHaveText('0.00 m/s');
  await expect(tile(page, 'Position').locator('.number')).not.toHaveText(position ?? '');
  await operator.screenshot(testInfo, 'stopped');

  await page.keyboard.press('KeyB');
  await expect(dashboard(page)).toBeHidden();
});

test('without synchronisation, the newest values', async ({ page, startStack }) => {
  const stack = await startStack({ robots: [ROBOT] });
  await OperatorPage.open(page, stack, { robot: ROBOT.id, sync: '0' });
  await expect(page.locator('#dashboard-open')).toBeVisible();
  await page.locator('#dashboard-open').click();
  await expect(dashboard(page).locator('.state')).toHaveText('Newest values');
  await expect(tile(page, 'Speed').locator('.number')).toHaveText('0.00 m/s');
});

test('values of a robot that is gone are stale and say how old they are; they return with it', async ({
  page,
  startStack,
}, testInfo) => {
  await page.setViewportSize({ width: 1280, height: 720 });
  const stack = await startStack({ robots: [ROBOT] });
  const operator = await OperatorPage.open(page, stack, { robot: ROBOT.id });
  await operator.expectPoints();
  await openDashboard(page);
  const speed = tile(page, 'Speed');
  const curve = tile(page, 'Left motor, °C');
  await curve.scrollIntoViewIfNeeded();
  await expect(speed.locator('.value')).toHaveAttribute('data-stale', 'false');
  await expect(curve.locator('.chart')).toHaveAttribute('data-stale', 'false');

  await stack.robot(ROBOT.id).kill();
  await expect(curve.locator('.now')).toHaveText(/\(\d+(\.\d)? s old\)$/);
  await operator.screenshot(testInfo, 'stale-curve');
  await speed.scrollIntoViewIfNeeded();
  await expect(speed.locator('.value')).toHaveAttribute('data-stale', 'true');
  await expect(speed.locator('.below')).toHaveText(/^stale: [\d.]+ m?s old$/);
  await expect(dashboard(page).locator('.state')).toHaveText(/^No data from the robot for \d/);
  await operator.screenshot(testInfo, 'stale');

  await stack.restartRobot(ROBOT.id);
  await operator.expectState('session', 'live');
  await expect(speed.locator('.value')).toHaveAttribute('data-stale', 'false');
  await expect(dashboard(page).locator('.state')).toHaveText(/^In step/);
});

test('the layout is kept over a reload, and what cannot be read is the default', async ({
  page,
  startStack,
}, testInfo) => {
  await page.setViewportSize({ width: 1280, height: 720 });
  const stack = await startStack({ robots: [ROBOT] });
  const operator = await OperatorPage.open(page, stack, { robot: ROBOT.id });
  await operator.expectPoints();
  await openDashboard(page);
  await expect(tile(page, 'Right motor, °C')).toBeVisible();
  const defaults = await titles(page);
  await page.getByRole('button', { name: 'Arrange' }).click();
  await page.getByRole('button', { name: 'Hide: Heading' }).click();
  await page.getByRole('button', { name: 'Move later: Speed', exact: true }).click();
  await page.getByRole('button', { name: 'Change the size: Speed', exact: true }).click();
  await page.getByRole('button', { name: '+ Turning, °/s' }).click();
  await page.getByLabel('How far back curves reach').selectOption('10 min');
  await operator.screenshot(testInfo, 'arranging');
  const arranged = await titles(page);
  expect(arranged.slice(0, 2)).toEqual(['Battery', 'Speed']);
  expect(arranged).not.toContain('Heading');

  const reopen = async () => {
    await page.reload();
    await page.waitForFunction(() => window.farpoint !== undefined);
    await operator.expectPoints();
    await openDashboard(page);
    await expect(tile(page, 'Right motor, °C')).toBeVisible();
  };
  await reopen();
  expect(await titles(page)).toEqual(arranged);
  await expect(tile(page, 'Speed')).toHaveAttribute('data-size', 'medium');
  await expect(page.getByLabel('How far back curves reach')).toHaveValue('10 min');

  await page.evaluate(() => localStorage.setItem('farpoint.dashboard', '{"version":1,"tiles":[{"id":7}]}'));
  await reopen();
  expect(await titles(page)).toEqual(defaults);

  await page.getByRole('button', { name: 'Arrange' }).click();
  await page.getByRole('button', { name: 'Hide: Map' }).click();
  await expect(tile(page, 'Map')).toHaveCount(0);
  await page.getByRole('button', { name: 'Reset' }).click();
  await expect(tile(page, 'Map')).toBeVisible();
  expect(await titles(page)).toEqual(defaults);
});

test('a map with tiles, where they are configured and the robot knows its place on the earth', async ({
  page,
  startStack,
}, testInfo) => {
  await page.setViewportSize({ width: 1280, height: 720 });
  const asked: string[] = [];
  await page.route('**/tiles/**', (route) => {
    asked.push(new URL(route.request().url()).pathname);
    const svg =
      '<svg xmlns="http://www.w3.org/2000/svg" width="256" height="256"><rect width="256" height="256" fill="#24506e" stroke="#fff"/></svg>';
    return route.fulfill({ contentType: 'image/svg+xml', body: svg });
  });
  const robot = { ...ROBOT, args: [...ROBOT.args, '--sim-origin', '48.1374,11.5755'] };
  const stack = await startStack({ robots: [robot] });
  const operator = await OperatorPage.open(page, stack, { robot: robot.id });
  await openDashboard(page);
  const satellite = tile(page, 'Map').getByRole('button', { name: 'Where the position comes from' });
  await satellite.click();
  await expect(satellite).toHaveText('Satellite');
  await expect(tile(page, 'Position').locator('.number')).toHaveText(/^48\.1374\d\d°, 11\.5756\d\d°$/);
  await expect(tile(page, 'Map').locator('.attribution')).toBeHidden();
  expect(asked).toEqual([]);

  await page.keyboard.press('KeyB');
  await page.getByRole('button', { name: 'Settings' }).click();
  await page.getByLabel(/Map tiles/).fill('/tiles/{z}/{x}/{y}.svg');
  await page.getByLabel('Attribution of the map').fill('© Mapmakers');
  // Until then, keys would go to the page as it was.
  const loaded = page.waitForEvent('load');
  await page.getByRole('button', { name: 'Save and reconnect' }).click();
  await loaded;
  await page.waitForFunction(() => window.farpoint !== undefined);
  await operator.expectState('session', 'live');
  await openDashboard(page);
  await satellite.click();
  await expect(tile(page, 'Map').locator('.attribution')).toHaveText('© Mapmakers');
  await expect.poll(() => asked.length).toBeGreaterThan(0);
  expect(
    asked.every((path) => /^\/tiles\/19\/2790\d\d\/1819\d\d\.svg$/.test(path)),
    asked[0],
  ).toBe(true);
  await operator.screenshot(testInfo, 'tiles');
});

for (const { width, height } of screenSizes) {
  test(`leaves room for driving on a screen ${width} pixels wide`, async ({ page, startStack }, testInfo) => {
    const screen = { width, height };
    await page.setViewportSize(screen);
    const stack = await startStack({ robots: [ROBOT] });
    const operator = await OperatorPage.open(page, stack, { robot: ROBOT.id });
    await operator.expectPoints();
    await expect(page.locator('#alarm')).toBeVisible();
    await operator.screenshot(testInfo, `closed-${width}`);
    await page.locator('#dashboard-open').click();
    await expect(tile(page, 'Speed').locator('.number')).toHaveText('0.00 m/s');
    await operator.expectFrames(5);
    await operator.screenshot(testInfo, `open-${width}`);
    const names = await expectOnScreenAndApart(
      page.locator('#dashboard, #bar button:visible, #drive button:visible, #joystick:visible'),
      screen,
    );
    expect(names.length).toBeGreaterThan(4);
    // Nothing is wider than the dashboard.
    expect(await dashboard(page).evaluate((each) => each.scrollWidth - each.clientWidth)).toBe(0);
    await dashboard(page).evaluate((each) => each.scrollTo(0, each.scrollHeight));
    await expect(dashboard(page).locator('.tile').last()).toBeInViewport();
    await operator.screenshot(testInfo, `scrolled-${width}`);
    await page.getByRole('button', { name: 'STOP' }).click();
    await operator.expectState('estop', true);
  });
}
