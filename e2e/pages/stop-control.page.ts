/** The STOP control: where it is, what keys press it, what it says while it is on, and who may release it. */
import type { StageStateName } from '@farpoint/webxr/stage-states';
import type { Page } from '@playwright/test';
import { expect, test } from '../src/stage/page-test.ts';

const SCREENS = [
  { width: 1280, height: 720, isTouched: false },
  { width: 360, height: 740, isTouched: true },
  { width: 667, height: 320, isTouched: true },
  // A laptop at 200 %.
  { width: 640, height: 360, isTouched: false },
  { width: 3840, height: 2160, isTouched: false },
] as const;

/** Whether a hand that aims at the middle of STOP hits it. */
function isOnTop(page: Page): Promise<boolean> {
  return page.locator('#estop').evaluate((button) => {
    const { left, top, width, height } = button.getBoundingClientRect();
    return document.elementFromPoint(left + width / 2, top + height / 2)?.closest('button') === button;
  });
}

/** How far STOP is from the lower right corner, CSS pixels. */
async function corner(page: Page): Promise<readonly [right: number, bottom: number]> {
  const box = await page.locator('#estop').boundingBox();
  const size = page.viewportSize();
  if (box === null || size === null) throw new Error('STOP is not there');
  return [size.width - box.x - box.width, size.height - box.y - box.height];
}

const STATES: readonly StageStateName[] = ['live', 'stop-latched', 'robot-lost', 'robot-gone', 'everything'];
for (const state of STATES) {
  test(`STOP is in its corner, on top, in every size: ${state}`, async ({ stage }) => {
    const page = await stage.open({ state, canvas: '64x36', forMs: 2500 });
    for (const { width, height, isTouched } of SCREENS) {
      await stage.touched(isTouched);
      await stage.resize(width, height);
      expect(await corner(page), `${width} × ${height}`).toEqual([18, 18]);
      expect(await isOnTop(page)).toBe(true);
      const band = page.locator('#stop-band');
      if (await band.isVisible()) expect((await band.boundingBox())?.width).toBe(width);
    }
  });
}

for (const [name, open] of Object.entries({
  Settings: async (page: Page) => page.locator('#settings-open').click(),
  Events: async (page: Page) => page.locator('#events-open').click(),
  Grants: async (page: Page) => {
    await page.locator('#settings-open').click();
    await page.getByRole('button', { name: /Grants and robots/ }).click();
  },
  Inputs: async (page: Page) => {
    // The settings stay open beneath.
    if (!(await page.locator('#settings').isVisible())) await page.locator('#settings-open').click();
    await page.locator('#inputs-open').click();
  },
  Help: async (page: Page) => page.locator('#help-open').click(),
})) {
  test(`STOP is in reach while a dialog is open: ${name}`, async ({ stage }) => {
    const page = await stage.open();
    const dialog = page.getByRole('dialog', { name });
    for (const { width, height, isTouched } of SCREENS) {
      await stage.touched(isTouched);
      await stage.resize(width, height);
      await open(page);
      await expect(dialog).toBeVisible();
      expect(await isOnTop(page)).toBe(true);
      const [box, stop] = [await dialog.boundingBox(), await page.locator('#estop').boundingBox()];
      if (box === null || stop === null) throw new Error('not there');
      const isApart = box.x + box.width <= stop.x || box.y + box.height <= stop.y;
      expect(isApart, `${width} × ${height}`).toBe(true);
      expect(box.y + box.height).toBeLessThanOrEqual(height);
      expect(box.x + box.width).toBeLessThanOrEqual(width);
      await stage.forget();
      await page.locator('#estop').click();
      await stage.run(100);
      expect((await stage.sent('estop')).length).toBeGreaterThan(0);
      // Escape closes it, and what had the focus has it again.
      await page.keyboard.press('Escape');
      await expect(dialog).toBeHidden();
    }
  });
}

test('X is a letter where text is typed, and F9 stops even there; a box to be ticked takes no letters', async ({
  stage,
}) => {
  const page = await stage.open();
  await page.locator('#settings-open').click();
  const settings = page.getByRole('dialog', { name: 'Settings' });
  const name = settings.getByLabel('Your name');
  await name.press('x');
  await stage.run(300);
  expect(await stage.sent('estop')).toEqual([]);
  await expect(name).toHaveValue(/x$/);
  await name.press('F9');
  await stage.run(300);
  expect((await stage.state()).estop).toBe(true);
  await stage.forget();
  await settings.getByLabel(/Sound and vibration/).press('x');
  await stage.run(100);
  expect((await stage.sent('estop')).length).toBeGreaterThan(0);
  // What is behind the dialog takes no focus.
  for (let i = 0; i < 40; i++) {
    await page.keyboard.press('Tab');
    const behind = () => document.activeElement?.closest('#bar, #hud, #side, #stage, #drive')?.id ?? null;
    expect(await page.evaluate(behind)).toBeNull();
  }
});

test('the band says who pressed it and why it is on; only who may release it gets the control', async ({
  stage,
}) => {
  const page = await stage.open({ state: 'stop-by-other' });
  const [band, release, notice] = ['#stop-band', '#estop-release', '#notice'].map((id) =>
    page.locator(id),
  ) as [ReturnType<Page['locator']>, ReturnType<Page['locator']>, ReturnType<Page['locator']>];
  await stage.run(300);
  await expect(band).toHaveText(
    /Emergency stop.*Bo pressed STOP\..*Bo releases it\. To do it yourself, take over/,
  );
  await expect(release).toBeHidden();
  // Whoever holds the key all the same is told at once, and not after a second.
  await page.keyboard.down('KeyR');
  await stage.run(100);
  await expect(notice).toHaveText(/^Bo releases it/);
  await stage.run(1500);
  await page.keyboard.up('KeyR');
  expect(await stage.sent('estop')).toEqual([]);

  await stage.script(({ robot }) => robot.giveLease('you'));
  await stage.run(300);
  await expect(release).toBeVisible();
  await expect(band).toContainText('Hold the release control for one second');
  await page.keyboard.down('KeyR');
  await stage.run(1200);
  await page.keyboard.up('KeyR');
  await stage.run(300);
  await expect(band).toBeHidden();
  await expect(release).toBeHidden();
});
