import type { Page } from '@playwright/test';
import { Headset } from '../src/headset.ts';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, simulatedRobot, test } from '../src/stack-test.ts';

/** Each change of the robot's emergency stop, as its own journal has it. */
function changes(lines: readonly string[]): boolean[] {
  return lines
    .filter((line) => line.includes('emergency stop changed'))
    .map((line) => line.includes('"latched":true'));
}

/** How far the hold has come, as the page shows it. */
const shownProgress = (page: Page) =>
  page
    .locator('#estop-release')
    .evaluate((control) => Number(getComputedStyle(control).getPropertyValue('--held')));

async function expectProgress(page: Page, least: number): Promise<void> {
  await expect
    .poll(() => shownProgress(page), { message: 'progress', intervals: [20] })
    .toBeGreaterThan(least);
}

test('STOP only ever latches, however it is pressed and however often; a hold of a second releases it', async ({
  page,
  startStack,
}, testInfo) => {
  const lines: string[] = [];
  const stack = await startStack({ onLine: (_, line) => lines.push(line) });
  const operator = await OperatorPage.open(page, stack, { robot: simulatedRobot.id });
  await operator.expectPoints();
  await page.keyboard.down('Space');
  await operator.expectState('holder', 'you');
  await page.keyboard.up('Space');
  const stop = page.locator('#estop');
  const release = page.locator('#estop-release');
  await expect(release).toBeHidden();
  // Without a stop there is nothing to release.
  await page.keyboard.down('KeyR');
  await operator.expectFrames(40);
  await page.keyboard.up('KeyR');

  // Space on the focused button stops; it neither clicks nor grips.
  await stop.focus();
  await page.keyboard.down('Space');
  await operator.expectState('estop', true);
  expect((await operator.state()).driving).toBe(false);
  await page.keyboard.up('Space');
  await expect(release).toBeVisible();
  const presses: (() => Promise<void>)[] = [
    () => page.keyboard.press('KeyX'),
    () => page.keyboard.press('KeyX'),
    () => stop.click(),
    () => stop.click(),
    () => stop.press('Space'),
    () => stop.press('Enter'),
    () => release.press('Space'),
    () => page.locator('#settings-open').press('KeyX'),
    // Pressed, and the finger slides off.
    async () => {
      await stop.hover();
      await page.mouse.down();
      await page.mouse.move(100, 100);
      await page.mouse.up();
    },
  ];
  for (const press of presses) {
    await press();
    // More than a second: a calm press is no release either.
    await operator.expectFrames(35);
    expect(await operator.state()).toMatchObject({ estop: true, drive: 'estop' });
  }
  expect(changes(lines)).toEqual([true]);
  await operator.screenshot(testInfo, 'latched');

  // Let go early: by key, by pointer, by a finger that slides off.
  await page.keyboard.down('KeyR');
  await expectProgress(page, 0.3);
  await operator.screenshot(testInfo, 'holding');
  await page.keyboard.up('KeyR');
  await release.hover();
  await page.mouse.down();
  await expectProgress(page, 0.3);
  await page.mouse.up();
  await release.hover();
  await page.mouse.down();
  await expectProgress(page, 0.1);
  await page.mouse.move(100, 100);
  await operator.expectFrames(40);
  await page.mouse.up();
  await release.click();
  await release.press('Enter');
  // Stop in the middle of a hold ends it for good.
  await page.keyboard.down('KeyR');
  await expectProgress(page, 0.2);
  await page.keyboard.press('KeyX');
  await operator.expectFrames(60);
  await page.keyboard.up('KeyR');
  expect(changes(lines)).toEqual([true]);

  // Held: by key, by Enter on the control, by pointer.
  await operator.releaseEstop();
  expect(changes(lines)).toEqual([true, false]);
  await page.keyboard.press('KeyX');
  await expect(release).toBeVisible();
  await release.focus();
  await page.keyboard.down('Enter');
  await operator.expectState('estop', false);
  await page.keyboard.up('Enter');
  await stop.click();
  await release.hover();
  await page.mouse.down();
  await operator.expectState('estop', false);
  await page.mouse.up();
  await expect(release).toBeHidden();
  expect(changes(lines)).toEqual([true, false, true, false, true, false]);
});

test('whoever presses STOP just after somebody else’s press stops, too', async ({
  page,
  context,
  startStack,
}) => {
  const lines: string[] = [];
  const stack = await startStack({ onLine: (_, line) => lines.push(line) });
  const options = { robot: simulatedRobot.id, canvas: '64x36' };
  const one = await OperatorPage.open(page, stack, options);
  await one.expectPoints();
  await page.keyboard.down('Space');
  await one.expectState('holder', 'you');
  await page.keyboard.up('Space');
  const other = await OperatorPage.open(await context.newPage(), stack, options);
  await other.expectPoints();
  await other.page.keyboard.press('KeyX');
  await one.expectState('estop', true);
  await page.bringToFront();
  await page.keyboard.press('KeyX');
  await page.locator('#estop').click();
  await one.expectFrames(40);
  expect(changes(lines)).toEqual([true]);
});

test('on a gamepad and in the headset: B stops, another button held releases', async ({
  page,
  startStack,
}, testInfo) => {
  const lines: string[] = [];
  const stack = await startStack({ onLine: (_, line) => lines.push(line) });
  await page.addInitScript(() => {
    const buttons = Array.from({ length: 17 }, () => ({ pressed: false, touched: false, value: 0 }));
    const pad = { mapping: 'standard', axes: [0, 0, 0, 0], buttons };
    Object.assign(window, { pad });
    navigator.getGamepads = () => [pad as never];
  });
  const press = (index: number, pressed: boolean) =>
    page.evaluate(
      ([index, pressed]) => {
        const { pad } = window as unknown as { pad: { buttons: { pressed: boolean; value: number }[] } };
        Object.assign(pad.buttons[index]!, { pressed, value: Number(pressed) });
      },
      [index, pressed] as const,
    );
  const headset = await Headset.wear(page);
  const operator = await OperatorPage.open(page, stack, { robot: simulatedRobot.id });
  await operator.expectPoints();
  await press(5, true);
  await operator.expectState('holder', 'you');
  await press(5, false);
  for (let i = 0; i < 2; i++) {
    await press(1, true);
    await operator.expectState('estop', true);
    await press(1, false);
    await operator.expectFrames(35);
  }
  expect(changes(lines)).toEqual([true]);
  await press(3, true);
  await operator.expectState('estop', false);
  await press(3, false);

  await page.getByRole('button', { name: /VR/ }).click();
  await operator.expectState('vr', true);
  await operator.expectPoints();
  for (let i = 0; i < 2; i++) {
    await headset.button('right', 'b-button', 1);
    await operator.expectState('estop', true);
    await headset.button('right', 'b-button', 0);
    await operator.expectFrames(20);
  }
  // A fist.
  await headset.button('right', 'squeeze', 1);
  await headset.button('right', 'trigger', 1);
  await operator.expectFrames(40);
  await headset.button('right', 'squeeze', 0);
  await headset.button('right', 'trigger', 0);
  await operator.expectFrames(10);
  expect(changes(lines)).toEqual([true, false, true]);
  await headset.place('left', [-0.05, 1.5, -0.4]);
  await headset.button('right', 'trigger', 1);
  await operator.screenshot(testInfo, 'holding-in-the-headset');
  await operator.expectState('estop', false);
  await headset.button('right', 'trigger', 0);
  expect(changes(lines)).toEqual([true, false, true, false]);
});

for (const [width, height] of [
  [360, 740],
  [1280, 720],
  [3840, 2160],
] as const) {
  test(`latched, every control is on a screen ${width} wide and none covers another`, async ({
    browser,
    startStack,
  }, testInfo) => {
    const stack = await startStack();
    const context = await browser.newContext({ viewport: { width, height }, hasTouch: width < 400 });
    const page = await context.newPage();
    try {
      const operator = await OperatorPage.open(page, stack, { robot: simulatedRobot.id });
      await operator.expectPoints();
      await page.locator('#estop').click();
      await operator.expectState('estop', true);
      await operator.screenshot(testInfo, `latched-${width}`);
      const boxes = await page
        .locator('#bar button:visible, #drive button:visible, #joystick:visible, #facts, #notice:visible')
        .evaluateAll((elements) =>
          elements.map((element) => {
            const { left, top, right, bottom } = element.getBoundingClientRect();
            return { name: element.id, left, top, right, bottom };
          }),
        );
      expect(boxes.map(({ name }) => name)).toEqual(expect.arrayContaining(['estop', 'estop-release']));
      for (const [i, box] of boxes.entries()) {
        expect(box.right, box.name).toBeLessThanOrEqual(width);
        expect(box.left, box.name).toBeGreaterThanOrEqual(0);
        expect(box.bottom, box.name).toBeLessThanOrEqual(height);
        for (const other of boxes.slice(i + 1)) {
          const apart =
            box.right <= other.left ||
            other.right <= box.left ||
            box.bottom <= other.top ||
            other.bottom <= box.top;
          expect(apart, `${box.name} and ${other.name}`).toBe(true);
        }
      }
    } finally {
      await context.close();
    }
  });
}
