/** The operator hears and feels that the robot does less than it is told, wherever they look. */
import type { Page } from '@playwright/test';
import { enterVr, Headset, headsetViewport } from '../src/headset.ts';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';

declare global {
  interface Window {
    /** Frequencies that the page has sounded, Hz. */
    sounded: number[];
    /** Strength and length, ms, of what the controllers were told. */
    felt: (readonly [number, number])[];
  }
}

/** Call this before the page loads. */
async function listen(page: Page): Promise<void> {
  await page.addInitScript(() => {
    window.sounded = [];
    window.felt = [];
    const { start } = OscillatorNode.prototype;
    OscillatorNode.prototype.start = function (this: OscillatorNode, when?: number) {
      if (this.context.state === 'running') window.sounded.push(this.frequency.value);
      start.call(this, when);
    };
  });
}

test.use({ viewport: headsetViewport });

const sounded = (page: Page) => page.evaluate(() => window.sounded);

test('driven against a wall: a tone when it slows, two when it is held; three when it is stopped', async ({
  page,
  startStack,
}) => {
  await listen(page);
  const stack = await startStack({ robots: [lightRobot] });
  const operator = await OperatorPage.open(page, stack, { robot: 'sim-1' });
  await operator.expectPoints(300);
  await operator.holdForward();
  const bounded = page.locator('#motion-state');
  await expect
    .poll(
      async () => {
        await operator.gripAnew();
        return bounded.textContent();
      },
      { intervals: [100] },
    )
    .toBe('Held: something is in the way');
  await expect.poll(async () => (await sounded(page)).slice(-2)).toEqual([440, 440]);
  expect(await sounded(page)).toContain(660);
  await operator.releaseKeys();
  await operator.expectStanding();

  await page.keyboard.press('x');
  await expect.poll(async () => (await sounded(page)).slice(-3)).toEqual([880, 587, 392]);
});

test('in the headset, the controllers vibrate when the robot is stopped', async ({ page, startStack }) => {
  await listen(page);
  const stack = await startStack({ robots: [lightRobot] });
  const headset = await Headset.wear(page);
  const operator = await OperatorPage.open(page, stack, { robot: 'sim-1' });
  await operator.expectPoints(300);
  await enterVr(page, operator);
  await operator.expectPoints(300);
  await page.evaluate(() => {
    const { controllers } = window.emulatedHeadset;
    for (const hand of ['left', 'right'] as const) {
      const [actuator] = controllers[hand]?.inputSource.gamepad?.hapticActuators ?? [];
      if (actuator === undefined) throw new Error(`the ${hand} controller cannot vibrate`);
      const pulse = actuator.pulse.bind(actuator);
      actuator.pulse = (strength, ms) => {
        window.felt.push([strength, ms]);
        return pulse(strength, ms);
      };
    }
  });
  await headset.button('right', 'b-button', 1);
  await operator.expectState('estop', true);
  await expect
    .poll(() => page.evaluate(() => window.felt))
    .toEqual([
      [1, 400],
      [1, 400],
    ]);
});

test('with ?cues=0 nothing is heard', async ({ page, startStack }) => {
  await listen(page);
  const stack = await startStack({ robots: [lightRobot] });
  const operator = await OperatorPage.open(page, stack, { robot: 'sim-1', cues: '0' });
  await operator.expectPoints(300);
  await page.keyboard.press('x');
  await operator.expectState('estop', true);
  expect(await sounded(page)).toEqual([]);
});
