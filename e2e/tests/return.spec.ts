/** A robot that drives back by itself while its link is away, as its driver sees it when the link is back. */
import { EmulatedLink, type LocalStack } from '@farpoint/local-stack';
import type { Page } from '@playwright/test';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';

const RETURNS = [
  ...['--return', '--return-after-s', '5', '--return-announce-s', '1', '--lease-silence-s', '1'],
  // Its camera does not see the floor behind it.
  ...['--return-unseen', 'slow'],
];
const CAME_BACK = /^The link was lost; it came back (\d\.\d) m: until somebody was heard again/;

/** How far the robot has come back, m, as itself says. */
async function metresBack(stack: LocalStack): Promise<number> {
  const text = await (await fetch(`${stack.robotAdminUrl(lightRobot.id)}/metrics`)).text();
  return Number(/^farpoint_robot_return_metres_total(?:\{.*\})? (.+)$/m.exec(text)?.[1] ?? Number.NaN);
}

/** Starts a robot that drives back, and drives it 0.6 m away. The keys are still held. */
async function driveAway(page: Page, stack: LocalStack, link: EmulatedLink) {
  const args = [...lightRobot.args, ...RETURNS, '--signaling', link.signalingUrl];
  await stack.startRobot({ ...lightRobot, args });
  const operator = await OperatorPage.open(page, stack, { robot: lightRobot.id });
  await operator.expectPoints(300);
  const start = await operator.body();
  await operator.holdForward();
  await operator.expectMovedFrom(start, 0.6);
  return { operator };
}

test('a robot that came back while its link was away says so, stands, and waits for a fresh hand', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [] });
  const link = await EmulatedLink.start(stack, { args: ['--rate-mbps', '20', '--rtt-ms', '30'] });
  try {
    const { operator } = await driveAway(page, stack, link);

    // The grip is held on all the time.
    link.tell({ type: 'blackhole', direction: 'both', active: true });
    await expect(page.getByText(/Connection lost for \d+ s/).first()).toBeVisible();
    await expect.poll(() => metresBack(stack), { message: 'metres back' }).toBeGreaterThan(0.2);
    link.tell({ type: 'blackhole', direction: 'both', active: false });

    await operator.expectState('session', 'live');
    const words = page.getByText(CAME_BACK).filter({ visible: true }).first();
    await expect(words).toBeVisible();
    await operator.expectStanding();
    const metres = Number(CAME_BACK.exec((await words.textContent()) ?? '')?.[1]);
    expect(metres).toBeGreaterThanOrEqual(0.2);
    const stands = await operator.body();
    await operator.expectFrames(10);
    const later = await operator.body();
    expect(Math.hypot(later.x - stands.x, later.y - stands.y)).toBeLessThan(0.01);
    for (const width of [360, 3840, 1280]) {
      await page.setViewportSize({ width, height: width === 360 ? 740 : Math.round(width * 0.5625) });
      await expect(words).toBeInViewport({ ratio: 1 });
      await operator.look(testInfo, `came-back-${width}`);
    }

    // A fresh hand drives it, and then it is past.
    await operator.releaseKeys();
    await operator.expectState('drive', 'idle');
    // Backwards: ahead may be what held it before.
    await operator.hold({
      async hold() {
        await page.keyboard.down('Space');
        await page.keyboard.down('KeyS');
      },
      async release() {
        await page.keyboard.up('KeyS');
        await page.keyboard.up('Space');
      },
    });
    await operator.expectMovedFrom(stands, 0.1);
    await operator.release();
    await expect(words).toBeHidden();
  } finally {
    await link.stop();
  }
});

test('STOP that is pressed while the robot drives back stops it when the link is back', async ({
  page,
  startStack,
}) => {
  const stack = await startStack({ robots: [] });
  const link = await EmulatedLink.start(stack, { args: ['--rate-mbps', '20', '--rtt-ms', '30'] });
  try {
    const { operator } = await driveAway(page, stack, link);
    await operator.releaseKeys();
    link.tell({ type: 'blackhole', direction: 'both', active: true });
    await expect(page.getByText(/Connection lost for \d+ s/).first()).toBeVisible();
    await expect.poll(() => metresBack(stack), { message: 'metres back' }).toBeGreaterThan(0.1);
    await page.locator('#estop').click();
    link.tell({ type: 'blackhole', direction: 'both', active: false });
    await operator.expectState('estop', true);
    await operator.expectStanding();
    await expect(page.locator('#stop-state')).toHaveText('STOP confirmed');
    // Its release does not make the robot go on.
    await operator.releaseEstop();
    const stands = await operator.body();
    await operator.expectFrames(10);
    const later = await operator.body();
    expect(Math.hypot(later.x - stands.x, later.y - stands.y)).toBeLessThan(0.01);
  } finally {
    await link.stop();
  }
});
