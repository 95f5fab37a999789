import type { Page } from '@playwright/test';
import { expectOnScreenAndApart } from '../src/layout.ts';
import { OperatorPage } from '../src/operator-page.ts';
import { type Part, type Rgb, sharesNear } from '../src/picture.ts';
import { screenSizes } from '../src/screens.ts';
import { expect, simulatedRobot, test } from '../src/stack-test.ts';

const LIDAR_ROBOT = { ...simulatedRobot, args: [...simulatedRobot.args, '--sim-lidars', '1'] };

/** Beside the panels: above the horizon, below it, and the middle of the screen. */
const sky: Part = { left: 0.35, top: 0.12, width: 0.6, height: 0.36 };
const floor: Part = { left: 0.35, top: 0.52, width: 0.45, height: 0.2 };
const middle: Part = { left: 0.46, top: 0.43, width: 0.08, height: 0.14 };

const BACKGROUND: Rgb = [11, 15, 20];
/** Both ends of the colour map. */
const FIRST: Rgb = [87, 40, 143];
const LAST: Rgb = [254, 244, 114];
/** Four rings, one above the other, in their colours. */
const RINGS: readonly Rgb[] = [
  [28, 130, 187],
  [252, 191, 194],
  [30, 146, 71],
  [204, 204, 252],
];
/** The outline of the robot over the background. */
const MARKER: Rgb = [45, 164, 149];

/** Share of the pixels of a part that show anything, and of those with the first and the last colour, 0–1. */
async function look(page: Page, part: Part): Promise<{ drawn: number; first: number; last: number }> {
  const png = await page.screenshot();
  const [empty = 0, first = 0, last = 0] = await sharesNear(page, png, part, [BACKGROUND, FIRST, LAST]);
  return { drawn: 1 - empty, first, last };
}

async function openLidarOnly(page: Page, operator: OperatorPage): Promise<void> {
  await operator.expectPoints();
  const drawn = async () =>
    (await page.evaluate(() => window.farpoint.sensors())).map(({ points }) => points > 100);
  await expect.poll(drawn).toEqual([true, true]);
  await page.getByRole('button', { name: 'Camera' }).click();
  await expect.poll(drawn).toEqual([false, true]);
}

test('a LiDAR in the colours of a quantity, without what is above a height, and remembered', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [LIDAR_ROBOT] });
  const operator = await OperatorPage.open(page, stack, { robot: LIDAR_ROBOT.id });
  await openLidarOnly(page, operator);
  const mode = page.getByLabel('Colours of LiDAR');
  await page.getByRole('button', { name: 'Colours' }).click();
  await expect(mode).toHaveValue('height');
  await expect(page.getByLabel('Colours of Camera')).toHaveValue('captured');
  await expect(page.locator('.legend')).toHaveCount(1);
  await expect(page.locator('.legend')).toContainText('LiDAR: height, m');
  await operator.screenshot(testInfo, 'height');

  // The colours are those of the range: everything is below it, then everything above.
  const hasOnly = async (colour: 'first' | 'last') => {
    const shares = await look(page, sky);
    const other = colour === 'first' ? shares.last : shares.first;
    return shares[colour] > 0.005 && other < shares[colour] / 50;
  };
  await page.getByRole('button', { name: 'Auto' }).click();
  await page.getByLabel('LiDAR: range to').fill('8');
  await page.getByLabel('LiDAR: range from').fill('7');
  await expect.poll(() => hasOnly('first')).toBe(true);
  await page.getByLabel('LiDAR: range from').fill('-2');
  await page.getByLabel('LiDAR: range to').fill('-1.9');
  await expect.poll(() => hasOnly('last')).toBe(true);
  const { last } = await look(page, sky);
  await page.getByRole('button', { name: 'Auto' }).click();
  await expect.poll(async () => (await look(page, sky)).last).toBeLessThan(last / 2);

  for (const [chosen, legend] of [
    ['distance', 'distance, m'],
    ['intensity', 'intensity, %'],
    ['age', 'age, ms'],
  ] as const) {
    await mode.selectOption(chosen);
    await expect(page.locator('.legend')).toContainText(legend);
    await expect(page.locator('.numbers span').first()).toBeVisible();
    await operator.screenshot(testInfo, chosen);
  }
  await mode.selectOption('lit');
  await expect(page.locator('.legend')).toContainText('points, not lit');
  await mode.selectOption('ring');
  // As many as the simulated LiDAR has, as the robot says.
  await expect(page.locator('.legend figcaption')).toHaveText('LiDAR: 16 rings');
  await expect(page.getByLabel('LiDAR: range from')).toBeHidden();
  // Both the light and the dark rings are to be seen, and their colours only.
  const rings = async () => sharesNear(page, await page.screenshot(), floor, [BACKGROUND, ...RINGS]);
  await expect
    .poll(async () => (await rings()).slice(1).filter((share) => share > 0.0005).length)
    .toBeGreaterThan(2);
  await operator.screenshot(testInfo, 'ring');
  await mode.selectOption('captured');
  await expect(page.locator('.legend')).toHaveCount(0);
  await operator.screenshot(testInfo, 'captured');
  await mode.selectOption('distance');

  // Only what is above the eyes disappears.
  const before = (await look(page, sky)).drawn;
  expect(before).toBeGreaterThan(0.005);
  await page.getByLabel('Hide points above').fill('0.4');
  await expect.poll(async () => (await look(page, sky)).drawn).toBeLessThan(before / 20);
  expect((await look(page, floor)).drawn).toBeGreaterThan(0.001);
  await operator.screenshot(testInfo, 'cut');

  await page.reload();
  await page.waitForFunction(() => window.farpoint !== undefined);
  await operator.expectState('session', 'live');
  await page.getByRole('button', { name: 'Colours' }).click();
  await expect(mode).toHaveValue('distance');
  await expect(page.getByLabel('Hide points above')).toHaveValue('0.4');
});

test('from above, the robot is in the middle, can be driven, and stops', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [LIDAR_ROBOT] });
  const operator = await OperatorPage.open(page, stack, { robot: LIDAR_ROBOT.id });
  await openLidarOnly(page, operator);
  // No point has a colour like the marker's.
  await page.getByRole('button', { name: 'Colours' }).click();
  await page.getByRole('button', { name: 'Auto' }).click();
  await page.getByLabel('LiDAR: range to').fill('8');
  await page.getByLabel('LiDAR: range from').fill('7');
  const marked = async () => {
    const [share = 0] = await sharesNear(page, await page.screenshot(), middle, [MARKER]);
    return share;
  };
  await expect.poll(marked).toBe(0);

  // A click on the picture takes the focus from the slider.
  await page.mouse.click(600, 300);
  await page.keyboard.press('KeyT');
  await expect(page.getByRole('button', { name: 'From above' })).toHaveAttribute('aria-pressed', 'true');
  await expect.poll(marked).toBeGreaterThan(0.005);
  await operator.screenshot(testInfo, 'from-above');

  const start = await operator.body();
  await operator.holdForward();
  await operator.expectMovedFrom(start, 0.5);
  await page.keyboard.press('KeyX');
  await operator.expectState('estop', true);
  await operator.release();
  await operator.expectStanding();
  await expect.poll(marked).toBeGreaterThan(0.005);

  await page.getByRole('button', { name: 'Heading up' }).click();
  await expect(page.getByRole('button', { name: 'North up' })).toBeVisible();
  const large = await marked();
  // A notice may be there, and lets the wheel through.
  await page.mouse.move(600, 300);
  for (let i = 0; i < 5; i++) await page.mouse.wheel(0, 200);
  // Further away, the robot is smaller.
  await expect.poll(marked).toBeLessThan(large / 1.5);
  await operator.screenshot(testInfo, 'north-up');

  await page.getByRole('button', { name: 'From above' }).click();
  await expect.poll(marked).toBe(0);
});

for (const { width, height } of screenSizes) {
  test(`the panel for clouds covers nothing on a screen ${width} pixels wide`, async ({
    page,
    startStack,
  }, testInfo) => {
    const screen = { width, height };
    await page.setViewportSize(screen);
    const stack = await startStack({ robots: [LIDAR_ROBOT] });
    const operator = await OperatorPage.open(page, stack, { robot: LIDAR_ROBOT.id });
    await operator.expectPoints();
    const controls = page.locator(
      '#bar button:visible, #drive button:visible, #joystick:visible, #holder, #drive-hint:visible, #sensors button, #clouds .heads button, ' +
        '#clouds .legend, #clouds .controls:visible, #facts:visible, #no-gpu:visible',
    );
    await expect(page.locator('.legend')).toBeVisible();
    await operator.screenshot(testInfo, `closed-${width}`);
    await expectOnScreenAndApart(controls, screen);
    // The column has more to say than there is room for: what is only read gives way.
    const facts = page.locator('#facts');
    await facts.evaluate((list) => {
      const row = () => Object.assign(document.createElement('dd'), { textContent: 'one more figure' });
      list.append(...Array.from({ length: 40 }, row));
    });
    await page.locator('#no-gpu').evaluate((note: HTMLDetailsElement) => {
      note.open = true;
    });
    await expectOnScreenAndApart(controls, screen);
    await operator.screenshot(testInfo, `much-to-say-${width}`);
    await page.getByRole('button', { name: 'Colours' }).click();
    await page.getByRole('button', { name: 'From above' }).click();
    await operator.expectFrames(5);
    await operator.screenshot(testInfo, `open-${width}`);
    expect((await expectOnScreenAndApart(controls, screen)).length).toBeGreaterThan(8);
    for (const control of await page
      .locator('#clouds button:visible, #clouds :is(select, input):visible')
      .all()) {
      await control.click({ trial: true });
    }
    await page.getByRole('button', { name: 'STOP' }).click();
    await operator.expectState('estop', true);
  });
}
