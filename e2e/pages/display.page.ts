/** The page's own look, and settings that count at once while the session goes on. */
import type { Page } from '@playwright/test';
import { expectNothingCovered } from '../src/stage/boxes.ts';
import { expect, test } from '../src/stage/page-test.ts';
import type { Stage } from '../src/stage/stage.ts';

const DARK = 'rgb(11, 15, 20)';
const LIGHT = 'rgb(243, 246, 248)';
const BLACK = 'rgb(0, 0, 0)';

const dialog = (page: Page) => page.getByRole('dialog', { name: 'Settings' });
const save = (page: Page) => dialog(page).getByRole('button', { name: /^Save/ });
const openSettings = (page: Page) => page.locator('#settings-open').click();

async function expectGround(page: Page, colour: string): Promise<void> {
  await expect(page.locator('html')).toHaveCSS('background-color', colour);
}

async function choose(page: Page, label: string, choice: string): Promise<void> {
  await openSettings(page);
  await dialog(page).getByLabel(label).selectOption(choice);
  await save(page).click();
}

/** A page that is loaded anew has forgotten it. */
async function mark(page: Page): Promise<void> {
  await page.evaluate(() => Object.assign(window, { isMarked: true }));
}

/** The session is the one from before, its frames come, and the page was not loaded anew. */
async function expectGoesOn(stage: Stage): Promise<void> {
  const { framesDrawn } = await stage.stats();
  await stage.run(500);
  expect((await stage.stats()).framesDrawn).toBeGreaterThan(framesDrawn);
  expect(await stage.state()).toMatchObject({ session: 'live', sessionsOpened: 1 });
  expect(await stage.page.evaluate(() => 'isMarked' in window)).toBe(true);
}

test('the colours follow the system or the operator’s choice, at once and at the next visit', async ({
  stage,
}) => {
  const page = await stage.open({ canvas: '64x36' });
  await mark(page);
  await page.emulateMedia({ colorScheme: 'dark' });
  await expectGround(page, DARK);
  await page.emulateMedia({ colorScheme: 'light' });
  await expectGround(page, LIGHT);
  await expect(page.locator('meta[name="theme-color"]')).toHaveAttribute('content', '#f3f6f8');
  await page.emulateMedia({ colorScheme: 'light', contrast: 'more' });
  await expectGround(page, BLACK);
  await choose(page, 'Colours', 'dark');
  await expectGround(page, DARK);
  await expectGoesOn(stage);
  await stage.reload();
  await expectGround(page, DARK);
});

test('a choice shows at once, and Cancel takes it back', async ({ stage }) => {
  const page = await stage.open({ canvas: '64x36', stored: { 'farpoint.display': { theme: 'dark' } } });
  await openSettings(page);
  await dialog(page).getByLabel('Colours').selectOption('light');
  await expectGround(page, LIGHT);
  await dialog(page).getByRole('button', { name: 'Cancel' }).click();
  await expectGround(page, DARK);
});

test('canvases have the theme’s colours, at once', async ({ stage }) => {
  const page = await stage.open({ canvas: '64x36', stored: { 'farpoint.display': { theme: 'dark' } } });
  await page.locator('#dashboard-open').click();
  await page.locator('#dashboard .map canvas').waitFor();
  /** At a corner, where nothing is drawn. */
  const corner = () =>
    page.evaluate(() => {
      const canvas = document.querySelector<HTMLCanvasElement>('#dashboard .map canvas');
      return [...(canvas?.getContext('2d')?.getImageData(1, 1, 1, 1).data ?? [])];
    });
  await stage.run(500);
  expect(await corner()).toEqual([11, 15, 20, 255]);
  await choose(page, 'Colours', 'light');
  await stage.run(500);
  expect(await corner()).toEqual([243, 246, 248, 255]);
});

for (const state of ['driving', 'stop-latched', 'obstacle-ahead', 'people', 'videos'] as const)
  test(`text of twice the size covers nothing: ${state}`, async ({ stage }) => {
    // Until the notice on connecting has gone.
    const page = await stage.open({ state, canvas: '64x36', forMs: 8000 });
    const size = () =>
      page.locator('#facts').evaluate((facts) => Number.parseFloat(getComputedStyle(facts).fontSize));
    await stage.resize(1280, 720);
    const before = await size();
    await openSettings(page);
    await dialog(page).getByLabel('Size of the text').fill('2');
    await save(page).click();
    expect(await size()).toBe(2 * before);
    for (const [width, height] of [
      [1280, 720],
      [1920, 1080],
    ] as const) {
      await stage.resize(width, height);
      await expectNothingCovered(page, `${width} × ${height}`);
    }
    await stage.touched(true);
    await stage.resize(360, 740);
    await expectNothingCovered(page, '360 × 740');
    await page.locator('#estop').click({ trial: true });
  });

test('reduced motion: from the system, or as chosen', async ({ stage }) => {
  const page = await stage.open({ canvas: '64x36' });
  const motion = page.locator('html');
  await expect(motion).toHaveAttribute('data-motion', 'full');
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await expect(motion).toHaveAttribute('data-motion', 'reduced');
  await choose(page, 'Movement', 'full');
  await expect(motion).toHaveAttribute('data-motion', 'full');
});

test('settings count at once, and the session goes on', async ({ stage }) => {
  const page = await stage.open({ state: 'videos', canvas: '64x36' });
  await mark(page);
  await openSettings(page);
  await dialog(page).getByLabel('Point size').fill('2.5');
  await expect(dialog(page).locator('output').filter({ hasText: '2.50 ×' })).toBeVisible();
  await dialog(page)
    .getByLabel(/^Show in step/)
    .uncheck();
  await dialog(page).getByLabel(/^Step/).selectOption('45');
  await expect(save(page)).toHaveText('Save');
  await save(page).click();
  await expectGoesOn(stage);
  await expect(page.locator('.video-report button')).toHaveText('Not in step');
  const kept = await page.evaluate(() => JSON.parse(localStorage.getItem('farpoint.settings') ?? '{}'));
  expect(kept).toMatchObject({ pointScale: 2.5, synchronised: false, headset: { snapDegrees: 45 } });
});

test('another service, token or name needs another connection, and the button says so', async ({ stage }) => {
  const page = await stage.open({ canvas: '64x36' });
  for (const label of ['Your name', 'Token']) {
    await openSettings(page);
    await dialog(page).getByLabel(label).fill('another');
    await expect(save(page)).toHaveText('Save and reconnect');
    await dialog(page).getByLabel(label).fill('');
    await expect(save(page)).toHaveText('Save');
    await dialog(page).getByRole('button', { name: 'Cancel' }).click();
  }
  await openSettings(page);
  await dialog(page).getByLabel('Your name').fill('Ada');
  const loaded = page.waitForEvent('load');
  await dialog(page).getByLabel('Your name').press('Enter');
  await loaded;
  expect(await page.evaluate(() => localStorage.getItem('farpoint.settings'))).toContain('"name":"Ada"');
});

test('the settings fit on small screens, and their buttons are always in view', async ({ stage }) => {
  const page = await stage.open({ canvas: '64x36' });
  await openSettings(page);
  await expect(dialog(page).getByRole('group')).toHaveCount(6);
  for (const textScale of ['1', '2'])
    for (const [width, height] of [
      [1280, 720],
      [360, 740],
      [667, 320],
    ] as const) {
      await stage.resize(width, height);
      await dialog(page).getByLabel('Size of the text').fill(textScale);
      for (const place of ['first', 'last'] as const) {
        await dialog(page).locator('label')[place]().scrollIntoViewIfNeeded();
        for (const name of ['Cancel', 'Save'])
          await expect(dialog(page).getByRole('button', { name })).toBeInViewport({ ratio: 1 });
        await save(page).click({ trial: true });
      }
      const wider = await dialog(page)
        .locator('.fields')
        .evaluate((fields) => fields.scrollWidth - fields.clientWidth);
      expect(wider, `${width} × ${height} at ${textScale}`).toBeLessThanOrEqual(0);
    }
});

test('the screen stays on while a robot is shown, unless the operator does not want that', async ({
  stage,
}) => {
  const { page } = stage;
  await page.addInitScript(() => {
    const held = new Set<object>();
    Object.assign(window, { heldLocks: held });
    const request = async () => {
      const lock = Object.assign(new EventTarget(), { release: async () => void held.delete(lock) });
      held.add(lock);
      return lock;
    };
    Object.defineProperty(navigator, 'wakeLock', { value: { request } });
  });
  const held = () => page.evaluate(() => (window as unknown as { heldLocks: Set<object> }).heldLocks.size);
  await stage.open({ canvas: '64x36' });
  expect(await held()).toBe(1);
  await openSettings(page);
  await dialog(page)
    .getByLabel(/^Keep the screen on/)
    .uncheck();
  expect(await held()).toBe(0);
  await dialog(page)
    .getByLabel(/^Keep the screen on/)
    .check();
  await save(page).click();
  expect(await held()).toBe(1);
  await page.locator('#disconnect').click();
  await stage.run(500);
  expect(await held()).toBe(0);
});

test('the page may be enlarged by fingers, but not from where hands drive', async ({ stage }) => {
  const page = await stage.open({ canvas: '64x36' });
  await expect(page.locator('meta[name="viewport"]')).not.toHaveAttribute(
    'content',
    /user-scalable|maximum-scale/,
  );
  for (const part of ['#stage', '#joystick'])
    await expect(page.locator(part)).toHaveCSS('touch-action', 'none');
});

test('the page has a heading and a title with the robot’s name, and the picture shows that it has the focus', async ({
  stage,
}) => {
  const page = await stage.open({ canvas: '64x36' });
  await expect(
    page.getByRole('main').getByRole('heading', { level: 1, name: 'Robot on a stage' }),
  ).toBeAttached();
  await expect(page).toHaveTitle('Robot on a stage – Farpoint');
  await page.locator('#stage').focus();
  await page.keyboard.press('Shift');
  await expect(page.locator('#stage')).toHaveCSS('outline-style', 'solid');
  await page.locator('#disconnect').click();
  await stage.run(500);
  await expect(page).toHaveTitle('Farpoint');
});

test('the whole screen, and back', async ({ stage }) => {
  const page = await stage.open({ canvas: '64x36' });
  await openSettings(page);
  const button = dialog(page).getByRole('button', { name: 'Full screen' });
  await button.click();
  await expect(button).toHaveAttribute('aria-pressed', 'true');
  await expect(save(page)).toBeInViewport();
  await save(page).click({ trial: true });
  await button.click();
  await expect(button).toHaveAttribute('aria-pressed', 'false');
});
