/** Keys, gamepads, wheels and joysticks as the operator chooses them, and how fast they drive. */
import type { Page } from '@playwright/test';
import { Devices } from '../src/stage/devices.ts';
import { expect, test } from '../src/stage/page-test.ts';
import type { Stage } from '../src/stage/stage.ts';

const JOYSTICK = 'Flight stick (Vendor: 06a3 Product: 0c2d)';
/** Two readings of the devices by the dialog, ms. */
const READ_MS = 120;

async function openDialog(page: Page): Promise<void> {
  await page.getByRole('button', { name: 'Settings' }).click();
  await page.getByRole('button', { name: 'Inputs…' }).click();
}

/** Closes the dialog and the settings beneath. */
async function closeDialog(page: Page): Promise<void> {
  await page.locator('#inputs').getByRole('button', { name: 'Close' }).click();
  await page.locator('#settings').getByRole('button', { name: 'Cancel' }).click();
}

/** The velocity that was commanded last while a grip was held; `null` if none was. */
async function driven(stage: Stage): Promise<{ x: number; z: number } | null> {
  const command = (await stage.sent('command')).at(-1);
  return command?.deadMan === true ? { x: command.twist.linear.x, z: command.twist.angular.z } : null;
}

test('a joystick that nobody knows does nothing until it is set up; then it drives, and unplugged it lets go', async ({
  stage,
}) => {
  const devices = await Devices.install(stage.page);
  const page = await stage.open();
  // Axis 2 is a throttle that rests at its end.
  await devices.plugIn(JOYSTICK, '', [0, 0, 1], [0, 4, 5, 6, 7]);
  await devices.move(1, -1);
  await stage.run(500);
  await expect(page.locator('#notice')).toHaveText(
    'Flight stick does not drive yet. Set it up: Settings, Inputs.',
  );
  expect(await driven(stage)).toBe(null);
  for (const button of [0, 4, 5, 6, 7]) await devices.press(button, false);
  await devices.move(1, 0);

  await openDialog(page);
  const dialog = page.locator('#inputs');
  const said = dialog.locator('.said');
  await stage.run(READ_MS);
  await expect(dialog).toContainText('It does not drive: this browser does not know');
  await dialog.getByRole('button', { name: 'Set up Flight stick' }).click();
  const save = dialog.getByRole('button', { name: 'Save: Flight stick' });
  await expect(save).toBeDisabled();
  await expect(dialog).toContainText('without a grip that is held, nothing drives');
  const learnAxis = async (role: string, axis: number, to: number, rest: number) => {
    await dialog.getByRole('button', { name: `${role}: set the axis` }).click();
    for (const value of [to, rest]) {
      await devices.move(axis, value);
      await stage.run(READ_MS);
    }
  };
  await learnAxis('Forward and backward', 2, -1, 1);
  await expect(said).toHaveText('Axis 3 was found. Not saved yet.');
  await learnAxis('Turn', 0, -0.8, 0);
  const addButton = async (role: string, button: number) => {
    await dialog.getByRole('button', { name: `${role}: add a button` }).click();
    for (const pressed of [true, false]) {
      await devices.press(button, pressed);
      await stage.run(READ_MS);
    }
  };
  await addButton('STOP', 3);
  await expect(save).toBeDisabled();
  await addButton('Grip (hold to drive)', 0);
  await addButton('Release STOP (hold)', 0);
  await expect(said).toHaveText('Button 1 is taken: Grip (hold to drive). Remove it there first.');
  await expect(save).toBeEnabled();
  // Whoever tries it here does not drive.
  await devices.press(0, true);
  await devices.move(2, -1);
  await stage.run(500);
  await expect(dialog.locator('.live')).toContainText('forward 1.00, left 0.00, grip held');
  await save.click();
  await expect(said).toHaveText('Flight stick is set up. Open its grip before you drive.');
  await stage.run(500);
  expect(await driven(stage)).toBe(null);
  await closeDialog(page);
  await stage.run(500);
  expect(await driven(stage)).toBe(null);

  await devices.press(0, false);
  // A throttle counts once it has been seen at its rest.
  await devices.move(2, 1);
  await stage.run(100);
  await devices.press(0, true);
  await devices.move(2, -1);
  await stage.run(500);
  expect(await driven(stage)).toEqual({ x: 0.5, z: 0 });
  await devices.unplug();
  await stage.run(200);
  expect(await driven(stage)).toBe(null);
  await expect(page.locator('#notice')).toHaveText('Flight stick is gone: it has let go.');
  await devices.plugIn(JOYSTICK, '', [0, 0, -1], [0]);
  await stage.run(500);
  expect(await driven(stage)).toBe(null);

  // Its button stops, and what was chosen is there after the page was loaded anew.
  await stage.reload();
  await devices.plugIn(JOYSTICK, '', [0, 0, 1]);
  await stage.run(100);
  await devices.press(0, true);
  await devices.move(2, -1);
  await stage.run(500);
  expect(await driven(stage)).toEqual({ x: 0.5, z: 0 });
  await devices.press(3, true);
  await stage.run(200);
  expect((await stage.state()).estop).toBe(true);
});

test('keys are chosen by keyboard alone: what is taken is refused, STOP works meanwhile, and the page names the new keys', async ({
  stage,
}) => {
  const page = await stage.open();
  const { keyboard } = page;
  await page.locator('#settings-open').focus();
  await keyboard.press('Enter');
  await page.locator('#inputs-open').focus();
  await keyboard.press('Enter');
  const dialog = page.locator('#inputs');
  const said = dialog.locator('.said');
  const add = dialog.getByRole('button', { name: 'Forward: add a key' });
  // All is reached by Tab, and nothing behind the dialog is.
  for (let presses = 0; !(await add.evaluate((button) => button === document.activeElement)); presses++) {
    expect(presses).toBeLessThan(40);
    await keyboard.press('Tab');
    expect(await page.evaluate(() => document.activeElement?.closest('#inputs, #stop, body'))).not.toBe(null);
  }
  await expect(add).toBeInViewport();
  const choose = async (key: string) => {
    await add.focus();
    await keyboard.press('Enter');
    await expect(said).toHaveText('Forward: press the key. Escape cancels.');
    await keyboard.press(key);
  };
  await choose('KeyR');
  await expect(said).toHaveText('R is taken: Release STOP (hold). Remove it there first.');
  await choose('Tab');
  await expect(said).toHaveText('Tab is needed to use the page without a mouse: choose another key.');
  await choose('Escape');
  await expect(said).toHaveText('Nothing was changed.');
  await expect(dialog).toBeVisible();
  await dialog.getByRole('button', { name: 'STOP: remove X' }).press('Enter');
  await expect(said).toHaveText('STOP needs a key: add another one first.');
  await choose('F9');
  await expect(said).toHaveText('F9 always stops the robot and has no other use.');
  await stage.run(200);
  expect((await stage.state()).estop).toBe(true);
  await dialog.getByRole('button', { name: 'Forward: remove W' }).press('Enter');
  await choose('KeyI');
  await expect(said).toHaveText('Saved.');
  // What had the focus keeps it.
  await expect(add).toBeFocused();
  await dialog.getByRole('button', { name: 'Latency test: remove L' }).press('Enter');
  await dialog.getByRole('button', { name: 'Latency test: add a key' }).press('Enter');
  await keyboard.press('KeyQ');
  await keyboard.press('Escape');
  await keyboard.press('Escape');
  await expect(page.locator('#settings')).toBeHidden();
  await expect(page.locator('#drive-hint')).toContainText('drive with IASD');
  await expect(page.locator('#latency')).toHaveAttribute('title', /\(Q\)$/);

  await stage.reload();
  await keyboard.down('Space');
  await keyboard.down('KeyW');
  await stage.run(500);
  expect(await driven(stage)).toEqual({ x: 0, z: 0 });
  await keyboard.down('KeyI');
  await stage.run(200);
  expect((await driven(stage))?.x).toBe(0.5);
});

test('with the keys of one hand that hand drives, stops and changes gears', async ({ stage }) => {
  const page = await stage.open();
  await openDialog(page);
  await page.getByRole('combobox', { name: 'Keys for' }).selectOption('right');
  await expect(page.locator('#inputs .said')).toHaveText('Keys for the right hand alone. Saved.');
  await closeDialog(page);
  await expect(page.locator('#drive-hint')).toContainText('Hold Space and drive with IJKL');
  const { keyboard } = page;
  await keyboard.press('Comma');
  await keyboard.down('Numpad0');
  await keyboard.down('Numpad8');
  await stage.run(500);
  expect((await driven(stage))?.x).toBeCloseTo(0.375);
  await keyboard.press('KeyN');
  await stage.run(200);
  expect((await stage.state()).estop).toBe(true);
});

test('the greatest speed is chosen by key, button and slider, said with its value, and kept', async ({
  stage,
}) => {
  const page = await stage.open();
  const gear = page.locator('#speed-choice .gear');
  await expect(gear).toHaveText('100 % · 0.50 m/s');
  for (let i = 0; i < 3; i++) await page.keyboard.press('BracketLeft');
  await expect(page.locator('#notice')).toHaveText('Greatest speed: 25 % · 0.13 m/s');
  await expect(gear).toHaveText('25 % · 0.13 m/s');
  await page.keyboard.down('Space');
  await page.keyboard.down('KeyW');
  await stage.run(500);
  expect((await driven(stage))?.x).toBe(0.125);
  await page.keyboard.up('KeyW');
  await page.keyboard.up('Space');
  await gear.click();
  await expect(gear).toHaveText(/^50 %/);
  // A slider that has the focus takes no key from driving but its own.
  const slider = page.locator('#speed-choice input');
  await slider.focus();
  await page.keyboard.press('ArrowRight');
  await expect(gear).toHaveText(/^55 %/);
  await page.keyboard.down('Space');
  await page.keyboard.down('KeyW');
  await stage.run(500);
  expect((await driven(stage))?.x).toBeCloseTo(0.275);
  await stage.reload();
  await expect(gear).toHaveText(/^55 %/);
});

test('Tab reaches everything that can be pressed, and the focus is seen', async ({ stage }) => {
  const page = await stage.open({ state: 'everything', canvas: '64x36', forMs: 1500 });
  const wanted = await page.evaluate(() => {
    const all = document.querySelectorAll<HTMLButtonElement>(
      'button, select, input, summary, canvas[tabindex]',
    );
    const shown = [...all].filter(
      (each) => !each.disabled && each.checkVisibility({ visibilityProperty: true }),
    );
    for (const [i, each] of shown.entries()) each.dataset.tab = String(i);
    return shown.length;
  });
  expect(wanted).toBeGreaterThan(15);
  const reached = new Set<string>();
  for (let presses = 0; presses < 3 * wanted && reached.size < wanted; presses++) {
    await page.keyboard.press('Tab');
    const at = await page.evaluate(() => {
      const element = document.activeElement as HTMLElement | null;
      const { outlineStyle, outlineWidth } = getComputedStyle(element ?? document.body);
      const isSeen = outlineStyle !== 'none' && Number.parseFloat(outlineWidth) >= 2;
      return { tab: element?.dataset.tab, isSeen, name: element?.id ?? '' };
    });
    if (at.tab === undefined) continue;
    expect(at.isSeen, at.name).toBe(true);
    reached.add(at.tab);
  }
  expect(reached.size).toBe(wanted);
});
