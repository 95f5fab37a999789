/** The page's own look: its colours, the size of its text, and what fits on which screen. */
import type { Page } from '@playwright/test';
import { expectAccessible } from '../src/accessibility.ts';
import { expectOnScreenAndApart } from '../src/layout.ts';
import { expectNothingCovered } from '../src/nothing-covered.ts';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, lightRobot, type StackFixtures, test } from '../src/stack-test.ts';

const CONTROLS =
  '#bar button:visible, #bar select:visible, #drive button:visible, #joystick:visible, #facts:visible';

/** With a small canvas: what is looked at is beside it, and a large one takes the processor's time. */
async function open(page: Page, startStack: StackFixtures['startStack']) {
  const stack = await startStack({ robots: [lightRobot] });
  const operator = await OperatorPage.open(page, stack, { robot: lightRobot.id, canvas: '160x90' });
  await operator.expectPoints(300);
  return operator;
}

/** Changes one of the settings under “Display”. */
async function choose(page: Page, name: string, value: string): Promise<void> {
  await page.getByRole('button', { name: 'Settings' }).click();
  const details = page.locator('#display-settings');
  if ((await details.getAttribute('open')) === null) await details.locator('summary').click();
  const field = details.locator(`[name="${name}"]`);
  if (name === 'textScale') await field.fill(value);
  else await field.selectOption(value);
  await page.getByRole('button', { name: 'Cancel' }).click();
}

const expectGround = (page: Page, colour: string) =>
  expect.poll(async () => (await shown(page)).ground).toBe(colour);
const shown = (page: Page) =>
  page.evaluate(() => ({
    ground: getComputedStyle(document.body).backgroundColor,
    rem: Number.parseFloat(getComputedStyle(document.documentElement).fontSize),
  }));

test('the colours follow the system or the operator’s choice, at once and at the next visit', async ({
  page,
  startStack,
}, testInfo) => {
  await page.setViewportSize({ width: 1280, height: 720 });
  const operator = await open(page, startStack);
  await expectGround(page, 'rgb(11, 15, 20)');
  await page.emulateMedia({ colorScheme: 'light' });
  await expectGround(page, 'rgb(243, 246, 248)');
  await choose(page, 'theme', 'contrast');
  await expectGround(page, 'rgb(0, 0, 0)');
  await operator.reload();
  await operator.expectPoints(300);
  await expectGround(page, 'rgb(0, 0, 0)');
  await page.keyboard.press('KeyB');
  await expect(page.locator('#dashboard').getByRole('region', { name: 'Speed', exact: true })).toBeVisible();
  for (const theme of ['contrast', 'light'] as const) {
    await choose(page, 'theme', theme);
    await operator.look(testInfo, theme);
    await expectAccessible(page, theme);
  }
});

test('text of twice the size, and a large screen: nothing is covered', async ({
  page,
  startStack,
}, testInfo) => {
  await page.setViewportSize({ width: 1280, height: 720 });
  const operator = await open(page, startStack);
  const { rem } = await shown(page);
  await choose(page, 'textScale', '2');
  expect((await shown(page)).rem).toBe(2 * rem);
  for (const size of [
    { width: 1280, height: 720 },
    { width: 1920, height: 1080 },
  ]) {
    await page.setViewportSize(size);
    await operator.look(testInfo, `twice-${size.width}`);
    await expectOnScreenAndApart(page.locator(CONTROLS), size);
    await expectNothingCovered(page);
  }
  await choose(page, 'textScale', '1');
  await page.setViewportSize({ width: 3840, height: 2160 });
  expect((await shown(page)).rem).toBe(1.5 * rem);
});

test('in small windows, every control is on the screen and none covers another', async ({
  page,
  startStack,
}, testInfo) => {
  const operator = await open(page, startStack);
  for (const [what, width, height] of [
    ['1280 × 720 at 200 %', 640, 360],
    ['1280 × 720 at 400 %', 320, 180],
    ['a phone held sideways', 667, 320],
    ['a tablet held upright', 768, 1024],
  ] as const) {
    await test.step(what, async () => {
      await page.setViewportSize({ width, height });
      await operator.expectFrames(2);
      await operator.look(testInfo, `driving-${width}`);
      await expectOnScreenAndApart(page.locator(CONTROLS), { width, height });
      await expectNothingCovered(page);
    });
  }
});
