import { writeFileSync } from 'node:fs';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, test } from '../src/stack-test.ts';

test('the page explains a refused token, and the right one solves the problem', async ({
  page,
  startStack,
}, testInfo) => {
  const tokens = testInfo.outputPath('operators.json');
  writeFileSync(tokens, JSON.stringify({ anna: 'a-right-token-of-some-length' }));
  const stack = await startStack({ signalingArgs: ['--operator-tokens', tokens] });
  const operator = await OperatorPage.open(page, stack, { token: 'a-wrong-token-of-some-length' });
  await operator.expectState('signaling', 'refused');
  await expect(page.getByText(/refused the token/i).first()).toBeVisible();
  expect(await page.evaluate(() => window.farpoint.robots())).toEqual([]);
  await operator.look(testInfo, 'refused');

  await page.getByRole('button', { name: 'Settings' }).click();
  await page.getByLabel('Token').fill('a-right-token-of-some-length');
  await page.getByRole('button', { name: 'Save and reconnect' }).click();
  await page.waitForFunction(() => window.farpoint?.state().signaling === 'ready');
  await page.getByRole('button', { name: /Simulated robot 1/ }).click();
  await operator.expectPoints();
});

test('without a headset the page says why there is no VR', async ({ page, startStack }) => {
  const stack = await startStack();
  await OperatorPage.open(page, stack);
  await expect(page.getByText(/headset|WebXR/).first()).toBeVisible();
  await expect(page.getByRole('button', { name: 'Enter VR' })).toBeHidden();
});

test('a link to another signaling service does not send it this service’s token', async ({
  page,
  startStack,
}, testInfo) => {
  const token = 'a-right-token-of-some-length';
  const tokens = testInfo.outputPath('operators.json');
  writeFileSync(tokens, JSON.stringify({ anna: token }));
  const stack = await startStack({ signalingArgs: ['--operator-tokens', tokens] });
  const hellos: Record<string, unknown>[] = [];
  await page.routeWebSocket('wss://elsewhere.example/**', (socket) => {
    socket.onMessage((message) => hellos.push(JSON.parse(String(message))));
  });
  const elsewhere = async () => {
    const { length } = hellos;
    await OperatorPage.open(page, stack, { signaling: 'wss://elsewhere.example' });
    await expect.poll(() => hellos.length, { message: 'hellos' }).toBeGreaterThan(length);
    for (const hello of hellos)
      expect(hello).toEqual({ type: 'operator.hello', protocol: 1, name: 'Operator' });
  };

  // A single token, as earlier versions of the page stored it.
  const operator = await OperatorPage.open(page, stack);
  await page.evaluate((t) => localStorage.setItem('farpoint.settings', JSON.stringify({ token: t })), token);
  await elsewhere();
  await OperatorPage.open(page, stack);
  await operator.expectState('signaling', 'ready');

  // As this version stores it.
  await page.getByRole('button', { name: 'Settings' }).click();
  await expect(page.getByLabel('Token')).toHaveValue(token);
  await page.getByLabel('Signaling service').fill('wss://elsewhere.example');
  await expect(page.getByLabel('Token')).toHaveValue('');
  await page.getByLabel('Signaling service').fill('');
  await expect(page.getByLabel('Token')).toHaveValue(token);
  // Nothing has changed, so nothing is connected anew.
  await page.getByRole('button', { name: 'Save', exact: true }).click();
  await expect(page.getByLabel('Token')).toBeHidden();
  await OperatorPage.open(page, stack);
  await operator.expectState('signaling', 'ready');
  await elsewhere();
});
