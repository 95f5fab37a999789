/** When nothing is heard from the robot any more, no figure claims to be live, and the page says what happened. */
import type { Locator, TestInfo } from '@playwright/test';
import { enterVr, Headset, headsetViewport } from '../src/headset.ts';
import { expectOnScreenAndApart } from '../src/layout.ts';
import { OperatorPage, screenSizes } from '../src/operator-page.ts';
import { expect, LONG, lightRobot, simulatedRobot, test } from '../src/stack-test.ts';

/** Figures of the robot or of the stream. */
const LIVE = ['State', 'Speed', 'Points', 'Rate', 'Loss', 'Round trip', 'Frame age'];
const DASHES = LIVE.map(() => '–');
const STOP = '#bar button:visible, #estop, #banner';

/** What the table says of what is live. */
async function liveFigures(facts: Locator): Promise<(string | null)[]> {
  return Promise.all(
    LIVE.map((name) => facts.locator(`dt:text-is("${name}") + dd`).textContent({ timeout: 5000 })),
  );
}

function note(testInfo: TestInfo, ms: { figures: number; banner: number }): void {
  const description = `figures ${Math.round(ms.figures)} ms, banner ${Math.round(ms.banner)} ms`;
  testInfo.annotations.push({ type: 'after the last word', description });
  console.log(`  ${description}`);
}

/** In the page, from now on: how long after the robot's last word its figures are gone and the banner stands, ms. */
function watchPage(): Promise<{ figures: number; banner: number }> {
  return new Promise((resolve) => {
    const at: Partial<Record<'figures' | 'banner', number>> = {};
    const look = () => {
      const silentMs = window.farpoint.state().silentMs;
      const speed = [...document.querySelectorAll('#facts dt')].find((dt) => dt.textContent === 'Speed');
      if (speed?.nextElementSibling?.textContent === '–') at.figures ??= silentMs;
      if (document.querySelector('#banner')?.hasAttribute('hidden') === false) at.banner ??= silentMs;
      const { figures, banner } = at;
      if (figures !== undefined && banner !== undefined) resolve({ figures, banner });
      else setTimeout(look, 5);
    };
    look();
  });
}

test('the robot is killed while it is driven: its figures are gone, a banner says so, and both come back', async ({
  page,
  startStack,
}, testInfo) => {
  // Light: the page must read the grip in time while it draws in software.
  const stack = await startStack({ robots: [lightRobot] });
  const operator = await OperatorPage.open(page, stack, { robot: lightRobot.id, canvas: '320x180' });
  await operator.expectPoints(300);
  const start = await operator.body();
  await operator.holdForward();
  await operator.expectMovedFrom(start, 0.2);
  const facts = page.locator('#facts');
  const banner = page.locator('#banner');
  await expect(banner).toBeHidden();
  expect(await liveFigures(facts)).not.toContain('–');

  const seen = page.evaluate(watchPage);
  stack.robot(lightRobot.id).signal('SIGSTOP');
  note(testInfo, await seen);
  expect(await liveFigures(facts)).toEqual(DASHES);
  await expect(page.locator('#holder')).toHaveText('The robot does not hear you');
  await expect(banner).toContainText('Connection lost');
  await expect(banner).toContainText('Let go of the grip');
  await operator.releaseKeys();
  await expect(banner).not.toContainText('Let go of the grip');
  for (const size of screenSizes) {
    await page.setViewportSize(size);
    await operator.look(testInfo, `lost-${size.width}`);
    await expectOnScreenAndApart(page.locator(STOP), size);
  }

  stack.robot(lightRobot.id).signal('SIGCONT');
  await expect(banner).toBeHidden();
  await expect.poll(() => liveFigures(facts)).not.toContain('–');
});

test(
  'the robot’s program dies: the banner stays until it is back, and says whether it is there',
  { tag: LONG },
  async ({ page, openRobot }, testInfo) => {
    const { stack, operator } = await openRobot();
    await stack.robot(simulatedRobot.id).kill();
    const banner = page.locator('#banner');
    await expect(banner).toContainText('Connection lost');
    await expect(page.locator('#hud')).toBeHidden({ timeout: 60_000 });
    await expect(banner).toContainText('The robot is offline');
    await operator.look(testInfo, 'offline');
    await stack.startRobot(simulatedRobot);
    await expect(banner).toBeHidden({ timeout: 60_000 });
    await operator.expectPoints();
  },
);

test.describe('in the headset', () => {
  test.use({ viewport: headsetViewport });

  test('no figure on the wrist is live without a word from the robot', async ({
    page,
    startStack,
  }, testInfo) => {
    const stack = await startStack({ robots: [lightRobot] });
    const headset = await Headset.wear(page);
    const operator = await OperatorPage.open(page, stack, { robot: lightRobot.id });
    await operator.expectPoints(300);
    await enterVr(page, operator);
    await headset.place('left', [-0.05, 1.55, -0.35]);
    const lines = () => page.evaluate(() => (window.farpoint.wrist() ?? []).map(({ text }) => text));
    await expect.poll(lines).toContainEqual(expect.stringMatching(/^rtt \d/));
    stack.robot(lightRobot.id).signal('SIGSTOP');
    await expect.poll(lines).toContain('rtt –  frame –  loss –');
    expect(await lines()).not.toContain('Live');
    expect(await lines()).toContain('points –');
    expect((await lines()).join()).not.toMatch(/m\/s|Battery|Stationary|Driving/);
    await operator.look(testInfo, 'wrist-lost');
    stack.robot(lightRobot.id).signal('SIGCONT');
    await expect.poll(lines).toContainEqual(expect.stringMatching(/^rtt \d/));
  });
});
