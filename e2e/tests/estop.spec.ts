import type { Page } from '@playwright/test';
import { enterVr, Headset } from '../src/headset.ts';
import { expectOnScreenAndApart } from '../src/layout.ts';
import { OperatorPage, screenSizes } from '../src/operator-page.ts';
import { expect, simulatedRobot, test } from '../src/stack-test.ts';

/** Each change of the robot's emergency stop, as recorded in its journal. */
function changes(lines: readonly string[]): boolean[] {
  return lines
    .filter((line) => line.includes('emergency stop changed'))
    .map((line) => line.includes('"latched":true'));
}

/**
 * Starts holding the release control, and lets go from within the page at a given progress: however slow the machine
 * is, the control is let go before a second has passed.
 */
function holdInPart(
  page: Page,
  by: 'key' | 'pointer',
  end: 'up' | 'slide' | 'stop',
  progress: number,
): Promise<void> {
  return page.evaluate(
    async ([by, end, progress]) => {
      const control = document.getElementById('estop-release') as HTMLElement;
      const key = (type: string, code: string) => window.dispatchEvent(new KeyboardEvent(type, { code }));
      const pointer = (type: string) => control.dispatchEvent(new PointerEvent(type, { button: 0 }));
      const shown = () => Number(getComputedStyle(control).getPropertyValue('--held'));
      if (by === 'key') key('keydown', 'KeyR');
      else pointer('pointerdown');
      while (shown() < progress) await new Promise((resolve) => setTimeout(resolve, 5));
      if (shown() >= 1) throw new Error('held to the end');
      if (end === 'stop') key('keydown', 'KeyX');
      else if (by === 'key') key('keyup', 'KeyR');
      else pointer(end === 'slide' ? 'pointerleave' : 'pointerup');
    },
    [by, end, progress] as const,
  );
}

test('STOP only latches, however it is pressed and however often; a hold of one second releases it', async ({
  page,
  startStack,
}) => {
  const lines: string[] = [];
  const stack = await startStack({ onLine: (_, line) => lines.push(line) });
  const operator = await OperatorPage.open(page, stack, { robot: simulatedRobot.id, canvas: '64x36' });
  await operator.expectPoints();
  await page.keyboard.down('Space');
  await operator.expectState('holder', 'you');
  await page.keyboard.up('Space');
  const stop = page.locator('#estop');
  const release = page.locator('#estop-release');
  await expect(release).toBeHidden();
  // Without a latched stop there is nothing to release.
  await page.keyboard.down('KeyR');
  await operator.expectFrames(18);
  await page.keyboard.up('KeyR');

  // Space on the focused button stops. It neither clicks the button nor acts as the grip.
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
    // Pressed, and then the finger slides off.
    async () => {
      await stop.hover();
      await page.mouse.down();
      await page.mouse.move(100, 100);
      await page.mouse.up();
    },
  ];
  for (const press of presses) {
    await press();
    // Longer than a second: a slow press does not release either.
    await operator.expectFrames(18);
    expect(await operator.state()).toMatchObject({ estop: true, drive: 'estop' });
  }
  expect(changes(lines)).toEqual([true]);

  // Let go early, near the end, or stopped in the middle of the hold: holding on afterwards does not release either.
  for (const progress of [0.2, 0.8]) {
    await holdInPart(page, 'key', 'up', progress);
    await holdInPart(page, 'pointer', 'up', progress);
    await holdInPart(page, 'pointer', 'slide', progress);
    await operator.expectFrames(18);
  }
  await holdInPart(page, 'key', 'stop', 0.5);
  await operator.expectFrames(30);
  await page.keyboard.down('KeyR');
  await page.keyboard.up('KeyR');
  await release.click();
  await release.press('Enter');
  expect(changes(lines)).toEqual([true]);

  // Held by key, by Enter on the control, and by pointer.
  await page.keyboard.down('KeyR');
  await operator.expectState('estop', false);
  await page.keyboard.up('KeyR');
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

test('pressing STOP just after somebody else has pressed it stops, too', async ({
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
  const otherPage = await context.newPage();
  const other = await OperatorPage.open(otherPage, stack, options);
  await other.expectPoints();
  await otherPage.keyboard.press('KeyX');
  await one.expectState('estop', true);
  await page.bringToFront();
  await page.keyboard.press('KeyX');
  await page.locator('#estop').click();
  await one.expectFrames(18);
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
    await operator.expectFrames(18);
  }
  expect(changes(lines)).toEqual([true]);
  await press(3, true);
  await operator.expectState('estop', false);
  await press(3, false);

  await enterVr(page, operator);
  await operator.expectPoints();
  for (let i = 0; i < 2; i++) {
    await headset.button('right', 'b-button', 1);
    await operator.expectState('estop', true);
    await headset.button('right', 'b-button', 0);
    await operator.expectFrames(20);
  }
  // A fist: grip and trigger together.
  await headset.button('right', 'squeeze', 1);
  await headset.button('right', 'trigger', 1);
  await operator.expectFrames(18);
  await headset.button('right', 'trigger', 0);
  await operator.expectFrames(10);
  await headset.button('right', 'squeeze', 0);
  await operator.expectFrames(10);
  expect(changes(lines)).toEqual([true, false, true]);
  await headset.place('left', [-0.05, 1.5, -0.4]);
  await headset.button('right', 'trigger', 1);
  await operator.look(testInfo, 'holding-in-the-headset');
  await operator.expectState('estop', false);
  await headset.button('right', 'trigger', 0);
  expect(changes(lines)).toEqual([true, false, true, false]);
});

test('while latched, every control is on every screen and none covers another', async ({
  openRobot,
  page,
}, testInfo) => {
  const { operator } = await openRobot();
  await page.locator('#estop').click();
  await operator.expectState('estop', true);
  for (const size of screenSizes) {
    await page.setViewportSize(size);
    await operator.expectFrames(2);
    await operator.look(testInfo, `latched-${size.width}`);
    const names = await expectOnScreenAndApart(
      page.locator('#bar button:visible, #drive button:visible, #joystick:visible, #facts, #notice:visible'),
      size,
    );
    expect(names).toEqual(expect.arrayContaining(['estop', 'estop-release']));
  }
});

test('its key works although the text field of a dialog that has just been closed has the focus', async ({
  openRobot,
  page,
}) => {
  const { operator } = await openRobot();
  await page.getByRole('button', { name: 'Settings' }).click();
  await page.getByLabel('Your name').focus();
  await page.evaluate(() => {
    const field = document.querySelector('#settings input[name=name]');
    (document.getElementById('settings') as HTMLDialogElement).close();
    // In the same task: the browser takes the focus away with the next display frame.
    if (document.activeElement !== field) throw new Error('the field has lost the focus');
    field?.dispatchEvent(new KeyboardEvent('keydown', { code: 'KeyX', bubbles: true, cancelable: true }));
  });
  await operator.expectState('estop', true);
});
