/** What the robot does by a button: shown with the reason where it is not allowed, done, confirmed, and never over STOP. */
import type { Page } from '@playwright/test';
import { expectAccessible } from '../src/accessibility.ts';
import { expectOnScreenAndApart } from '../src/layout.ts';
import { expectNothingCovered } from '../src/nothing-covered.ts';
import { OperatorPage, screenSizes } from '../src/operator-page.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';

const robot = { ...lightRobot, args: [...lightRobot.args, '--sim-commands'] };

const command = (page: Page, id: string) => page.locator(`#commands [data-command="${id}"]`);

/** A second press just after the first is a double click, and counts as one. */
async function pressLater(page: Page, id: string): Promise<void> {
  const pressedMs = await page.evaluate(() => performance.now());
  await page.waitForFunction((atMs) => performance.now() > atMs + 350, pressedMs);
  await command(page, id).click();
}

test('the robot’s commands are offered, refused with the reason, confirmed and done', async ({
  page,
  startStack,
}, testInfo) => {
  await page.setViewportSize({ width: 1280, height: 720 });
  const stack = await startStack({ robots: [robot] });
  const operator = await OperatorPage.open(page, stack, { robot: robot.id, canvas: '64x36' });
  await operator.expectPoints(300);
  const notice = page.locator('#notice');
  const panel = page.locator('#commands');
  await expect(panel).toBeVisible();
  if ((await panel.getAttribute('open')) === null) await panel.locator('summary').click();

  // Nobody drives yet: what needs the lease says so, and is refused here.
  await expect(panel.getByRole('group', { name: 'Signals' }).getByRole('button')).toHaveText([
    'Lightsonly who drives may',
    'Horn',
  ]);
  // Not by Playwright's click, which waits until it is enabled.
  await command(page, 'lights').dispatchEvent('click');
  await expect(notice).toHaveText('Lights: only who drives may');
  await command(page, 'horn').click();
  await expect(notice).toHaveText('Horn: the horn has sounded');

  await page.evaluate(() => window.farpoint.requestLease());
  await expect(command(page, 'lights')).toHaveAttribute('aria-disabled', 'false');
  // By the keyboard alone.
  await command(page, 'lights').focus();
  await page.keyboard.press('Enter');
  await expect(notice).toHaveText('Lights: the lights are on');
  await expect(command(page, 'lights')).toBeFocused();
  await expectAccessible(page, 'commands');

  await command(page, 'clear-faults').click();
  await expect(command(page, 'clear-faults')).toHaveText('Press again: Clear faults');
  await pressLater(page, 'clear-faults');
  await expect(notice).toHaveText('Clear faults: there are no faults');

  for (const size of screenSizes) {
    await page.setViewportSize(size);
    await operator.expectFrames(3);
    await operator.look(testInfo, `commands-${size.width}`);
    await expectOnScreenAndApart(page.locator('#bar, #commands, #drive button, #joystick'), size);
    await expectNothingCovered(page);
  }

  await page.keyboard.press('x');
  await operator.expectState('estop', true);
  await expect(command(page, 'lights')).toHaveText('Lightsnot while the emergency stop is on');
  await expect(command(page, 'clear-faults')).toHaveText('Clear faults');
});
