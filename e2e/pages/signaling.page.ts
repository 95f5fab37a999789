/** The page and its signaling service: which token it gets, and what the page says when it refuses. */
import type { Page } from '@playwright/test';
import { expect, test } from '../src/stage/page-test.ts';
import type { Stage } from '../src/stage/stage.ts';

const RIGHT = 'a-right-token-of-some-length';
const WRONG = 'a-wrong-token-of-some-length';
const READY = 'Signaling connected';

/** Answers as a signaling service that knows one token. @returns the first messages that it has got */
async function serve(page: Page, address: string | RegExp, token: string | null) {
  const hellos: Record<string, unknown>[] = [];
  await page.routeWebSocket(address, (socket) => {
    socket.onMessage((text) => {
      const message = JSON.parse(String(text)) as Record<string, unknown>;
      if (message.type !== 'operator.hello') return;
      hellos.push(message);
      const say = (answer: object) => socket.send(JSON.stringify(answer));
      if (token !== null && message.token !== token)
        return say({ type: 'error', code: 'unauthorized', message: 'the token is not known' });
      say({ type: 'operator.welcome', iceServers: [] });
      say({ type: 'robots', robots: [{ id: 'rover', name: 'Rover' }] });
    });
  });
  return hellos;
}

/** What the page says as soon as it has its answer, which comes whenever the browser brings it. */
async function expectLink({ page }: Stage, words: string | RegExp): Promise<void> {
  await expect(page.locator('#link')).toHaveText(words);
}

test('the page explains a refused token, and the right one solves the problem', async ({ stage }) => {
  const { page } = stage;
  const hellos = await serve(page, /\/operator$/, RIGHT);
  await stage.openOwn({ token: WRONG });
  await expectLink(stage, /refused the token/);
  await expect(page.locator('#robots-empty')).toBeVisible();
  await page.getByRole('button', { name: 'Settings' }).click();
  await page.getByLabel('Token').fill(RIGHT);
  const loaded = page.waitForEvent('load');
  await page.getByRole('button', { name: 'Save and reconnect' }).click();
  await loaded;
  await expectLink(stage, READY);
  await expect(page.getByRole('button', { name: /Rover/ })).toBeVisible();
  expect(hellos.map(({ token }) => token)).toEqual([WRONG, RIGHT]);
});

test('a link to another signaling service does not send it this service’s token', async ({ stage }) => {
  const { page } = stage;
  const own = await serve(page, /^ws:\/\/127\.0\.0\.1.*\/operator$/, RIGHT);
  const elsewhere = await serve(page, /^wss:\/\/elsewhere\.example\//, null);
  // A single token, as earlier versions of the page stored it.
  await stage.openOwn();
  await page.evaluate((token) => localStorage.setItem('farpoint.settings', JSON.stringify({ token })), RIGHT);
  await stage.openOwn({ signaling: 'wss://elsewhere.example' });
  await expectLink(stage, READY);
  await stage.openOwn();
  await expectLink(stage, READY);
  expect(own.at(-1)).toMatchObject({ token: RIGHT });

  // As this version stores it.
  await page.getByRole('button', { name: 'Settings' }).click();
  await expect(page.getByLabel('Token')).toHaveValue(RIGHT);
  await page.getByLabel('Signaling service').fill('wss://elsewhere.example');
  await expect(page.getByLabel('Token')).toHaveValue('');
  await page.getByLabel('Signaling service').fill('');
  await expect(page.getByLabel('Token')).toHaveValue(RIGHT);
  // The service is the one from before, and so is the connection.
  await page.getByRole('button', { name: 'Save', exact: true }).click();
  await expectLink(stage, READY);
  await stage.openOwn({ signaling: 'wss://elsewhere.example' });
  await expectLink(stage, READY);
  expect(elsewhere).toHaveLength(2);
  for (const hello of elsewhere)
    expect(hello).toEqual({ type: 'operator.hello', protocol: 1, name: 'Operator' });
});
