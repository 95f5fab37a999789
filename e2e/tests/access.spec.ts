import { mkdirSync } from 'node:fs';
import type { LocalStack } from '@farpoint/local-stack';
import type { Page, TestInfo } from '@playwright/test';
import { GrantOffice } from '../src/grant-office.ts';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';

interface GuardedStack {
  office: GrantOffice;
  stack: LocalStack;
}

/** A robot that admits only operators with a grant. */
async function guarded(
  startStack: (spec: object) => Promise<LocalStack>,
  testInfo: TestInfo,
): Promise<GuardedStack> {
  const folder = testInfo.outputPath('office');
  mkdirSync(folder, { recursive: true });
  const office = await GrantOffice.open(folder);
  const args = [...lightRobot.args, '--grant-keys', office.keys];
  return { office, stack: await startStack({ robots: [{ ...lightRobot, args }] }) };
}

const obstacle = (page: Page) => page.getByRole('alertdialog');
const dialog = (page: Page) => page.getByRole('dialog', { name: 'Grants' });

async function addGrant(page: Page, text: string): Promise<void> {
  await dialog(page).getByLabel('Grant or ticket').fill(text);
  await dialog(page).getByRole('button', { name: 'Add grant' }).click();
  await expect(dialog(page).getByText('Added.')).toBeVisible();
}

async function close(page: Page): Promise<void> {
  await dialog(page).getByRole('button', { name: 'Close' }).click();
}

test('an operator without a grant is told what to do; a grant for this browser’s key lets it in', async ({
  page,
  startStack,
}, testInfo) => {
  const { office, stack } = await guarded(startStack, testInfo);
  const operator = await OperatorPage.open(page, stack, { robot: lightRobot.id });
  await expect(obstacle(page)).toContainText('admits only operators with a grant');
  await operator.screenshot(testInfo, 'not-granted');
  // It asks nobody again by itself.
  expect((await operator.state()).session).toBe('waiting');

  await obstacle(page).getByRole('button', { name: 'Grants…' }).click();
  const forKey = await expect
    .poll(() => dialog(page).getByLabel('This browser’s key').inputValue())
    .toMatch(/^[\w-]{43}$/)
    .then(() => dialog(page).getByLabel('This browser’s key').inputValue());
  const text = dialog(page).getByLabel('Grant or ticket');
  await text.fill('not a grant');
  await expect(dialog(page).getByText('neither a grant nor a ticket')).toBeVisible();
  await expect(dialog(page).getByRole('button', { name: 'Add grant' })).toBeDisabled();
  await text.fill(await office.issue({ name: 'Ada', role: 'drive', forKey: 'A'.repeat(43) }));
  await expect(dialog(page).getByText('another key than this browser’s')).toBeVisible();

  await text.fill(await office.issue({ name: 'Ada Lovelace', role: 'drive', forKey }));
  await expect(dialog(page).getByText(/^Ada Lovelace may drive: \*, until/)).toBeVisible();
  await operator.screenshot(testInfo, 'grant-read');
  await dialog(page).getByRole('button', { name: 'Add grant' }).click();
  await operator.expectState('session', 'live');
  await close(page);
  await expect(obstacle(page)).toBeHidden();
  await operator.expectPoints(100);
  await operator.holdForward();
  await operator.expectState('holder', 'you');
  await operator.release();

  // The key and the grant outlive the page, and no script can read the key.
  await page.reload();
  await page.waitForFunction(() => window.farpoint !== undefined);
  await operator.expectState('session', 'live');
  const stored = await page.evaluate(
    () =>
      new Promise<boolean[]>((resolve) => {
        const open = indexedDB.open('farpoint');
        open.onsuccess = () => {
          const all = open.result.transaction('access').objectStore('access').getAll();
          all.onsuccess = () =>
            resolve(
              all.result.map((each: { own: { privateKey: CryptoKey } }) => each.own.privateKey.extractable),
            );
        };
      }),
  );
  expect(stored).toEqual([false]);
});

test('a ticket in a link is taken out of the address, and used only once it was added', async ({
  page,
  startStack,
}, testInfo) => {
  const { office, stack } = await guarded(startStack, testInfo);
  const ticket = await office.issue({ name: 'Wim', role: 'watch' });
  await page.goto(`${stack.webUrl}?robot=${lightRobot.id}#grant=${ticket}`);
  await expect(dialog(page).getByText(/^Wim may watch: \*, until/)).toBeVisible();
  expect(page.url()).not.toContain('ticket');
  await expect(obstacle(page)).toBeVisible();
  await dialog(page).getByRole('button', { name: 'Add grant' }).click();
  await page.waitForFunction(() => window.farpoint.state().session === 'live');
  await close(page);

  // Its role is enforced by the robot; the page says so, and asks for nothing.
  await expect(page.getByText('Your grant lets you watch')).toBeVisible();
  await expect(page.getByLabel('Drive: hold and move')).toBeHidden();
  await page.keyboard.down(' ');
  await expect.poll(() => page.evaluate(() => window.farpoint.stats().framesDrawn)).toBeGreaterThan(10);
  expect(await page.evaluate(() => window.farpoint.state().holder)).toBe('nobody');
  await page.keyboard.up(' ');
  // Everybody may stop the robot.
  await page.getByRole('button', { name: 'STOP' }).click();
  await page.waitForFunction(() => window.farpoint.state().estop);
});

test('a supervisor sees who is here, and ends the session of a driver who drives', async ({
  page,
  browser,
  startStack,
}, testInfo) => {
  const { office, stack } = await guarded(startStack, testInfo);
  const enter = async (on: Page, name: string, role: 'drive' | 'supervise') => {
    const operator = await OperatorPage.open(on, stack, { robot: lightRobot.id });
    await obstacle(on).getByRole('button', { name: 'Grants…' }).click();
    await addGrant(on, await office.issue({ name, role }));
    await close(on);
    await operator.expectState('session', 'live');
    return operator;
  };
  const driverPage = await (await browser.newContext()).newPage();
  const driver = await enter(driverPage, 'Grace Hopper', 'drive');
  const supervisor = await enter(page, 'Sue', 'supervise');
  await driverPage.bringToFront();
  await driver.holdForward();
  await driver.expectState('holder', 'you');
  await page.bringToFront();
  await expect(page.getByText('2 are here: Grace Hopper drives')).toBeVisible();
  await page.getByText('2 are here').click();
  await expect(page.getByText('Sue (you, supervisor)')).toBeVisible();
  await supervisor.screenshot(testInfo, 'people');
  await page.getByRole('button', { name: 'End the session of Grace Hopper…' }).click();
  const confirm = page.getByRole('dialog', { name: 'End the session of Grace Hopper?' });
  await confirm.getByLabel('Also refuse this operator’s grant').check();
  await supervisor.screenshot(testInfo, 'end-session');
  await confirm.getByRole('button', { name: 'End session' }).click();
  await expect(page.getByText('Only you are here')).toBeVisible();
  await supervisor.expectState('holder', 'nobody');

  // The driver is told by whom, and does not come back by itself; its grant no longer helps.
  await expect.poll(async () => (await driver.state()).notice).toContain('Sue ended the session');
  expect((await driver.state()).session).toBe('none');
  await driverPage.getByRole('button', { name: /Simulated robot 1/ }).click();
  await expect(obstacle(driverPage)).toContainText('does not admit you');
  await driver.release();
  await driverPage.context().close();
});
