import type { Page } from '@playwright/test';
import { Headset, headsetViewport } from '../src/headset.ts';
import { expect, test } from '../src/stage/page-test.ts';
import type { Stage } from '../src/stage/stage.ts';

/** How long the control is held to release, ms, and the interval at which the page looks at it. */
const [HOLD_MS, READ_EVERY_MS] = [1000, 25];
/** Longer than a hold. */
const LONG_MS = 1200;

/** The releases that the page has asked for since its messages were last forgotten. */
async function releases(stage: Stage) {
  return (await stage.sent('estop')).filter((message) => 'latch' in message && !message.latch);
}

/** The presses of STOP that the page has sent, without the repeats of each, since its messages were last forgotten. */
async function presses(stage: Stage): Promise<number> {
  const sent = await stage.sent('estop');
  const numbers = sent.flatMap((message) => ('latch' in message && !message.latch ? [] : [message.press]));
  return new Set(numbers).size;
}

/** The robot counts every press. */
const latch = (stage: Stage) => stage.script(({ robot }) => robot.estop.latch);

test('every press of STOP stops, wherever the focus is, and none releases', async ({ stage }) => {
  const page = await stage.open({ state: 'driving' });
  const stop = page.locator('#estop');
  const release = page.locator('#estop-release');
  await expect(release).toBeHidden();
  // Without a latched stop there is nothing to release.
  await page.keyboard.down('KeyR');
  await stage.run(LONG_MS);
  await page.keyboard.up('KeyR');
  expect(await releases(stage)).toEqual([]);

  // Space on the focused button stops. It neither clicks the button nor acts as the grip.
  await stop.focus();
  await page.keyboard.down('Space');
  await stage.run(100);
  expect(await stage.state()).toMatchObject({ estop: true, driving: false, drive: 'estop' });
  await page.keyboard.up('Space');
  await stage.run(300);
  await expect(release).toBeVisible();
  const acts: Readonly<Record<string, () => Promise<void>>> = {
    'the key X': () => page.keyboard.press('KeyX'),
    'a click': () => stop.click(),
    'Space on the button': () => stop.press('Space'),
    'Enter on the button': () => stop.press('Enter'),
    'Space on the release control': () => release.press('Space'),
    'X on another button': () => page.locator('#settings-open').press('KeyX'),
    'a finger that slides off': async () => {
      await stop.hover();
      await page.mouse.down();
      await page.mouse.move(100, 100);
      await page.mouse.up();
    },
  };
  for (const [what, press] of Object.entries(acts)) {
    await stage.forget();
    await press();
    await stage.run(LONG_MS);
    expect(await presses(stage), what).toBeGreaterThanOrEqual(1);
    expect(await releases(stage), what).toEqual([]);
    expect(await stage.state(), what).toMatchObject({ estop: true, drive: 'estop' });
  }
  // A short press of the control releases nothing, and stops nothing.
  await stage.forget();
  await release.press('Enter');
  await release.click();
  await page.keyboard.press('KeyR');
  await stage.run(LONG_MS);
  expect(await stage.sent('estop')).toEqual([]);
});

/** A way to hold the release control. */
interface Hold {
  down(page: Page): Promise<void>;
  up(page: Page): Promise<void>;
}

const holds: Readonly<Record<string, Hold>> = {
  'the key R': {
    down: (page) => page.keyboard.down('KeyR'),
    up: (page) => page.keyboard.up('KeyR'),
  },
  'Enter on the control': {
    async down(page) {
      await page.locator('#estop-release').focus();
      await page.keyboard.down('Enter');
    },
    up: (page) => page.keyboard.up('Enter'),
  },
  'the pointer': {
    async down(page) {
      await page.locator('#estop-release').hover();
      await page.mouse.down();
    },
    up: (page) => page.mouse.up(),
  },
  'the pointer, which slides off': {
    async down(page) {
      await page.locator('#estop-release').hover();
      await page.mouse.down();
    },
    async up(page) {
      await page.mouse.move(100, 100);
      await page.mouse.up();
    },
  },
};

for (const [what, { down, up }] of Object.entries(holds)) {
  test(`held by ${what}: let go or stopped before a second it releases nothing, at a second it does`, async ({
    stage,
  }) => {
    const page = await stage.open({ state: 'stop-latched' });
    await stage.forget();
    for (const ms of [200, HOLD_MS - 1]) {
      await down(page);
      await stage.run(ms);
      await up(page);
      await stage.run(LONG_MS);
    }
    expect(await releases(stage)).toEqual([]);
    // STOP in the middle of a hold: to hold on afterwards does not release either.
    await down(page);
    await stage.run(HOLD_MS / 2);
    await page.keyboard.press('KeyX');
    await stage.run(2 * LONG_MS);
    expect(await releases(stage)).toEqual([]);
    await up(page);
    await stage.run(100);

    await down(page);
    await stage.run(HOLD_MS + 2 * READ_EVERY_MS);
    expect(await releases(stage)).toEqual([{ type: 'estop', latch: false, of: 2 }]);
    await up(page);
    await stage.run(300);
    await expect(page.locator('#estop-release')).toBeHidden();
  });
}

test('STOP just after somebody else has pressed it is a press of its own, and a release means what is shown', async ({
  stage,
}) => {
  const page = await stage.open();
  await stage.script(({ robot }) => robot.stop({ latched: true, by: 'operator', latch: 1 }));
  await page.keyboard.press('KeyX');
  await stage.run(100);
  expect(await latch(stage)).toBe(2);
  // Somebody presses again while the control is held: what was not shown when the hold began is released by nobody.
  await page.keyboard.down('KeyR');
  await stage.run(HOLD_MS + READ_EVERY_MS);
  await page.keyboard.up('KeyR');
  expect((await releases(stage)).at(-1)).toEqual({ type: 'estop', latch: false, of: 2 });
});

test('a stop at the robot itself is released there only, and the page says so', async ({ stage }) => {
  const page = await stage.open({ state: 'stopped-at-robot' });
  const release = page.locator('#estop-release');
  await stage.forget();
  await expect(release).toBeVisible();
  await expect(release).toBeDisabled();
  await expect(release).toHaveText(/^\s*Release at robot\s*a stop there is on\s*$/, { useInnerText: true });
  await expect(page.locator('#facts')).toContainText('released at the robot only');
  await page.keyboard.down('KeyR');
  await stage.run(LONG_MS);
  await page.keyboard.up('KeyR');
  expect(await stage.sent('estop')).toEqual([]);

  // The operator's own STOP remains once the robot's side has let go.
  await page.locator('#estop').click();
  await stage.run(300);
  await expect(page.locator('#stop-state')).toHaveText('STOP confirmed');
  await stage.script(({ robot }) => robot.stop({ releasedAt: undefined }));
  await stage.run(300);
  await expect(release).toBeEnabled();
  await expect(release).toHaveText(/Hold to release/);
  await page.keyboard.down('KeyR');
  await stage.run(LONG_MS);
  await page.keyboard.up('KeyR');
  await expect(release).toBeHidden();
  await expect(page.locator('#stop-state')).toBeHidden();
});

test('on a gamepad, B stops, and Y held for a second releases', async ({ stage }) => {
  const { page } = stage;
  await page.addInitScript(() => {
    const buttons = Array.from({ length: 17 }, () => ({ pressed: false, touched: false, value: 0 }));
    const pad = { mapping: 'standard', axes: [0, 0, 0, 0], buttons };
    Object.assign(window, { pad });
    navigator.getGamepads = () => [pad as never];
  });
  await stage.open();
  const press = (index: number, pressed: boolean) =>
    page.evaluate(
      ([index, pressed]) => {
        const { pad } = window as unknown as { pad: { buttons: { pressed: boolean; value: number }[] } };
        Object.assign(pad.buttons[index]!, { pressed, value: Number(pressed) });
      },
      [index, pressed] as const,
    );
  for (const count of [1, 2]) {
    await press(1, true);
    await stage.run(LONG_MS);
    await press(1, false);
    await stage.run(100);
    expect(await latch(stage)).toBe(count);
  }
  await press(3, true);
  await stage.run(HOLD_MS - READ_EVERY_MS);
  await press(3, false);
  await stage.run(100);
  expect(await releases(stage)).toEqual([]);
  await press(3, true);
  await stage.run(HOLD_MS + 2 * READ_EVERY_MS);
  expect(await releases(stage)).toEqual([{ type: 'estop', latch: false, of: 2 }]);
});

test.describe('in the headset', () => {
  test.use({ viewport: headsetViewport });

  test('B stops, a fist releases nothing, and the trigger held for a second releases', async ({ stage }) => {
    const { page } = stage;
    const headset = await Headset.wear(page);
    await stage.open({ canvas: '64x36' });
    await page.getByRole('button', { name: /VR/ }).click();
    await stage.frames(10);
    expect((await stage.state()).vr).toBe(true);
    await headset.button('right', 'b-button', 1);
    await stage.run(LONG_MS);
    await headset.button('right', 'b-button', 0);
    await stage.run(100);
    expect(await latch(stage)).toBe(1);
    // A fist: grip and trigger together.
    await headset.button('right', 'squeeze', 1);
    await headset.button('right', 'trigger', 1);
    await stage.run(LONG_MS);
    await headset.button('right', 'trigger', 0);
    await headset.button('right', 'squeeze', 0);
    await stage.run(100);
    await headset.button('right', 'trigger', 1);
    await stage.run(HOLD_MS - 2 * READ_EVERY_MS);
    await headset.button('right', 'trigger', 0);
    await stage.run(100);
    expect(await releases(stage)).toEqual([]);
    await headset.button('right', 'trigger', 1);
    await stage.run(HOLD_MS + 3 * READ_EVERY_MS);
    expect(await releases(stage)).toEqual([{ type: 'estop', latch: false, of: 1 }]);
    expect((await stage.state()).estop).toBe(false);
  });
});
