/** The view answers the hand at once, although the robot is 150 ms away, and the page says that this is a prediction. */
import { EmulatedLink } from '@farpoint/local-stack';
import type { Page } from '@playwright/test';
import { enterVr, Headset, headsetViewport } from '../src/headset.ts';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';

const LOOP_MS = 200;
interface FirstMotion {
  /** From the key to the first display frame with a moved view, ms. */
  viewMs: number;
  /** From the key to the first telemetry of a moved body, ms. */
  bodyMs: number;
  frames: number;
}

/** Takes note, in the page, of when view and body first move after the next key press. */
async function watchMotion(page: Page): Promise<() => Promise<FirstMotion>> {
  await page.evaluate(() => {
    const far = (a: { x: number; y: number }, b: { x: number; y: number }) =>
      Math.hypot(a.x - b.x, a.y - b.y);
    const first = { viewMs: Number.NaN, bodyMs: Number.NaN, frames: 0 };
    Object.assign(window, { firstMotion: first });
    const onKey = (event: KeyboardEvent) => {
      if (event.code !== 'KeyW' || event.repeat) return;
      window.removeEventListener('keydown', onKey, true);
      const from = window.farpoint.state();
      const began = event.timeStamp;
      const look = () => {
        const { view, body } = window.farpoint.state();
        const sinceMs = performance.now() - began;
        if (Number.isNaN(first.viewMs)) {
          first.frames++;
          if (far(view, from.view) > 5e-5) first.viewMs = sinceMs;
        }
        if (body !== null && from.body !== null && far(body, from.body) > 5e-5) first.bodyMs = sinceMs;
        if (Number.isNaN(first.bodyMs) || Number.isNaN(first.viewMs)) setTimeout(look, 2);
      };
      look();
    };
    window.addEventListener('keydown', onKey, true);
  });
  return async () => {
    const read = () => page.evaluate(() => (window as unknown as { firstMotion: FirstMotion }).firstMotion);
    await expect.poll(async () => (await read()).bodyMs).toBeGreaterThan(0);
    await expect.poll(async () => (await read()).viewMs).toBeGreaterThan(0);
    return read();
  };
}

test('flat: the view moves before the robot can be seen to, and P and ?predict=0 switch that off', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [] });
  const link = await EmulatedLink.start(stack, { args: ['--rtt-ms', String(LOOP_MS)] });
  try {
    const args = [...lightRobot.args, '--signaling', link.signalingUrl];
    await stack.startRobot({ ...lightRobot, args });
    const operator = await OperatorPage.open(page, stack, { robot: lightRobot.id });
    await operator.expectPoints(300);
    await expect(page.locator('#facts')).toContainText('As reported');
    // The first grip gets the lease; from then on commands leave with the key.
    const start = await operator.body();
    await operator.holdForward();
    await operator.expectMovedFrom(start, 0.3);
    await expect(page.locator('#facts')).toContainText(/Predicted \d+ ms ahead/);
    expect((await operator.state()).view.aheadMs).toBeGreaterThan(LOOP_MS / 2);
    await operator.look(testInfo, 'driving');
    await page.keyboard.press('v');
    await operator.expectFrames(3);
    await operator.look(testInfo, 'ghost-from-behind');
    await page.keyboard.press('v');
    await operator.releaseKeys();
    await operator.expectStanding();
    await operator.expectFrames(10);

    const predicted = await watchMotion(page);
    await operator.holdForward();
    const { viewMs, bodyMs } = await predicted();
    await operator.releaseKeys();
    await operator.expectStanding();
    expect(bodyMs).toBeGreaterThan(LOOP_MS * 0.9);
    // A few frames of a page that draws in software.
    expect(viewMs).toBeLessThan(LOOP_MS * 0.75);
    testInfo.annotations.push({ type: 'input to view', description: `${viewMs} ms; body ${bodyMs} ms` });

    await page.keyboard.press('p');
    await expect(page.locator('#facts')).toContainText('prediction is off');
    await operator.expectFrames(10);
    const followed = await watchMotion(page);
    await operator.holdForward();
    const without = await followed();
    await operator.releaseKeys();
    await operator.expectStanding();
    expect(without.viewMs).toBeGreaterThan(LOOP_MS * 0.9);

    await page.keyboard.press('p');
    await expect(page.locator('#facts')).not.toContainText('prediction is off');
    // View and robot agree again once it stands.
    await operator.expectFrames(20);
    const [{ view: shown }, { camera }] = [await operator.state(), await operator.probe()];
    expect(Math.hypot(shown.x - (camera?.x ?? 0), shown.y - (camera?.y ?? 0))).toBeLessThan(0.03);

    // STOP is believed at once, before the robot has confirmed it.
    const stood = await operator.body();
    await operator.holdForward();
    await operator.expectMovedFrom(stood, 0.2);
    await expect.poll(async () => (await operator.state()).view.state).toBe('predicted');
    await page.keyboard.press('x');
    await expect(page.locator('#facts')).toContainText('As reported: the robot is held');
    await operator.releaseKeys();
    await operator.releaseEstop();

    const plain = await OperatorPage.open(page, stack, { robot: lightRobot.id, predict: '0' });
    await plain.expectPoints(300);
    await expect(page.locator('#facts')).toContainText('prediction is off');
  } finally {
    await link.stop();
  }
});

test('in the headset: the rig moves at once, and the wrist says that it is predicted', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [] });
  const link = await EmulatedLink.start(stack, { args: ['--rtt-ms', String(LOOP_MS)] });
  try {
    const args = [...lightRobot.args, '--signaling', link.signalingUrl];
    await stack.startRobot({ ...lightRobot, args });
    await page.setViewportSize(headsetViewport);
    const headset = await Headset.wear(page);
    const operator = await OperatorPage.open(page, stack, { robot: lightRobot.id });
    await operator.expectPoints(300);
    await enterVr(page, operator);
    const start = await operator.body();
    await operator.hold(headset.grip('right'));
    await headset.thumbstick('right', 0, -1);
    await operator.expectMovedFrom(start, 0.3);
    await expect
      .poll(async () => {
        await operator.gripAnew();
        return (await operator.state()).view.state;
      })
      .toBe('predicted');
    const lines = await page.evaluate(() => window.farpoint.wrist()?.map(({ text }) => text) ?? []);
    expect(lines.join('\n')).toMatch(/view \+\d+ ms predicted/);
    await operator.look(testInfo, 'both-eyes');
    await headset.thumbstick('right', 0, 0);
    await operator.release();
    await operator.expectStanding();
  } finally {
    await link.stop();
  }
});
