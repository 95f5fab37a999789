import { mkdirSync } from 'node:fs';
import { SignOn } from '@farpoint/issuer/testing';
import { freePorts } from '@farpoint/local-stack';
import type { Page } from '@playwright/test';
import { GrantOffice } from '../src/grant-office.ts';
import { OperatorPage } from '../src/operator-page.ts';
import { robotLike } from '../src/robots.ts';
import { expect, test } from '../src/smoke-test.ts';

const obstacle = (page: Page) => page.getByRole('alertdialog');
const grants = (page: Page) => page.getByRole('dialog', { name: 'Grants' });

test('an operator is let in by a grant, and drives until a supervisor ends the session', async ({
  page,
  browser,
  shared,
  startRobot,
}, testInfo) => {
  const folder = testInfo.outputPath('office');
  mkdirSync(folder, { recursive: true });
  const office = await GrantOffice.open(folder);
  const robot = await startRobot(robotLike('guarded', '--grant-keys', office.keys));
  const { stack } = shared;
  const enter = async (on: Page, name: string, role: 'drive' | 'supervise') => {
    const operator = await OperatorPage.open(on, stack.webUrl, { robot: robot.id });
    await expect(obstacle(on)).toContainText('admits only operators with a grant');
    await obstacle(on).getByRole('button', { name: 'Grants…' }).click();
    await grants(on)
      .getByLabel('Grant or ticket')
      .fill(await office.issue({ name, role }));
    await grants(on).getByRole('button', { name: 'Add grant' }).click();
    await operator.expectState('session', 'live');
    await grants(on).getByRole('button', { name: 'Close' }).click();
    return operator;
  };
  const driverContext = await browser.newContext();
  const driverPage = await driverContext.newPage();
  const driver = await enter(driverPage, 'Grace Hopper', 'drive');
  await driver.expectPoints();
  await driver.drives(0.1);
  const supervisor = await enter(page, 'Sue', 'supervise');
  await page.getByText('2 are here: Grace Hopper drives').click();
  await page.getByRole('button', { name: 'End the session of Grace Hopper…' }).click();
  const confirm = page.getByRole('dialog', { name: 'End the session of Grace Hopper?' });
  await confirm.getByLabel('Also refuse this operator’s grant').check();
  await confirm.getByRole('button', { name: 'End session' }).click();
  await expect(page.getByText('Only you are here')).toBeVisible();
  await supervisor.expectState('holder', 'nobody');

  // The driver is told by whom, and its grant no longer helps.
  await expect.poll(async () => (await driver.state()).notice).toContain('Sue ended the session');
  expect((await driver.state()).session).toBe('none');
  await driverPage.getByRole('button', { name: robot.name }).click();
  await expect(obstacle(driverPage)).toContainText('does not admit you');
  await driverContext.close();
});

test('who signs in at the provider and agrees is let in, and still after the page was loaded again', async ({
  page,
  startStack,
}, testInfo) => {
  const [signaling, referenceRobot, referenceClient] = (await freePorts(3)) as [number, number, number];
  const signOn = await SignOn.start({
    folder: testInfo.outputPath('issuer'),
    pages: [`http://localhost:${signaling}/`],
    people: { ada: { name: 'Ada Lovelace', groups: ['drivers'] } },
    rules: [{ claim: 'groups', value: 'drivers', role: 'drive', robots: ['signed-*'] }],
  });
  try {
    const robot = robotLike('signed-on', '--grant-keys', signOn.keysFile);
    const stack = await startStack({
      ports: { signaling, referenceRobot, referenceClient },
      signalingArgs: ['--sign-in-url', signOn.signInUrl],
      robots: [robot],
    });
    const operator = await OperatorPage.open(page, stack.webUrl, { robot: robot.id, video: 'native' });
    await obstacle(page).getByRole('button', { name: 'Sign in' }).click();
    // The provider's own forms, and the issuer's question.
    await page.getByPlaceholder('Enter any login').fill('ada');
    await page.getByPlaceholder('and password').fill('any');
    await page.getByRole('button', { name: 'Sign-in' }).click();
    await page.getByRole('button', { name: 'Continue' }).click();
    // It is shown for a while only, and the page may be busy with what comes next.
    const welcomed = page.getByText('Signed in: Ada Lovelace may drive: signed-*').waitFor();
    await page.getByRole('button', { name: 'Allow' }).click();
    await welcomed;
    await operator.loaded();

    // What the address asked for is still in it, and nothing else.
    const asked = Object.fromEntries(new URL(page.url()).searchParams);
    expect(asked).toEqual({ robot: robot.id, canvas: expect.any(String), video: 'native' });
    expect(page.url()).not.toContain('#');
    await operator.expectPoints();
    await operator.drives(0.1);
    // What happened here is kept, and nothing of the sign-in: neither its secrets nor the grant.
    const kept = await page.evaluate(() => Object.entries(sessionStorage));
    expect(kept.map(([key]) => key).sort()).toEqual(['farpoint.events', 'farpoint.reports']);
    expect(kept.join()).not.toMatch(/[\w-]{40}/);

    await page.reload();
    await operator.loaded();
    await operator.expectState('session', 'live');
  } finally {
    await signOn.stop();
  }
});
