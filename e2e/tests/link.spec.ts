import { readFileSync } from 'node:fs';
import { chromiumLaunchOptions, EmulatedLink } from '@farpoint/local-stack';
import { chromium } from '@playwright/test';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, simulatedRobot, test } from '../src/stack-test.ts';

const ONE_WAY_MS = 20;
const CAPACITY_MBPS = 20;

interface Bin {
  type: string;
  direction: 'up' | 'down';
  capacityMbps: number;
  deliveredBytes: number;
  deliveredPackets: number;
}

test('over an emulated link: points arrive with the link’s delay, and nothing bypasses it', async ({
  page,
  startStack,
}, testInfo) => {
  const statsFile = testInfo.outputPath('link.jsonl');
  const stack = await startStack({ robots: [] });
  const link = await EmulatedLink.start(stack, {
    args: ['--rate-mbps', String(CAPACITY_MBPS), '--rtt-ms', String(2 * ONE_WAY_MS), '--queue-ms', '200'],
    statsFile,
  });
  try {
    const args = ['--signaling', link.signalingUrl, '--bitrate-mbps', '12'];
    await stack.startRobot({ ...simulatedRobot, args: [...simulatedRobot.args, ...args] });
    const operator = await OperatorPage.open(page, stack, { robot: simulatedRobot.id });
    await operator.expectPoints();
    // The offset of the clocks is known to within half of the best round trip's excess delay, so the first points can
    // seem later than they are.
    await expect
      .poll(async () => (await operator.stats()).deliveryMs?.p50)
      .toBeGreaterThanOrEqual(ONE_WAY_MS);
    const { minRttMs, packetsReceived } = await operator.stats();
    expect(minRttMs).toBeGreaterThanOrEqual(2 * ONE_WAY_MS);
    expect(packetsReceived).toBeGreaterThan(100);

    // The robot can be driven over it, too.
    const start = await operator.body();
    await operator.holdForward();
    await operator.expectMovedFrom(start, 0.3);
    await operator.release();
    await operator.expectStanding();

    // What the link drops reaches nobody, because there is no other path.
    link.tell({ type: 'blackhole', direction: 'both', active: true });
    await expect.poll(async () => (await operator.state()).link).toContain('Connection lost');
    const { packetsReceived: last } = await operator.stats();
    link.tell({ type: 'blackhole', direction: 'both', active: false });
    await operator.expectPoints();

    await link.stop();
    const bins = readFileSync(statsFile, 'utf8')
      .trimEnd()
      .split('\n')
      .map((line) => JSON.parse(line) as Bin)
      .filter(({ type }) => type === 'bin');
    const up = bins.filter(({ direction }) => direction === 'up');
    const carried = up.reduce((sum, { deliveredPackets }) => sum + deliveredPackets, 0);
    expect(carried).toBeGreaterThan(Math.max(packetsReceived, last));
    // One packet may have begun in the previous bin.
    for (const { deliveredBytes } of up) {
      expect(deliveredBytes).toBeLessThanOrEqual(CAPACITY_MBPS * 12_500 + 1500);
    }
  } finally {
    await link.stop();
  }
});

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
