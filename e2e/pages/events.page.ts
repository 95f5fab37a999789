/** The event log: what has happened, as a list that is filtered and saved. */
import { readFileSync } from 'node:fs';
import type { Page } from '@playwright/test';
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
  expect(csv).toMatch(/^time,last_time,times,session_s,robot,severity,kind,details,text\r\n/);
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
