/** Keys, gamepads, wheels and joysticks as the operator chooses them, and how fast they drive. */
import type { Page } from '@playwright/test';
import { Controllers } from '../src/controllers.ts';
import { expectOnScreenAndApart } from '../src/layout.ts';
import { OperatorPage, screenSizes } from '../src/operator-page.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';

const JOYSTICK = 'Flight stick (Vendor: 06a3 Product: 0c2d)';
const options = { robot: lightRobot.id, canvas: '64x36' };

async function openDialog(page: Page): Promise<void> {
  await page.getByRole('button', { name: 'Settings' }).click();
  await page.getByRole('button', { name: 'Keys and controllers…' }).click();
}

/** Closes the dialog and the settings beneath. */
async function closeDialog(page: Page): Promise<void> {
  await page.locator('#inputs').getByRole('button', { name: 'Close' }).click();
  await page.locator('#settings').getByRole('button', { name: 'Cancel' }).click();
}

test('a joystick that nobody knows does nothing until it is set up; then it drives, and unplugged it lets go', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [lightRobot] });
  const controllers = await Controllers.install(page);
  const operator = await OperatorPage.open(page, stack, options);
  await operator.expectPoints(100);
  // Axis 2 is a throttle that rests at its end.
  await controllers.plugIn(JOYSTICK, '', [0, 0, 1]);
  await expect(page.locator('#notice')).toContainText('Flight stick: choose what it does');
  for (const button of [4, 5, 6, 7]) await controllers.press(button, true);
  await controllers.move(1, -1);
  await operator.expectFrames(20);
  expect(await operator.state()).toMatchObject({ driving: false, holder: 'nobody' });
  for (const button of [4, 5, 6, 7]) await controllers.press(button, false);
  await controllers.move(1, 0);

  await openDialog(page);
  const dialog = page.locator('#inputs');
  const said = page.locator('#inputs-said');
  await expect(dialog).toContainText('It does nothing until then');
  const moveAndLetGo = async (axis: number, to: number, rest: number) => {
    await controllers.move(axis, to);
    await expect(dialog.locator('.live')).toContainText(`${to.toFixed(2)}`);
    await controllers.move(axis, rest);
  };
  await dialog.getByRole('button', { name: 'Forward: set the axis' }).click();
  await moveAndLetGo(2, -1, 1);
  await expect(said).toHaveText('Axis 3. Saved.');
  await dialog.getByRole('button', { name: 'Left: set the axis' }).click();
  await moveAndLetGo(0, -0.8, 0);
  await expect(said).toHaveText('Axis 1. Saved.');
  const addButton = async (role: string, button: number) => {
    await dialog.getByRole('button', { name: `${role}: add a button` }).click();
    await controllers.press(button, true);
    await expect(said).not.toHaveText(/press the button/);
    await controllers.press(button, false);
  };
  await addButton('Grip (hold to drive)', 0);
  await addButton('STOP', 3);
  await addButton('Release STOP (hold)', 0);
  await expect(said).toHaveText('Button 1 is taken: Grip (hold to drive). Remove it there first.');
  await dialog.getByRole('button', { name: 'STOP: remove button 4' }).click();
  await expect(said).toHaveText('Button 4 keeps stopping the robot. Others can be added to it.');
  await operator.screenshots(page, testInfo, 'joystick');
  // It is set up; whoever moves it here does not drive.
  await controllers.press(0, true);
  await controllers.move(2, -1);
  await expect(dialog.locator('.live')).toContainText('Forward 1.00');
  await operator.expectFrames(20);
  expect((await operator.state()).driving).toBe(false);
  await closeDialog(page);
  // The button that became STOP has stopped at once.
  await operator.expectState('estop', true);
  await operator.releaseEstop();
  // The grip must be opened first.
  await operator.expectFrames(20);
  expect((await operator.state()).driving).toBe(false);

  const grip = {
    hold: () => controllers.press(0, true),
    release: () => controllers.press(0, false),
  };
  await grip.release();
  await operator.expectFrames(10);
  const from = await operator.body();
  await operator.hold(grip);
  await operator.expectState('holder', 'you');
  await operator.expectMovedFrom(from, 0.3);
  await controllers.unplug();
  await operator.expectState('driving', false);
  await expect(page.locator('#notice')).toHaveText('Flight stick was unplugged: it has let go');
  await operator.expectStanding();
  // Plugged in again with the grip still held.
  await controllers.plugIn(JOYSTICK, '', [0, 0, -1], [0]);
  await operator.expectFrames(20);
  expect((await operator.state()).driving).toBe(false);

  // Its button stops, and what was chosen is there after a reload.
  await operator.reload();
  await operator.expectPoints(100);
  await controllers.plugIn(JOYSTICK, '', [0, 0, 1]);
  // Not held while it is plugged in.
  await operator.expectFrames(3);
  await operator.hold(grip);
  await operator.expectState('holder', 'you');
  await controllers.press(3, true);
  await operator.expectState('estop', true);
});

test('a gamepad in the standard mapping drives at once; B stays STOP whatever is chosen', async ({
  page,
  startStack,
}) => {
  const stack = await startStack({ robots: [lightRobot] });
  const controllers = await Controllers.install(page);
  const operator = await OperatorPage.open(page, stack, options);
  await operator.expectPoints(100);
  await controllers.plugIn('Pad (STANDARD GAMEPAD Vendor: 045e Product: 0b13)', 'standard', [0, 0, 0, 0]);
  const from = await operator.body();
  await controllers.move(3, -1);
  await operator.hold({ hold: () => controllers.press(5, true), release: () => controllers.press(5, false) });
  await operator.expectMovedFrom(from, 0.2);
  await operator.release();
  await openDialog(page);
  const dialog = page.locator('#inputs');
  await dialog.getByRole('button', { name: 'STOP: remove button 2' }).click();
  await expect(page.locator('#inputs-said')).toHaveText(/^Button 2 keeps stopping the robot/);
  await dialog.getByRole('button', { name: 'Grip (hold to drive): remove button 6' }).click();
  await expect(page.locator('#inputs-said')).toHaveText('Saved.');
  // STOP works here, too.
  await controllers.press(1, true);
  await operator.expectState('estop', true);
  await controllers.press(1, false);
  await closeDialog(page);
  await operator.releaseEstop();
  await controllers.press(5, true);
  await operator.expectFrames(20);
  expect((await operator.state()).driving).toBe(false);
  await controllers.press(4, true);
  await operator.expectState('driving', true);
});

test('keys are chosen by keyboard alone: conflicts are refused, X stays STOP, and the page names the new keys', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [lightRobot] });
  const operator = await OperatorPage.open(page, stack, options);
  await operator.expectPoints(100);
  const { keyboard } = page;
  const said = page.locator('#inputs-said');
  await page.locator('#settings-open').focus();
  await keyboard.press('Enter');
  await page.locator('#inputs-open').focus();
  await keyboard.press('Enter');
  const add = page.getByRole('button', { name: 'Forward: add a key' });
  const choose = async (key: string) => {
    await add.focus();
    await keyboard.press('Enter');
    await expect(said).toHaveText('Forward: press the key. Escape leaves it.');
    await keyboard.press(key);
  };
  await choose('KeyR');
  await expect(said).toHaveText('R is taken: Release STOP (hold). Remove it there first.');
  await choose('Tab');
  await expect(said).toHaveText('Tab is needed to use the page without a mouse: choose another key.');
  await choose('Escape');
  await expect(said).toHaveText('Nothing was changed.');
  await expect(page.locator('#inputs')).toBeVisible();
  await choose('KeyX');
  await expect(said).toHaveText('X always stops the robot: it can have no other use.');
  await operator.expectState('estop', true);
  await page.getByRole('button', { name: 'STOP: remove X' }).press('Enter');
  await expect(said).toHaveText('X always stops the robot: it can have no other use.');
  await page.getByRole('button', { name: 'Forward: remove W' }).press('Enter');
  await expect(said).toHaveText('Saved.');
  await choose('KeyI');
  await expect(said).toHaveText('Saved.');
  // What had the focus keeps it.
  await expect(add).toBeFocused();
  const latency = page.locator('#latency');
  await expect(latency).toHaveAttribute('title', 'Measure motion-to-photon latency (L)');
  await page.getByRole('button', { name: 'Latency test: remove L' }).press('Enter');
  await expect(latency).toHaveAttribute('title', 'Measure motion-to-photon latency');
  await page.getByRole('button', { name: 'Latency test: add a key' }).press('Enter');
  await keyboard.press('KeyK');
  await expect(latency).toHaveAttribute('title', 'Measure motion-to-photon latency (K)');
  await add.focus();
  await operator.screenshots(page, testInfo, 'keys');
  await page.getByLabel(/^One key at a time/).press('Space');
  await keyboard.press('Escape');
  await keyboard.press('Escape');
  await expect(page.locator('#settings')).toBeHidden();
  await expect(page.locator('#drive-hint')).toContainText('drive with IASD');
  await operator.releaseEstop();

  await operator.reload();
  await operator.expectPoints(100);
  const from = await operator.body();
  await keyboard.down('KeyW');
  await operator.expectFrames(10);
  expect((await operator.state()).driving).toBe(false);
  await keyboard.up('KeyW');
  // One key drives, and stops when it is let go.
  await operator.hold({ hold: () => keyboard.down('KeyI'), release: () => keyboard.up('KeyI') });
  await operator.expectMovedFrom(from, 0.2);
  await operator.release();
  await operator.expectState('driving', false);
  await operator.expectStanding();

  await openDialog(page);
  await page.getByRole('button', { name: 'Reset keys' }).click();
  await expect(page.getByRole('button', { name: 'Forward: remove W' })).toBeVisible();
  await closeDialog(page);
  await expect(page.locator('#drive-hint')).toContainText('drive with WASD');
});

test('the greatest speed is chosen by key and button, said with its value, and kept', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [lightRobot] });
  const operator = await OperatorPage.open(page, stack, options);
  await operator.expectPoints(100);
  const gear = page.locator('#speed-choice .gear');
  await expect(gear).toHaveText(/^100 % · \d\.\d\d m\/s$/);
  const most = Number(/ (\d\.\d\d) m/.exec((await gear.textContent()) ?? '')?.[1]);
  for (let i = 0; i < 3; i++) await page.keyboard.press('Comma');
  await expect(page.locator('#notice')).toHaveText(`Greatest speed: 25 % · ${(most / 4).toFixed(2)} m/s`);
  await expect(gear).toHaveText(`25 % · ${(most / 4).toFixed(2)} m/s`);
  // A slider that has the focus takes no key from driving but its own.
  await page.getByRole('slider', { name: 'Greatest speed' }).first().focus();
  const from = await operator.body();
  const fastest = await page.evaluate(() => {
    let fastest = 0;
    setInterval(() => {
      fastest = Math.max(fastest, Math.abs(window.farpoint.state().velocity?.linear ?? 0));
      Object.assign(window, { fastest });
    }, 100);
    return fastest;
  });
  expect(fastest).toBe(0);
  await operator.holdForward();
  await operator.expectMovedFrom(from, 0.3);
  await operator.release();
  const seen = await page.evaluate(() => (window as unknown as { fastest: number }).fastest);
  expect(seen).toBeGreaterThan(0.05);
  expect(seen).toBeLessThanOrEqual(most / 4 + 0.01);
  await gear.click();
  await expect(gear).toHaveText(/^50 %/);
  await operator.reload();
  await operator.expectPoints(100);
  await expect(gear).toHaveText(/^50 %/);
  for (const size of screenSizes) {
    await page.setViewportSize(size);
    await operator.look(testInfo, `speed-${size.width}`);
    const names = await expectOnScreenAndApart(
      page.locator('#bar button:visible, #drive > * > *:visible, #facts'),
      size,
    );
    expect(names).toEqual(expect.arrayContaining(['estop', 'speed-choice']));
  }
});
