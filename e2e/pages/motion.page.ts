/** What the robot says of its own bounds on motion, in words and by sound. */
import type { MotionState } from '@farpoint/protocol';
import type { Page } from '@playwright/test';
import { headsetViewport } from '../src/headset.ts';
import { enterVr } from '../src/stage/in-headset.ts';
import { expect, test } from '../src/stage/page-test.ts';
import type { Stage } from '../src/stage/stage.ts';

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
    // A browser opens its audio device in its own time, for which the page waits before it sounds anything.
    AudioContext.prototype.resume = () => Promise.resolve();
    AudioContext.prototype.suspend = () => Promise.resolve();
    const { start } = OscillatorNode.prototype;
    OscillatorNode.prototype.start = function (this: OscillatorNode, when?: number) {
      window.sounded.push(this.frequency.value);
      start.call(this, when);
    };
  });
}

/** The tones since the last call. */
function newTones(page: Page): Promise<number[]> {
  return page.evaluate(() => window.sounded.splice(0));
}

/** The robot says this of its driver's wish from its next telemetry on. */
function bound(stage: Stage, motion: Partial<MotionState>, drive: 'driving' | 'blocked' = 'driving') {
  return stage.script(
    ({ robot }, [motion, drive]) => {
      const free = { factor: 1, reasons: [], mostLinear: 0.5, obstacleGuard: 'on' } as const;
      robot.telemetry = { drive, motion: { ...free, ...motion } };
    },
    [motion, drive] as const,
  );
}

/** Holds the grip and pushes forward. */
async function drive(stage: Stage): Promise<void> {
  await stage.page.keyboard.down('Space');
  await stage.run(100);
  await stage.page.keyboard.down('KeyW');
  await stage.run(200);
}

test('a robot that is held before something says so, in words, at the speed and at the edge of the view', async ({
  stage,
}) => {
  const page = await stage.open();
  const edge = page.locator('#blocked-edge');
  const bounded = page.locator('#motion-state');
  await drive(stage);
  await expect(bounded).toBeHidden();
  await expect(edge).toBeHidden();
  await bound(stage, { factor: 0, reasons: ['obstacle'] }, 'blocked');
  await stage.run(400);
  await expect(bounded).toHaveText('Held: something is in the way');
  await expect(page.locator('#speed')).toContainText('held: something is in the way');
  await expect(page.locator('#facts')).toContainText('Held: something is in the way');
  await expect(edge).toBeVisible();
  expect((await stage.state()).near.blocked).toBeCloseTo(0, 1);
  // Whoever looks to the left has it at the right.
  await page.mouse.move(480, 200);
  await page.mouse.down();
  await page.mouse.move(580, 200, { steps: 5 });
  await page.mouse.up();
  await stage.run(100);
  expect((await stage.state()).near.blocked).toBeLessThan(-0.2);
  await page.keyboard.up('KeyW');
  await page.keyboard.up('Space');
  await bound(stage, {});
  await stage.run(600);
  await expect(bounded).toBeHidden();
  await expect(edge).toBeHidden();
});

test('a robot that does not look, or cannot, says so all the time', async ({ stage }) => {
  const page = await stage.open({ state: 'guard-off' });
  const guard = page.locator('#obstacle-guard');
  await stage.run(300);
  await expect(guard).toHaveText('The robot does not brake for obstacles');
  await bound(stage, { obstacleGuard: 'blind' });
  await stage.run(400);
  await expect(guard).toHaveText('The robot cannot see obstacles now');
  await bound(stage, { obstacleGuard: 'on' });
  await stage.run(400);
  await expect(guard).toBeHidden();
});

test('a tone when it slows, two when it is held, three when it is stopped, and none again for a while', async ({
  stage,
}) => {
  const { page } = stage;
  await listen(page);
  await stage.open();
  await drive(stage);
  expect(await newTones(page)).toEqual([]);
  await bound(stage, { factor: 0.5, reasons: ['obstacle-near'] });
  await stage.run(100);
  expect(await newTones(page)).toEqual([660]);
  await bound(stage, { factor: 0, reasons: ['obstacle'] }, 'blocked');
  await stage.run(100);
  expect(await newTones(page)).toEqual([440, 440]);
  // It comes and goes at the edge of a zone.
  await bound(stage, {});
  await stage.run(100);
  await bound(stage, { factor: 0, reasons: ['obstacle'] }, 'blocked');
  await stage.run(100);
  expect(await newTones(page)).toEqual([]);
  await page.keyboard.press('KeyX');
  await stage.run(100);
  expect(await newTones(page)).toEqual([880, 587, 392]);
});

test('without cues, as chosen in the settings, nothing is heard', async ({ stage }) => {
  const { page } = stage;
  await listen(page);
  await stage.open({ stored: { 'farpoint.settings': { cues: false } } });
  await page.keyboard.press('KeyX');
  await stage.run(500);
  expect((await stage.state()).estop).toBe(true);
  expect(await newTones(page)).toEqual([]);
});

test('cues that are switched off in the settings are silent at once', async ({ stage }) => {
  const { page } = stage;
  await listen(page);
  await stage.open();
  await page.getByRole('button', { name: 'Settings' }).click();
  await page.getByLabel(/^Sound and vibration/).uncheck();
  await page.getByRole('button', { name: 'Save' }).click();
  await page.keyboard.press('KeyX');
  await stage.run(500);
  expect((await stage.state()).estop).toBe(true);
  expect(await newTones(page)).toEqual([]);
});

test.describe('in the headset', () => {
  test.use({ viewport: headsetViewport });

  test('the controllers vibrate when the robot is stopped', async ({ stage }) => {
    const { page } = stage;
    await listen(page);
    const headset = await enterVr(stage);
    await page.evaluate(() => {
      const { controllers } = window.emulatedHeadset;
      for (const hand of ['left', 'right'] as const) {
        const [actuator] = controllers[hand]?.inputSource.gamepad?.hapticActuators ?? [];
        if (actuator === undefined) throw new Error(`the ${hand} controller cannot vibrate`);
        actuator.pulse = (strength, ms) => {
          window.felt.push([strength, ms]);
          return Promise.resolve(true);
        };
      }
    });
    await headset.button('right', 'b-button', 1);
    await stage.run(100);
    expect(await page.evaluate(() => window.felt)).toEqual([
      [1, 400],
      [1, 400],
    ]);
  });
});
