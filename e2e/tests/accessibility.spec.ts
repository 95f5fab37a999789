/** No screen of the page breaks a rule that a program can check, whatever its size. */
import type { Page } from '@playwright/test';
import { expectAccessible } from '../src/accessibility.ts';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, lightRobot, type StackFixtures, test } from '../src/stack-test.ts';

const sizes = [
  { width: 360, height: 740 },
  { width: 667, height: 320 },
  { width: 1280, height: 720 },
] as const;

async function expectAccessibleAtAllSizes(page: Page, screen: string): Promise<void> {
  for (const size of sizes) {
    await page.setViewportSize(size);
    await expectAccessible(page, `${screen} at ${size.width}×${size.height}`);
  }
}

/** With a small canvas: what is audited is beside it, and a large one takes the processor's time. */
async function open(page: Page, startStack: StackFixtures['startStack']) {
  const stack = await startStack({ robots: [lightRobot] });
  const operator = await OperatorPage.open(page, stack, { robot: lightRobot.id, canvas: '160x90' });
  await operator.expectPoints(300);
  return { stack, operator };
}

test('the list of robots, the settings, the grants, the help and the event log', async ({
  page,
  startStack,
}) => {
  const stack = await startStack();
  await OperatorPage.open(page, stack);
  await expect(page.getByRole('button', { name: /Simulated robot 1/ })).toBeVisible();
  await expectAccessibleAtAllSizes(page, 'list of robots');
  await page.getByRole('button', { name: 'Settings' }).click();
  await page.getByText('Headset', { exact: true }).click();
  await expectAccessibleAtAllSizes(page, 'settings');
  await page.getByRole('button', { name: /Grants and robots/ }).click();
  await expectAccessibleAtAllSizes(page, 'grants');
  await page.keyboard.press('Escape');
  await expect(page.getByRole('dialog')).toHaveCount(0);
  await page.keyboard.press('?');
  await expect(page.getByRole('dialog', { name: 'Help' })).toBeVisible();
  await expectAccessibleAtAllSizes(page, 'help');
  await page.getByRole('button', { name: 'Event log' }).click();
  await expect(page.getByRole('cell', { name: 'This page was opened' })).toBeVisible();
  await expectAccessibleAtAllSizes(page, 'event log');
});

test('driving, an emergency stop, and a lost link', async ({ page, startStack }) => {
  const { stack, operator } = await open(page, startStack);
  await expectAccessibleAtAllSizes(page, 'driving');
  await page.locator('#estop').click();
  await operator.expectState('estop', true);
  await expectAccessibleAtAllSizes(page, 'latched');
  stack.robot(lightRobot.id).signal('SIGSTOP');
  await expect(page.locator('#banner')).toBeVisible();
  await expectAccessibleAtAllSizes(page, 'lost link');
  stack.robot(lightRobot.id).signal('SIGCONT');
});

test('with its dashboard', async ({ page, startStack }) => {
  await open(page, startStack);
  await page.keyboard.press('KeyB');
  await expect(page.locator('#dashboard').getByRole('region', { name: 'Speed', exact: true })).toBeVisible();
  await expectAccessibleAtAllSizes(page, 'dashboard');
});
