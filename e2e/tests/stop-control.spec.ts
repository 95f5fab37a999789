/** The STOP control: where it is, what keys press it, what it says while it is on, and who may release it. */
import type { Locator } from '@playwright/test';
import { expectOnScreenAndApart } from '../src/layout.ts';
import { OperatorPage, screenSizes } from '../src/operator-page.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';

const CONTROLS = '#bar button:visible, #drive button:visible, #joystick:visible, #facts, #stop-band:visible';

/** Whether a hand that aims at the middle of STOP hits it. */
function isOnTop(stop: Locator): Promise<boolean> {
  return stop.evaluate((button) => {
    const { left, top, width, height } = button.getBoundingClientRect();
    return document.elementFromPoint(left + width / 2, top + height / 2)?.closest('button') === button;
  });
}

test('while it is on, a band says who pressed it and who releases it; only they get the release control', async ({
  page,
  context,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [lightRobot] });
  const options = { robot: lightRobot.id, canvas: '64x36' };
  const ada = await OperatorPage.open(page, stack, { ...options, name: 'Ada' });
  await ada.expectPoints(100);
  await page.keyboard.down('Space');
  await ada.expectState('holder', 'you');
  await page.keyboard.up('Space');
  const bobsPage = await context.newPage();
  const bob = await OperatorPage.open(bobsPage, stack, { ...options, name: 'Bob' });
  await bob.expectPoints(100);
  await bob.expectState('holder', 'other');
  await expect(bobsPage.locator('#stop-band')).toBeHidden();

  await bobsPage.keyboard.press('KeyX');
  const [band, release] = [page.locator('#stop-band'), page.locator('#estop-release')];
  await expect(band).toHaveText(/Emergency stop.*Bob pressed STOP\..*Hold the release control/);
  await expect(release).toBeVisible();
  const bobsBand = bobsPage.locator('#stop-band');
  await expect(bobsBand).toHaveText(/You pressed STOP\..*Whoever drives releases it/);
  await expect(bobsPage.locator('#estop-release')).toBeHidden();
  await bobsPage.keyboard.press('KeyR');
  await expect(bobsPage.locator('#notice')).toHaveText(/^Whoever drives releases it/);
  await bob.screenshots(bobsPage, testInfo, 'not-mine-to-release');

  // Who takes over may release it, and is told so at once.
  await page.bringToFront();
  await page.getByRole('button', { name: 'Hand over' }).click();
  await bob.expectState('holder', 'nobody');
  await expect(bobsPage.locator('#estop-release')).toBeVisible();
  await bobsPage.bringToFront();
  await bob.releaseEstop();
  await expect(bobsBand).toBeHidden();
  await expect(band).toBeHidden();
});

test('STOP stays in its place, on top and with the focus, whatever happens', async ({
  page,
  openRobot,
}, testInfo) => {
  const { operator } = await openRobot();
  const stop = page.locator('#estop');
  for (const size of screenSizes) {
    await page.setViewportSize(size);
    const place = await stop.boundingBox();
    expect(place?.x).toBeGreaterThan(size.width / 2);
    await stop.focus();
    await page.keyboard.press('Enter');
    await operator.expectState('estop', true);
    await expect(page.locator('#stop-band')).toBeVisible();
    expect(await stop.boundingBox()).toEqual(place);
    await expect(stop).toBeFocused();
    expect((await page.locator('#stop-band').boundingBox())?.width).toBe(size.width);
    await operator.look(testInfo, `latched-${size.width}`);
    await expectOnScreenAndApart(page.locator(CONTROLS), size);
    await operator.releaseEstop();
  }
});

test('STOP is in reach while a dialog is open, by hand and by its key', async ({
  page,
  openRobot,
}, testInfo) => {
  const { operator } = await openRobot();
  const stop = page.locator('#estop');
  const settings = page.getByRole('dialog', { name: 'Settings' });
  for (const size of screenSizes) {
    await page.setViewportSize(size);
    await page.getByRole('button', { name: 'Settings' }).click();
    await expect(settings).toBeVisible();
    expect(await isOnTop(stop)).toBe(true);
    await operator.look(testInfo, `settings-${size.width}`);
    await expectOnScreenAndApart(page.locator('#settings, #estop'), size);
    await stop.click();
    await operator.expectState('estop', true);
    await page.keyboard.press('Escape');
    await expect(settings).toBeHidden();
    await operator.releaseEstop();
  }
  await page.getByRole('button', { name: 'Settings' }).click();
  // A letter that is typed stops nothing; at a box to be ticked it is no text.
  await settings.getByLabel('Your name').press('x');
  await operator.expectFrames(10);
  await operator.expectState('estop', false);
  await settings.getByLabel(/Sound and vibration/).press('x');
  await operator.expectState('estop', true);
  // What is behind the dialog takes no focus.
  for (let i = 0; i < 30; i++) {
    await page.keyboard.press('Tab');
    const behind = () => document.activeElement?.closest('#bar, #hud, #stage') ?? null;
    expect(await page.evaluate(behind)).toBeNull();
  }
});
