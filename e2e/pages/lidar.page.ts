/** A LiDAR's cloud in the colours of a quantity, cut at a height, and seen from above. */
import { expect, test } from '../src/stage/page-test.ts';
import { changedShare } from '../src/stage/pictures.ts';
import { FRAME_MS, type Rgb, type Stage } from '../src/stage/stage.ts';

/** Both ends of the colour map. */
const FIRST: Rgb = [87, 40, 143];
const LAST: Rgb = [254, 244, 114];
const BACKGROUND: Rgb = [11, 15, 20];
/** The outline of the robot over the background. */
const MARKER: Rgb = [45, 164, 149];
const MIDDLE = { x: 0.44, y: 0.4, width: 0.12, height: 0.2 };

async function openLidarOnly(stage: Stage) {
  const page = await stage.open({ state: 'two-sensors', forMs: 1000, frameMs: FRAME_MS });
  await page.getByRole('button', { name: 'Camera', exact: true }).click();
  await stage.run(1500);
  return page;
}

/** Shares of the drawn pixels with the first and the last colour. */
async function ends(stage: Stage): Promise<{ first: number; last: number; drawn: number }> {
  await stage.run(500);
  const drawn = 1 - (await stage.share(BACKGROUND, undefined, 40));
  return { first: (await stage.share(FIRST)) / drawn, last: (await stage.share(LAST)) / drawn, drawn };
}

test('a LiDAR in the colours of a quantity, without what is above a height, and remembered', async ({
  stage,
}) => {
  const page = await openLidarOnly(stage);
  const mode = page.getByLabel('Colours of LiDAR');
  const legend = page.locator('.legend');
  await page.getByRole('button', { name: 'Colours' }).click();
  await expect(mode).toHaveValue('height');
  await expect(page.getByLabel('Colours of Camera')).toHaveValue('captured');
  await expect(legend).toHaveCount(1);
  await expect(legend).toContainText('LiDAR: height, m');

  // The colours are those of the range: everything is below it, then everything above.
  await page.getByRole('button', { name: 'Auto' }).click();
  await page.getByLabel('LiDAR: range to').fill('8');
  await page.getByLabel('LiDAR: range from').fill('7');
  const below = await ends(stage);
  expect(below.first).toBeGreaterThan(0.3);
  expect(below.last).toBeLessThan(below.first / 50);
  await page.getByLabel('LiDAR: range from').fill('-9');
  await page.getByLabel('LiDAR: range to').fill('-8');
  const above = await ends(stage);
  expect(above.last).toBeGreaterThan(0.3);
  expect(above.first).toBeLessThan(above.last / 50);
  await page.getByRole('button', { name: 'Auto' }).click();
  expect((await ends(stage)).last).toBeLessThan(above.last / 2);

  for (const [chosen, words] of [
    ['distance', 'distance, m'],
    ['intensity', 'intensity, %'],
    ['age', 'age, ms'],
    ['lit', 'points, not lit'],
  ] as const) {
    await mode.selectOption(chosen);
    await stage.run(300);
    await expect(legend).toContainText(words);
  }
  const unringed = await stage.pixels();
  await mode.selectOption('ring');
  await stage.run(300);
  // As many as the robot says.
  await expect(page.locator('.legend figcaption')).toHaveText('LiDAR: 16 rings');
  await expect(page.getByLabel('LiDAR: range from')).toBeHidden();
  expect(changedShare(unringed, await stage.pixels())).toBeGreaterThan(0.01);
  await mode.selectOption('captured');
  await stage.run(300);
  await expect(legend).toHaveCount(0);
  await mode.selectOption('distance');
  await stage.run(500);

  const whole = (await ends(stage)).drawn;
  await page.getByLabel('Hide points above').fill('0.4');
  const cut = (await ends(stage)).drawn;
  expect(cut).toBeLessThan(whole * 0.95);
  expect(cut).toBeGreaterThan(0.005);

  await stage.reload(1000);
  await page.getByRole('button', { name: 'Colours' }).click();
  await expect(mode).toHaveValue('distance');
  await expect(page.getByLabel('Hide points above')).toHaveValue('0.4');
});

test('from above, the robot is in the middle, can be driven, and stops; its zoom and heading can be changed', async ({
  stage,
}) => {
  const page = await openLidarOnly(stage);
  const marked = () => stage.share(MARKER, MIDDLE, 45);
  // No point has a colour like the marker's.
  await page.getByRole('button', { name: 'Colours' }).click();
  await page.getByLabel('Colours of LiDAR').selectOption('captured');
  await page.getByRole('button', { name: 'Colours' }).click();
  await stage.run(500);
  expect(await marked()).toBe(0);
  const fromAbove = page.getByRole('button', { name: 'From above' });
  await page.keyboard.press('KeyT');
  await stage.run(300);
  await expect(fromAbove).toHaveAttribute('aria-pressed', 'true');
  await page.mouse.move(160, 90);
  await page.mouse.wheel(0, -1500);
  await stage.run(300);
  const large = await marked();
  expect(large).toBeGreaterThan(0.005);

  await page.keyboard.down('Space');
  await stage.run(100);
  await page.keyboard.down('KeyW');
  await stage.run(1500);
  expect((await stage.state()).body?.x).toBeGreaterThan(0.5);
  await page.keyboard.press('KeyX');
  await stage.run(300);
  expect(await stage.state()).toMatchObject({ estop: true, velocity: { linear: 0 } });
  await page.keyboard.up('KeyW');
  await page.keyboard.up('Space');
  await stage.run(1000);
  expect(await marked()).toBeGreaterThan(0.005);

  await page.getByRole('button', { name: 'Colours' }).click();
  await page.getByRole('button', { name: 'Heading up' }).click();
  await expect(page.getByRole('button', { name: 'North up' })).toBeVisible();
  await page.getByRole('button', { name: 'Colours' }).click();
  await page.mouse.move(160, 90);
  await page.mouse.wheel(0, 1000);
  await stage.run(300);
  // Further away, the robot is smaller.
  expect(await marked()).toBeLessThan(large / 1.5);
  await fromAbove.click();
  await stage.run(300);
  expect(await marked()).toBe(0);
});
