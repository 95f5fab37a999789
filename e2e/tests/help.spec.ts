/** Help in place: the list of keys as they are chosen, the first drive, and the log of what happened. */
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { repositoryRoot } from '@farpoint/local-stack';
import type { Locator, Page } from '@playwright/test';
import { expectAccessible } from '../src/accessibility.ts';
import { expectOnScreenAndApart } from '../src/layout.ts';
import { OperatorPage, screenSizes } from '../src/operator-page.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';

const options = { robot: lightRobot.id, canvas: '64x36' };
const sizes = [...screenSizes, { width: 667, height: 320 }];

/** The text of what is saved by this button. */
async function saved(page: Page, button: Locator): Promise<string> {
  const download = page.waitForEvent('download');
  await button.click();
  return readFileSync(await (await download).path(), 'utf8');
}

test('the help names the keys that are chosen, STOP works over it; the event log has what happened', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [lightRobot] });
  const operator = await OperatorPage.open(page, stack, options);
  await operator.expectPoints(100);
  const { keyboard } = page;
  const help = page.getByRole('dialog', { name: 'Help' });
  const rowOf = (what: string) => help.locator('dl > div', { has: page.getByText(what, { exact: true }) });

  // By keyboard alone, and the focus comes back.
  await page.locator('#help-open').focus();
  await keyboard.press('?');
  await expect(rowOf('Forward')).toContainText('W↑Gamepad: left stick ↕, right stick ↕');
  await expect(rowOf('STOP')).toContainText('XGamepad: B');
  for (const size of sizes) {
    await page.setViewportSize(size);
    await operator.look(testInfo, `help-${size.width}`);
    await expectOnScreenAndApart(page.locator('#help, #estop'), size);
  }
  await help.getByRole('button', { name: 'Change keys' }).press('Enter');
  await page.getByRole('button', { name: 'Forward: add a key' }).press('Enter');
  await keyboard.press('KeyI');
  await expect(page.locator('#inputs-said')).toHaveText('Saved.');
  await keyboard.press('Escape');
  await expect(rowOf('Forward')).toContainText('W↑I');
  await keyboard.press('KeyX');
  await operator.expectState('estop', true);
  await keyboard.press('?');
  await expect(help).toBeHidden();
  await expect(page.locator('#help-open')).toBeFocused();
  await operator.releaseEstop();

  // It does not come between a hand and the robot.
  const from = await operator.body();
  await operator.holdForward();
  await operator.expectMovedFrom(from, 0.1);
  await keyboard.press('Slash');
  await expect(page.locator('#notice')).toHaveText('Let go of the controls first, then open the help.');
  await expect(help).toBeHidden();
  await operator.release();

  const picture = page.waitForEvent('download');
  await keyboard.press('KeyO');
  const png = readFileSync(await (await picture).path());
  // Its size is in its header.
  expect([png.toString('latin1', 1, 4), png.readUInt32BE(16), png.readUInt32BE(20)]).toEqual(['PNG', 64, 36]);
  await page.locator('#settings-open').press('Enter');
  await page.getByRole('button', { name: 'Event log…' }).press('Enter');
  const log = page.getByRole('dialog', { name: 'Event log' });
  const texts = log.locator('tbody td:last-child');
  for (const text of [
    'Connected to Simulated robot 1',
    'Emergency stop: You pressed STOP.',
    'You released the emergency stop',
    'The emergency stop is off',
    'You have control',
  ])
    await expect(texts.filter({ hasText: text }).first()).toBeVisible();
  for (const size of sizes) {
    await page.setViewportSize(size);
    await operator.look(testInfo, `events-${size.width}`);
    await expectOnScreenAndApart(page.locator('#events, #estop'), size);
  }
  const csv = await saved(page, log.getByRole('button', { name: 'CSV' }));
  expect(csv).toMatch(/^time,last_time,times,robot,severity,text\r\n.*Z,.*This page was opened\r\n/);
  expect(csv).toContain('Simulated robot 1,error,Emergency stop: You pressed STOP.\r\n');
  await log.getByLabel('Show events').selectOption('errors');
  await expect(texts.filter({ hasText: 'You have control' })).toHaveCount(0);
  await expect(texts.filter({ hasText: 'You pressed STOP.' })).toHaveCount(1);
  await operator.reload();
  await operator.expectPoints(100);
  await page.locator('#settings-open').press('Enter');
  await page.getByRole('button', { name: 'Event log…' }).press('Enter');
  await expect(texts.filter({ hasText: 'You pressed STOP.' })).toHaveCount(1);
  await log.getByRole('button', { name: 'Clear' }).click();
  await expect(texts.filter({ hasText: 'You pressed STOP.' })).toHaveCount(0);
});

test('the first drive goes on by what is done, and covers nothing that the hands need', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [lightRobot] });
  const operator = await OperatorPage.open(page, stack, { ...options, tour: '1' });
  await operator.expectPoints(100);
  const tour = page.locator('#tour');
  const said = tour.getByRole('status');
  await expect(said).toHaveText(/^Step 1 of 4: hold Space, Left Shift or Right Shift/);
  for (const size of sizes) {
    await page.setViewportSize(size);
    await operator.look(testInfo, `tour-${size.width}`);
    await expectOnScreenAndApart(page.locator('#tour, #bar, #drive button:visible, #joystick:visible'), size);
  }
  await expectAccessible(page, 'first drive');
  const { keyboard } = page;
  await keyboard.down('Space');
  await expect(said).toHaveText(/^Step 2 of 4: with the grip held, press W/);
  await keyboard.up('Space');
  // On the spot: a cart may have come to wait in front of the robot.
  await operator.holdTurn();
  const now = async () => {
    await operator.gripAnew();
    return said.textContent();
  };
  await expect.poll(now).toMatch(/^Step 3 of 4: press X or the STOP button/);
  await keyboard.press('KeyX');
  await operator.release();
  await expect(said).toHaveText(/^Step 4 of 4: hold R or “Hold to release”/);
  await operator.screenshots(page, testInfo, 'tour-release');
  await operator.releaseEstop();
  await expect(said).toHaveText(/^That was all/);
  await tour.getByRole('button', { name: 'Close' }).click();
  await expect(tour).toHaveCount(0);
});

test('the deployed page shows the first drive by itself, until it was ended once', async ({
  page,
  startStack,
}) => {
  const webRoot = join(repositoryRoot, 'apps', 'webxr', 'dist');
  const stack = await startStack({ robots: [lightRobot], webRoot });
  const url = new URL(stack.webUrl);
  url.searchParams.set('robot', lightRobot.id);
  url.searchParams.set('canvas', options.canvas);
  await page.goto(url.href);
  const tour = page.locator('#tour');
  await expect(tour.getByRole('status')).toHaveText(/^Step 1 of 4/);
  await tour.getByRole('button', { name: 'End the tour' }).click();
  await expect(tour).toHaveCount(0);
  await page.reload();
  await expect(page.locator('#link')).toHaveText(/^Live/);
  // Whoever wants it again finds it in the help, as soon as there is a robot to drive.
  await page.keyboard.press('?');
  const again = page.getByRole('button', { name: /^First drive/ });
  await expect(again).toBeVisible();
  await expect(tour).toHaveCount(0);
  await again.click();
  await expect(tour.getByRole('status')).toHaveText(/^Step 1 of 4/);
});
