import { SignOn } from '@farpoint/issuer/testing';
import { freePorts, type LocalStack } from '@farpoint/local-stack';
import type { Page } from '@playwright/test';
import { GrantOffice } from '../src/grant-office.ts';
import { OperatorPage } from '../src/operator-page.ts';
import { test as base, expect, lightRobot } from '../src/stack-test.ts';

/** A robot that admits only operators with a grant, an issuer, and a provider with people. */
interface SignedOnStack {
  stack: LocalStack;
  signOn: SignOn;
}

const test = base.extend<{ signedOn: SignedOnStack }>({
  signedOn: async ({ startStack }, use, testInfo) => {
    const [signaling, referenceRobot, referenceClient] = (await freePorts(3)) as [number, number, number];
    const signOn = await SignOn.start({
      folder: testInfo.outputPath('issuer'),
      pages: [`http://localhost:${signaling}/`],
      people: {
        ada: { name: 'Ada Lovelace', groups: ['drivers'] },
        wim: { name: 'Wim', groups: ['guests'] },
      },
      rules: [{ claim: 'groups', value: 'drivers', role: 'drive', robots: ['sim-*'] }],
    });
    const args = [...lightRobot.args, '--grant-keys', signOn.keysFile];
    const stack = await startStack({
      ports: { signaling, referenceRobot, referenceClient },
      signalingArgs: ['--sign-in-url', signOn.signInUrl],
      robots: [{ ...lightRobot, args }],
    });
    await use({ stack, signOn });
    await signOn.stop();
  },
});

const obstacle = (page: Page) => page.getByRole('alertdialog');
const dialog = (page: Page) => page.getByRole('dialog', { name: 'Grants' });

/** Signs in at the provider's own forms. */
async function signInAs(page: Page, name: string, allow = true): Promise<void> {
  await page.getByPlaceholder('Enter any login').fill(name);
  await page.getByPlaceholder('and password').fill('any');
  await page.getByRole('button', { name: 'Sign-in' }).click();
  await page.getByRole('button', { name: 'Continue' }).click();
  // The issuer's own question: for which page, in what role.
  if (allow) await page.getByRole('button', { name: 'Allow' }).click();
  await page.waitForFunction(() => window.farpoint !== undefined);
}

test('who signs in and agrees drives, and still after the page was loaded again', async ({
  page,
  signedOn: { stack, signOn },
}, testInfo) => {
  const operator = await OperatorPage.open(page, stack, { robot: lightRobot.id, mode: 'points64' });
  await expect(obstacle(page)).toContainText('Sign in to get one');
  await expect(obstacle(page)).toContainText(`You sign in at ${new URL(signOn.url).host}`);
  await operator.screenshots(page, testInfo, 'obstacle');
  await obstacle(page).getByRole('button', { name: 'Sign in' }).click();
  await signInAs(page, 'ada');

  // What the address asked for is still in it, and nothing else.
  const asked = Object.fromEntries(new URL(page.url()).searchParams);
  expect(asked).toEqual({ robot: lightRobot.id, canvas: expect.any(String), mode: 'points64' });
  expect(page.url()).not.toContain('#');
  await expect(page.getByText('Signed in: Ada Lovelace may drive: sim-*')).toBeVisible();
  await operator.expectState('session', 'live');
  await expect(obstacle(page)).toBeHidden();
  await operator.expectPoints(100);
  await operator.holdForward();
  await operator.expectState('holder', 'you');
  await operator.release();
  expect(await page.evaluate(() => sessionStorage.length)).toBe(0);

  await page.reload();
  await page.waitForFunction(() => window.farpoint !== undefined);
  await operator.expectState('session', 'live');
  await page.getByRole('button', { name: 'Settings' }).click();
  await page.getByRole('button', { name: 'Grants and robots’ keys…' }).click();
  await expect(dialog(page).getByRole('button', { name: 'Sign in' })).toBeVisible();
  await expect(dialog(page).getByText(/^Ada Lovelace may drive: sim-\*, until/)).toBeVisible();
  await operator.screenshots(page, testInfo, 'dialog');
});

test('who may not is told so in words, and a grant that nobody asked for is only offered', async ({
  page,
  signedOn: { stack },
}, testInfo) => {
  const operator = await OperatorPage.open(page, stack, { robot: lightRobot.id });
  await obstacle(page).getByRole('button', { name: 'Grants…' }).click();
  const forKey = await expect
    .poll(() => dialog(page).getByLabel('This browser’s key').inputValue())
    .toMatch(/^[\w-]{43}$/)
    .then(() => dialog(page).getByLabel('This browser’s key').inputValue());
  await dialog(page).getByRole('button', { name: 'Sign in' }).click();
  await signInAs(page, 'wim', false);
  await expect(
    dialog(page).getByText('You have signed in, but nothing here is set up for you'),
  ).toBeVisible();
  expect(page.url()).not.toContain('#');
  await operator.screenshots(page, testInfo, 'not-permitted');
  await operator.expectState('session', 'waiting');

  // For this browser's key, and with a state that the page did not make.
  const office = await GrantOffice.open(testInfo.outputPath());
  const grant = await office.issue({ name: 'Mallory', role: 'watch', forKey });
  await page.goto('about:blank');
  await page.goto(`${stack.webUrl}?robot=${lightRobot.id}#grant=${grant}&state=guessed`);
  await expect(dialog(page).getByText(/^Mallory may watch/)).toBeVisible();
  await expect(dialog(page).getByRole('listitem').filter({ hasText: 'Mallory' })).toHaveCount(0);
});

test('an issuer that cannot reach the provider says so on the page', async ({
  page,
  signedOn: { stack, signOn },
}) => {
  await OperatorPage.open(page, stack, { robot: lightRobot.id });
  await expect(obstacle(page)).toBeVisible();
  await signOn.provider.close();
  await obstacle(page).getByRole('button', { name: 'Sign in' }).click();
  await expect(dialog(page).getByText('The sign-in service cannot be reached')).toBeVisible();
});
