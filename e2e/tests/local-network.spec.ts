/** From an address in a terminal to the first drive, as on a headset or a phone in the same network, over real TLS. */
import { createHash } from 'node:crypto';
import { readFileSync } from 'node:fs';
import { freePorts } from '@farpoint/local-stack';
import { GrantOffice } from '../src/grant-office.ts';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';

// Trusting an authority is the system's matter: whether its certificates can be trusted is tested with OpenSSL.
test.use({ viewport: { width: 390, height: 844 }, hasTouch: true, ignoreHTTPSErrors: true });

test('the certificate’s page, a pairing code, and the first drive', async ({
  page,
  startStack,
}, testInfo) => {
  const [lanPort, installPort] = (await freePorts(2)) as [number, number];
  const office = await GrantOffice.open(testInfo.outputPath());
  const terminal: string[] = [];
  const stack = await startStack({
    signalingArgs: [
      ...['--lan', '--open', '--lan-hosts', '127.0.0.1', '--authority-dir', testInfo.outputPath('authority')],
      ...['--lan-port', String(lanPort), '--lan-install-port', String(installPort)],
      ...['--pair-key', office.secretKey],
    ],
    robots: [{ ...lightRobot, args: [...lightRobot.args, '--grant-keys', office.keys] }],
    onLine: (name, line) => {
      if (name === 'signaling') terminal.push(line);
    },
  });
  const said = (pattern: RegExp) =>
    expect
      .poll(() => pattern.exec(terminal.join('\n'))?.[1] ?? '', { message: String(pattern) })
      .not.toBe('')
      .then(() => pattern.exec(terminal.join('\n'))?.[1] as string);

  await page.goto(await said(/headset or a phone, once\s+(http:\S+)/));
  const fingerprint = await said(/certificate to install:\s+(\S+)/);
  await expect(page.getByText(fingerprint)).toBeVisible();
  await page.screenshot({ path: testInfo.outputPath('install.png'), fullPage: true });
  const downloading = page.waitForEvent('download');
  await page.getByRole('link', { name: 'Get the certificate' }).click();
  const download = await downloading;
  expect(download.suggestedFilename()).toBe('farpoint-authority.crt');
  const file = testInfo.outputPath('authority.crt');
  await download.saveAs(file);
  const der = Buffer.from(readFileSync(file, 'latin1').replace(/-----[^-]+-----|\s/g, ''), 'base64');
  const digest = createHash('sha256').update(der).digest('hex').toUpperCase();
  expect(digest).toBe(fingerprint.replaceAll(':', ''));

  await page.getByRole('link', { name: 'Open Farpoint' }).click();
  await expect(page).toHaveURL(`https://127.0.0.1:${lanPort}/`);
  expect(await page.evaluate(() => window.isSecureContext)).toBe(true);
  await page.locator('#robot-list button').click();
  const obstacle = page.getByRole('alertdialog');
  await expect(obstacle).toContainText('Sign in to get one');
  expect(terminal.join('\n')).not.toContain('Pairing code');
  await obstacle.getByRole('button', { name: 'Sign in' }).click();

  const code = await said(/Pairing code\s+(\d{3} \d{3})/);
  await page.screenshot({ path: testInfo.outputPath('pair.png') });
  const field = page.getByLabel('Code');
  await field.fill(code === '000 000' ? '111111' : '000000');
  await page.getByRole('button', { name: 'Pair' }).click();
  await expect(page.getByRole('alert')).toContainText('That is not the code');
  await field.fill(code);
  await page.getByRole('button', { name: 'Pair' }).click();
  await page.waitForFunction(() => window.farpoint !== undefined);
  await expect(page.getByText('Signed in: Paired browser may drive: *')).toBeVisible();
  expect(page.url()).not.toContain('#');

  const operator = OperatorPage.of(page);
  await operator.expectPoints(100);
  const start = await operator.body();
  await operator.holdForward();
  await operator.expectMovedFrom(start, 0.1);
  await operator.releaseKeys();
  await operator.look(testInfo, 'driven');
  // Its code has let one browser in, and no other.
  expect(stack.signaling.output).toContain('paired a browser');
});
