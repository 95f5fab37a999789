/** Tiles with the robot's telemetry beside the picture. */
import type { Locator, Page } from '@playwright/test';
import { expect, test } from '../src/stage/page-test.ts';
import type { Stage } from '../src/stage/stage.ts';

const LAPTOP = { width: 1280, height: 720 };
test.use({ viewport: LAPTOP });

const dashboard = (page: Page) => page.locator('#dashboard');
const tile = (page: Page, title: string) => dashboard(page).getByRole('region', { name: title, exact: true });
const titles = (page: Page) => dashboard(page).locator('.tile h3').allTextContents();

async function openDashboard(stage: Stage): Promise<void> {
  await stage.page.keyboard.press('KeyB');
  // Its code is loaded now.
  await tile(stage.page, 'Speed').waitFor();
  await stage.run(500);
}

/** The motors' temperatures go on coming, °C. */
async function measure(stage: Stage, left: number): Promise<void> {
  await stage.script((stage, left) => {
    setInterval(() => {
      const timeMs = stage.robot.nowMs;
      stage.tell({
        ...{ type: 'samples', timeMs },
        samples: [
          [0, 0, left],
          [1, 0, 32],
        ],
      });
    }, 100);
  }, left);
}

/** Curves and numbers are drawn while they can be seen, of which the browser tells in its own time. */
async function scrollTo(element: Locator): Promise<void> {
  await element.scrollIntoViewIfNeeded();
  await element.evaluate(
    (seen) => new Promise<void>((resolve) => new IntersectionObserver(() => resolve()).observe(seen)),
  );
}

test('values, curves, diagnostics and alarms of a robot, live', async ({ stage }) => {
  const loaded: string[] = [];
  stage.page.on('request', (request) => loaded.push(request.url()));
  const page = await stage.open({ state: 'alarm' });
  await stage.script(({ robot }) => {
    robot.telemetry = { battery: { percentage: 0.15, voltage: 22.1 } };
  });
  await measure(stage, 41);
  // The page starts without the dashboard's code, and shows alarms without it.
  const alarm = '⚠ The battery is low: drive to the charger (15 %, limit 20 %)';
  await expect(page.locator('#alarm')).toHaveText(alarm);
  expect(loaded.filter((url) => /dashboard/.test(url))).toEqual([]);
  await openDashboard(stage);
  await expect(dashboard(page).locator('.alarms li')).toHaveText([alarm]);
  await expect(dashboard(page).locator('.state')).toHaveText(/^In step with the picture, \d+ ms old$/);
  await expect(tile(page, 'Speed').locator('.number')).toHaveText('0.00 m/s');
  await expect(tile(page, 'Battery').locator('.number')).toHaveText('15 %');
  await expect(tile(page, 'Battery').locator('.below')).toHaveText('22.1 V');
  await expect(tile(page, 'Diagnostics').locator('.counts')).toHaveText('1 warning, 3 OK');
  await expect(tile(page, 'Diagnostics').locator('li').first()).toContainText(/^warningBattery: low/);
  // A curve is drawn while it can be seen.
  const curve = tile(page, 'Left motor, °C');
  await scrollTo(curve);
  await stage.run(500);
  await expect(curve.locator('.now')).toHaveText('41.0 °C');

  const speed = tile(page, 'Speed, m/s');
  await scrollTo(speed);
  const position = await tile(page, 'Position').locator('.number').textContent();
  await page.keyboard.down('Space');
  await stage.run(100);
  await page.keyboard.down('KeyW');
  await stage.run(1500);
  await expect(speed.locator('.now')).toHaveText('0.50 m/s');
  await page.keyboard.up('KeyW');
  await page.keyboard.up('Space');
  await stage.run(1000);
  // The window still has the drive.
  await expect(speed.locator('.figures > :nth-child(3)')).toHaveText(/^max 0\.50/);
  await scrollTo(tile(page, 'Speed'));
  await stage.run(500);
  await expect(tile(page, 'Speed').locator('.number')).toHaveText('0.00 m/s');
  await expect(tile(page, 'Position').locator('.number')).not.toHaveText(position ?? '');
  await page.keyboard.press('KeyB');
  await expect(dashboard(page)).toBeHidden();
});

test('without synchronisation, the newest values', async ({ stage }) => {
  const page = await stage.open({ state: 'alarm', stored: { 'farpoint.settings': { synchronised: false } } });
  await openDashboard(stage);
  await expect(dashboard(page).locator('.state')).toHaveText('Newest values');
  await expect(tile(page, 'Speed').locator('.number')).toHaveText('0.00 m/s');
});

test('values of a robot that is not heard are stale and say how old they are; they return with it', async ({
  stage,
}) => {
  const page = await stage.open({ state: 'alarm' });
  await measure(stage, 30);
  await openDashboard(stage);
  const speed = tile(page, 'Speed');
  const curve = tile(page, 'Left motor, °C');
  await scrollTo(curve);
  await stage.run(500);
  await expect(speed.locator('.value')).toHaveAttribute('data-stale', 'false');
  await expect(curve.locator('.chart')).toHaveAttribute('data-stale', 'false');

  await stage.script((stage) => stage.cut());
  await stage.run(8000);
  await expect(curve.locator('.now')).toHaveText(/\(\d+(\.\d)? s old\)$/);
  await scrollTo(speed);
  await stage.run(500);
  await expect(speed.locator('.value')).toHaveAttribute('data-stale', 'true');
  await expect(speed.locator('.below')).toHaveText(/^stale: [\d.]+ s old$/);
  await expect(dashboard(page).locator('.state')).toHaveText(/^No data from the robot for \d/);

  await stage.script((stage) => stage.restore());
  await stage.run(1500);
  await expect(speed.locator('.value')).toHaveAttribute('data-stale', 'false');
  await expect(dashboard(page).locator('.state')).toHaveText(/^In step/);
});

test('the layout is kept over a reload, until it is reset', async ({ stage }) => {
  const page = await stage.open({ state: 'alarm' });
  await openDashboard(stage);
  const defaults = await titles(page);
  expect(defaults).toContain('Right motor, °C');
  await page.getByRole('button', { name: 'Arrange' }).click();
  await page.getByRole('button', { name: 'Hide: Heading' }).click();
  await page.getByRole('button', { name: 'Move later: Speed', exact: true }).click();
  await page.getByRole('button', { name: 'Change the size: Speed', exact: true }).click();
  await page.getByRole('button', { name: '+ Turning, °/s' }).click();
  await page.getByLabel('How far back curves reach').selectOption('10 min');
  await stage.run(500);
  const arranged = await titles(page);
  expect(arranged.slice(0, 2)).toEqual(['Battery', 'Speed']);
  expect(arranged).not.toContain('Heading');
  expect(arranged).toContain('Turning, °/s');

  await stage.reload();
  await openDashboard(stage);
  expect(await titles(page)).toEqual(arranged);
  await expect(tile(page, 'Speed')).toHaveAttribute('data-size', 'medium');
  await expect(page.getByLabel('How far back curves reach')).toHaveValue('10 min');

  await page.getByRole('button', { name: 'Arrange' }).click();
  await page.getByRole('button', { name: 'Reset' }).click();
  expect(await titles(page)).toEqual(defaults);
});

test('a map with tiles, where they are configured and the robot knows its place on the earth', async ({
  stage,
}) => {
  const { page } = stage;
  const asked: string[] = [];
  await page.route('**/tiles/**', (route) => {
    asked.push(new URL(route.request().url()).pathname);
    const svg = '<svg xmlns="http://www.w3.org/2000/svg" width="256" height="256"/>';
    return route.fulfill({ contentType: 'image/svg+xml', body: svg });
  });
  const satellite = tile(page, 'Map').getByTitle('Where the position comes from');
  const receive = async () => {
    await stage.script((stage) => {
      for (const [number, field] of ['latitude', 'longitude'].entries())
        stage.tell({
          ...{ type: 'quantity', number: 10 + number, topic: '/fix', field },
          ...{ label: field, unit: '°' },
        });
      setInterval(() => {
        const timeMs = stage.robot.nowMs;
        stage.tell({
          ...{ type: 'samples', timeMs },
          samples: [
            [10, 0, 48.1374],
            [11, 0, 11.5756],
          ],
        });
      }, 100);
    });
    await stage.run(400);
    await openDashboard(stage);
    await satellite.click();
    await stage.run(500);
  };
  await stage.open();
  await receive();
  await expect(satellite).toHaveText('Satellite');
  await expect(tile(page, 'Position').locator('.number')).toHaveText('48.137400°, 11.575600°');
  await expect(tile(page, 'Map').locator('.attribution')).toBeHidden();
  expect(asked).toEqual([]);

  await page.locator('#settings-open').click();
  await page.getByLabel(/^Map tiles/).fill('/tiles/{z}/{x}/{y}.svg');
  await page.getByLabel('Attribution of the map').fill('© Mapmakers');
  await page.getByRole('button', { name: 'Save' }).click();
  await stage.run(500);
  await expect(tile(page, 'Map').locator('.attribution')).toHaveText('© Mapmakers');
  expect(asked.length).toBeGreaterThan(0);
  for (const path of asked) expect(path).toMatch(/^\/tiles\/19\/2790\d\d\/1819\d\d\.svg$/);
});

test('what a robot plays from a recording is marked as recorded', async ({ stage }) => {
  const page = await stage.open({ state: 'playback' });
  await measure(stage, 25.3);
  await expect(page.locator('#alarm')).toHaveText(
    '⚠ Recorded: The battery is low: drive to the charger (15 %, limit 20 %)',
  );
  await openDashboard(stage);
  await expect(dashboard(page).locator('.state')).toHaveText(/^In step with the picture, \d+ ms old$/);
  await expect(tile(page, 'Diagnostics').locator('.counts')).toHaveText('1 warning, 3 OK (recorded)');
  const curve = tile(page, 'Left motor (recorded), °C');
  await scrollTo(curve);
  await stage.run(500);
  await expect(curve.locator('.now')).toHaveText('25.3 °C');
});
