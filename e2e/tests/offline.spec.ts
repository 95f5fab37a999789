/** The deployed page as an installed app: what the browser needs to install it, and what it shows without a connection. */
import { join } from 'node:path';
import { freePorts, repositoryRoot } from '@farpoint/local-stack';
import { expect, lightRobot, test } from '../src/stack-test.ts';

const webRoot = join(repositoryRoot, 'apps', 'webxr', 'dist');

test('can be installed; says that there is no connection, and comes back by itself', async ({
  page,
  startStack,
}, testInfo) => {
  const [signaling, referenceRobot, referenceClient] = (await freePorts(3)) as [number, number, number];
  const ports = { signaling, referenceRobot, referenceClient };
  const stack = await startStack({ webRoot, ports, robots: [lightRobot] });
  await page.goto(stack.webUrl);
  await expect(page.locator('#robot-list button')).toBeVisible();
  const devtools = await page.context().newCDPSession(page);
  const manifest = await devtools.send('Page.getAppManifest');
  expect(manifest.errors).toEqual([]);
  expect(JSON.parse(manifest.data ?? '')).toMatchObject({ name: 'Farpoint', display: 'standalone' });
  const worker = () => navigator.serviceWorker.ready.then(({ active }) => active?.scriptURL);
  expect(await page.evaluate(worker)).toBe(`${stack.webUrl}offline-worker.js`);

  await stack.signaling.stop();
  await page.reload();
  await expect(page.getByRole('alert')).toContainText('Farpoint’s server cannot be reached');
  await page.screenshot({ path: testInfo.outputPath('offline.png') });
  expect(await page.evaluate(() => caches.keys())).toEqual(['offline']);

  await stack.startSignaling();
  await expect(page.locator('#robot-list button')).toBeVisible();
  await expect(page.getByRole('alert').filter({ hasText: 'cannot be reached' })).toHaveCount(0);
});
