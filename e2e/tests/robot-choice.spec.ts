/** Which robot is chosen: the page's address keeps it, and a robot that is not there is said to be missing. */
import { writeFileSync } from 'node:fs';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';

test('the address follows the choice, and a reload comes back to it', async ({ page, startStack }) => {
  const stack = await startStack({ robots: [lightRobot] });
  const operator = await OperatorPage.open(page, stack, { canvas: '64x36' });
  const robotInAddress = () => new URL(page.url()).searchParams.get('robot');
  expect(robotInAddress()).toBeNull();
  await page.locator(`[data-robot="${lightRobot.id}"]`).click();
  await operator.expectPoints(100);
  expect(robotInAddress()).toBe(lightRobot.id);
  await operator.reload();
  await operator.expectPoints(100);
  await page.getByRole('button', { name: 'Disconnect' }).click();
  await operator.expectState('session', 'none');
  expect(robotInAddress()).toBeNull();
});

test('a robot that is not there: the page says so once the list has come, and offers those that are', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [lightRobot] });
  const operator = await OperatorPage.open(page, stack, { robot: 'sim-99', canvas: '64x36' });
  const missing = page.locator('#robots-missing');
  await expect(missing).toHaveText(/^No robot “sim-99” is online: .* Or choose another\.$/);
  await expect(page.locator('#robots-empty')).toBeHidden();
  await operator.look(testInfo, 'missing');
  await page.locator(`[data-robot="${lightRobot.id}"]`).click();
  await operator.expectPoints(100);
  await expect(page.locator('#robots')).toBeHidden();
});

test('a refused token is not followed by “no robots”', async ({ page, startStack }, testInfo) => {
  const tokens = testInfo.outputPath('operators.json');
  writeFileSync(tokens, JSON.stringify({ anna: 'a-right-token-of-some-length' }));
  const stack = await startStack({ signalingArgs: ['--operator-tokens', tokens] });
  await OperatorPage.open(page, stack, { token: 'a-wrong-token-of-some-length' });
  await expect(page.locator('#link')).toHaveText(/refused the token/);
  await expect(page.locator('#robots-empty')).toBeHidden();
});

test('a point size shows at once and is kept without a new connection; values are shown, and defaults restored', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [lightRobot] });
  const operator = await OperatorPage.open(page, stack, { robot: lightRobot.id });
  await operator.expectPoints(100);
  const settings = page.getByRole('dialog', { name: 'Settings' });
  const [size, value] = [settings.getByLabel('Point size'), settings.locator('output[data-of="pointScale"]')];
  const open = () => page.getByRole('button', { name: 'Settings' }).click();
  await page.evaluate(() => Object.assign(window, { stillHere: true }));

  await open();
  await expect(value).toHaveText('1.00 ×');
  await size.fill('2.5');
  await expect(value).toHaveText('2.50 ×');
  await operator.look(testInfo, 'settings');
  await settings.getByRole('button', { name: 'Save', exact: true }).click();
  await expect(settings).toBeHidden();
  await open();
  await expect(value).toHaveText('2.50 ×');
  // So does how everything sounds, and whether videos wait for each other.
  await settings.getByLabel('Sound and vibration').uncheck();
  await settings.getByRole('button', { name: 'Save', exact: true }).click();
  await open();
  await expect(settings.getByLabel('Sound and vibration')).not.toBeChecked();
  await settings.getByRole('button', { name: 'Defaults' }).click();
  await expect(value).toHaveText('1.00 ×');
  // Anything else needs the page to start anew, and the button says so.
  await settings.getByLabel('Your name').fill('Ada');
  await expect(settings.getByRole('button', { name: 'Save and reconnect' })).toBeVisible();
  await settings.getByRole('button', { name: 'Cancel' }).click();
  expect(await page.evaluate(() => 'stillHere' in window)).toBe(true);
  await operator.expectState('session', 'live');

  // The latency test is not where a hand looks for STOP.
  const [latency, stop] = [
    await page.locator('#latency').boundingBox(),
    await page.locator('#estop').boundingBox(),
  ];
  expect((latency?.x ?? 0) + (latency?.width ?? 0)).toBeLessThan(stop?.x ?? 0);
});
