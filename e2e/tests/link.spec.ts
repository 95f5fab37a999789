import { chromiumLaunchOptions, EmulatedLink } from '@farpoint/local-stack';
import { chromium } from '@playwright/test';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, simulatedRobot, test } from '../src/stack-test.ts';

const ONE_WAY_MS = 20;

test('a browser that hides its addresses behind mDNS names is also led through the link', async ({
  startStack,
}) => {
  const options = chromiumLaunchOptions();
  const args = (options.args ?? []).filter((flag) => !flag.includes('WebRtcHideLocalIpsWithMdns'));
  const stack = await startStack({ robots: [] });
  const link = await EmulatedLink.start(stack, { args: ['--rtt-ms', String(2 * ONE_WAY_MS)] });
  const browser = await chromium.launch({ ...options, args });
  try {
    const robotArgs = [...simulatedRobot.args, '--signaling', link.signalingUrl];
    await stack.startRobot({ ...simulatedRobot, args: robotArgs });
    const operator = await OperatorPage.open(await browser.newPage(), stack, { robot: simulatedRobot.id });
    await operator.expectPoints();
    expect((await operator.stats()).minRttMs).toBeGreaterThanOrEqual(2 * ONE_WAY_MS);
  } finally {
    await browser.close();
    await link.stop();
  }
});
