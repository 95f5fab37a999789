import { EmulatedLink } from '@farpoint/local-stack';
import type { TestInfo } from '@playwright/test';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, LONG, simulatedRobot, test } from '../src/stack-test.ts';

/** The longest that an operator waits once the network is back. A loaded machine gets the same again. */
const RESUMED_MS = 2000;
const LOADED_MS = 2000;

const linkArgs = ['--rate-mbps', '20', '--rtt-ms', '30'];
const robotArgs = [...simulatedRobot.args, '--bitrate-mbps', '6'];

/** Time until the page has drawn a new frame, ms. */
async function msToNextFrame(operator: OperatorPage): Promise<number> {
  return operator.page.evaluate(async () => {
    const began = performance.now();
    const { framesDrawn } = window.farpoint.stats();
    while (window.farpoint.stats().framesDrawn === framesDrawn) {
      if (performance.now() - began > 20_000) return Number.POSITIVE_INFINITY;
      await new Promise((resolve) => setTimeout(resolve, 10));
    }
    return performance.now() - began;
  });
}

function note(testInfo: TestInfo, what: string, ms: number): void {
  testInfo.annotations.push({ type: what, description: `${Math.round(ms)} ms` });
  console.log(`  ${what}: ${Math.round(ms)} ms`);
}

/**
 * After the outage: the session is the same, the robot stands although the keys are held, and drives when they are
 * pressed again.
 */
async function expectDriveAgain(operator: OperatorPage): Promise<void> {
  expect(await operator.state()).toMatchObject({ session: 'live', sessionsOpened: 1, driving: false });
  // What the page knows is from before the outage.
  const { measuredMs } = await operator.state();
  await expect.poll(async () => (await operator.state()).measuredMs).not.toBe(measuredMs);
  await operator.expectStanding();
  const stood = await operator.body();
  await operator.expectFrames(15);
  const stands = await operator.body();
  expect(Math.hypot(stands.x - stood.x, stands.y - stood.y)).toBeLessThan(0.01);
  await operator.releaseKeys();
  const began = performance.now();
  await operator.holdForward();
  await operator.expectMovedFrom(stands, 0.05);
  console.log(`  drives again after ${Math.round(performance.now() - began)} ms`);
  await operator.releaseKeys();
  await operator.expectStanding();
}

test(
  'after 33 s without a network, everything resumes in the same session; the page says so, and held keys move nothing',
  { tag: LONG },
  async ({ page, startStack }, testInfo) => {
    const stack = await startStack({ robots: [] });
    const link = await EmulatedLink.start(stack, { args: linkArgs });
    try {
      await stack.startRobot({
        ...simulatedRobot,
        args: [...robotArgs, '--signaling', link.signalingUrl],
      });
      const operator = await OperatorPage.open(page, stack, { robot: simulatedRobot.id });
      await operator.expectPoints();
      const start = await operator.body();
      await operator.holdForward();
      await operator.expectMovedFrom(start, 0.2);

      link.tell({ type: 'blackhole', direction: 'both', active: true });
      await expect(page.getByText(/Connection lost for \d+ s/).first()).toBeVisible();
      await page.waitForTimeout(33_000);
      expect((await operator.state()).session).toBe('live');
      link.tell({ type: 'blackhole', direction: 'both', active: false });
      const resumedMs = await msToNextFrame(operator);
      note(testInfo, 'resumed after', resumedMs);
      expect(resumedMs).toBeLessThan(RESUMED_MS + LOADED_MS);
      await expectDriveAgain(operator);

      // Clocks and latency are correct again.
      const { minRttMs } = await operator.stats();
      expect(minRttMs).toBeGreaterThanOrEqual(30);
      await operator.page.evaluate(() => window.farpoint.requestLease());
      await operator.expectState('holder', 'you');
      await page.evaluate(() => window.farpoint.latencyTest());
      expect(await page.evaluate(() => window.farpoint.latencyResults().at(-1)?.mtpMs)).toBeLessThan(5000);
    } finally {
      await link.stop();
    }
  },
);

test(
  'signaling is down with the network, its sockets frozen: resumes just as fast',
  { tag: LONG },
  async ({ page, startStack }, testInfo) => {
    const stack = await startStack({ robots: [] });
    const link = await EmulatedLink.start(stack, { args: linkArgs });
    try {
      await stack.startRobot({
        ...simulatedRobot,
        args: [...robotArgs, '--signaling', link.signalingUrl],
      });
      const operator = await OperatorPage.open(page, stack, {
        robot: simulatedRobot.id,
        signaling: link.signalingUrl,
      });
      await operator.expectPoints();
      const start = await operator.body();
      await operator.holdForward();
      await operator.expectMovedFrom(start, 0.2);

      // No packet and no FIN, as when a mobile link is lost.
      process.kill(link.process.pid, 'SIGSTOP');
      await expect.poll(async () => (await operator.state()).signaling).not.toBe('ready');
      await page.waitForTimeout(6000);
      process.kill(link.process.pid, 'SIGCONT');
      const resumedMs = await msToNextFrame(operator);
      note(testInfo, 'resumed after', resumedMs);
      expect(resumedMs).toBeLessThan(RESUMED_MS + LOADED_MS);
      await expectDriveAgain(operator);
    } finally {
      await link.stop();
    }
  },
);

test('all addresses change: ICE restarts with new ones, in the same session', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [] });
  const link = await EmulatedLink.start(stack, { args: linkArgs });
  try {
    await stack.startRobot({
      ...simulatedRobot,
      args: [...robotArgs, '--signaling', link.signalingUrl],
    });
    const operator = await OperatorPage.open(page, stack, { robot: simulatedRobot.id });
    await operator.expectPoints();
    const start = await operator.body();
    await operator.holdForward();
    await operator.expectMovedFrom(start, 0.2);

    const began = performance.now();
    await link.renumber();
    const renumberedMs = performance.now() - began;
    const resumedMs = await msToNextFrame(operator);
    note(testInfo, 'new addresses after', renumberedMs);
    note(testInfo, 'resumed after', resumedMs);
    expect(resumedMs).toBeLessThan(RESUMED_MS + LOADED_MS);
    await expectDriveAgain(operator);
  } finally {
    await link.stop();
  }
});
