/** The event log: what has happened, as a list that is filtered and saved. */
import { readFileSync } from 'node:fs';
import type { Locator, Page } from '@playwright/test';
import { expect, test } from '../src/stage/page-test.ts';

const LAPTOP = { width: 1280, height: 720 };
test.use({ viewport: LAPTOP });

const log = (page: Page) => page.locator('#events');
const rows = (page: Page) => log(page).locator('tbody tr td:last-child');

test('the log lists what has happened, is filtered and saved, and leaves STOP in reach', async ({
  stage,
}) => {
  const loaded: string[] = [];
  stage.page.on('request', (request) => loaded.push(request.url()));
  const page = await stage.open({ state: 'stop-by-other', forMs: 1000 });
  expect(loaded.filter((url) => /events-dialog/.test(url))).toEqual([]);
  await page.keyboard.press('KeyJ');
  await log(page).waitFor();
  await stage.run(200);
  await expect(rows(page).first()).toHaveText('Emergency stop by Bo.');
  await expect(rows(page).last()).toHaveText('The page was opened.');
  await expect(log(page).locator('[data-severity="error"]')).toHaveText(['error']);
  await expect(rows(page).filter({ hasText: 'Bo drives.' })).toHaveCount(1);

  // It follows what happens.
  await stage.script(({ robot }) => robot.stop({ latched: false, latch: 1 }));
  await stage.run(200);
  await expect(rows(page).first()).toHaveText(/^The emergency stop was released by /);

  await log(page).getByLabel('Show').selectOption('driving');
  await expect(rows(page)).toHaveText(['Bo drives.']);
  await log(page).getByLabel('Show').selectOption('all events');
  const field = log(page).getByRole('searchbox');
  await field.focus();
  // Letters that are typed neither drive nor stop.
  await page.keyboard.type('x');
  await stage.run(200);
  expect(await stage.sent('estop')).toEqual([]);
  await field.fill('rover that is not there');
  await expect(rows(page)).toHaveCount(0);
  await field.fill('');

  const saving = page.waitForEvent('download');
  await log(page).getByRole('button', { name: 'CSV' }).click();
  const download = await saving;
  expect(download.suggestedFilename()).toMatch(/^farpoint-events-.*\.csv$/);
  const csv = readFileSync(await download.path(), 'utf8');
  expect(csv).toMatch(/^time,lastTime,times,sessionS,robot,severity,kind,details,text\r\n/);
  expect(csv).toContain(',error,stop,');
  await page.locator('#estop').click({ trial: true });
  await page.keyboard.press('Escape');
  await expect(log(page)).toBeHidden();
});

test('the log stays in place while it is read, and says that there is more', async ({ stage }) => {
  const page = await stage.open({ state: 'live', forMs: 500 });
  await stage.script(({ app }) => {
    for (let i = 0; i < 60; i++)
      app.events.add({ kind: 'robot-chosen', robotId: `rover-${i}` }, { robot: null, sessionMs: null });
  });
  await page.locator('#events-open').click();
  await log(page).waitFor();
  await stage.run(200);
  await expect(rows(page).first()).toHaveText('Robot chosen: rover-59.');
  await log(page)
    .locator('.scrolled')
    .evaluate((list) => list.scrollTo(0, 400));
  await stage.script(({ robot }) => robot.giveLease('other', 'Bo'));
  await stage.run(200);
  await expect(rows(page).first()).toHaveText('Robot chosen: rover-59.');
  await page.getByRole('button', { name: '1 newer: show' }).click();
  await expect(rows(page).first()).toHaveText('Bo drives.');
});

test('a session has a report: at its end in the list of robots, and in the log while it lasts', async ({
  stage,
}) => {
  const page = await stage.open({ state: 'driving', forMs: 12_000 });
  await page.keyboard.press('KeyJ');
  await log(page).waitFor();
  await stage.run(200);
  const saved = async (button: Locator) => {
    const saving = page.waitForEvent('download');
    await button.click();
    const download = await saving;
    return { name: download.suggestedFilename(), text: readFileSync(await download.path(), 'utf8') };
  };
  const json = await saved(log(page).getByRole('button', { name: 'Report as JSON' }));
  expect(json.name).toMatch(/^farpoint-session-.*\.json$/);
  const report = JSON.parse(json.text) as Record<string, Record<string, unknown>>;
  expect(report).toMatchObject({
    format: 'farpoint-session-report',
    end: null,
    robot: { name: 'Robot on a stage' },
    driving: { distanceM: 0 },
  });
  expect(report.driving?.leaseS).toBeGreaterThan(1);
  expect(report.view?.framesPerSecond).not.toBeNull();
  expect(report.latency?.frameMs).not.toBeNull();
  await page.keyboard.press('Escape');

  await stage.script(({ app }) => app.client.leave());
  await stage.run(500);
  await expect(page.locator('#last-session')).toContainText(/^Last session: Robot on a stage, 0:1\d\./);
  const html = await saved(page.locator('#last-session button'));
  expect(html.name).toMatch(/^farpoint-session-.*\.html$/);
  const reader = await page.context().newPage();
  await reader.setContent(html.text);
  await expect(reader.getByRole('heading', { level: 1 })).toHaveText('Session report: Robot on a stage');
  await expect(reader.getByRole('row', { name: 'Reason of the end' })).toContainText(
    'the operator disconnected',
  );
  await reader.close();
});
