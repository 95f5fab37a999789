/** The page in German: what is seen first, while driving, at a stop and at a loss, and how another language is chosen. */
import type { Page } from '@playwright/test';
import { expect, test } from '../src/stage/page-test.ts';

test.use({ locale: 'de-DE' });

/** What is on the screen of these words; English ones must not be. */
const ENGLISH =
  /\b(the|you|your|robot is|driving|stop is|settings|hold|release|points|speed|battery|near|ahead|cameras)\b/i;

async function expectGerman(page: Page, places: string): Promise<void> {
  const texts = await page
    .locator(places)
    .evaluateAll((found) =>
      found
        .filter((element) => (element as HTMLElement).checkVisibility({ visibilityProperty: true }))
        .map((element) => element.textContent ?? ''),
    );
  expect(texts.join(' ').length).toBeGreaterThan(0);
  for (const text of texts) expect(text).not.toMatch(ENGLISH);
}

test('a German browser has a page in German, from the list of robots to a lost link', async ({ stage }) => {
  const page = await stage.open({ state: 'disconnected', canvas: '64x36' });
  await expect(page.locator('html')).toHaveAttribute('lang', 'de');
  await expect(page.getByRole('heading', { name: 'Roboter', exact: true })).toBeVisible();
  await expect(page.locator('#link')).toHaveText('Vermittlungsdienst verbunden');
  await page.locator('#robot-list button').first().click();
  await stage.run(500);
  await stage.script(({ robot }) => robot.giveLease('you'));
  await stage.run(500);
  await expect(page.locator('#holder')).toHaveText('Sie haben die Steuerung');
  await expect(page.locator('#facts')).toContainText('0,00 m/s');
  await expect(page.locator('#estop')).toHaveText(/^STOP/);
  await expectGerman(page, '#bar button, #facts dt, #drive button, #drive-hint, #clouds button, #estop span');
  await page.locator('#settings-open').click();
  const dialog = page.getByRole('dialog', { name: 'Einstellungen' });
  await expect(dialog.getByLabel('Sprache')).toHaveValue('system');
  await expect(dialog.locator('output').first()).toHaveText('100 %');
  await expectGerman(page, '#settings label > span, #settings legend, #settings p, #settings button');
  await dialog.getByRole('button', { name: 'Abbrechen' }).click();
  await page.locator('#estop').click();
  await stage.run(500);
  await expect(page.locator('#stop-title')).toHaveText('Nothalt');
  await expect(page.locator('#stop-why')).toHaveText(/STOP gedrückt/);
  await expectGerman(page, '#stop-band, #estop-release');
  await stage.script((control) => control.cut());
  await stage.run(2500);
  await expect(page.locator('#banner-title')).toHaveText(/^Der Roboter/);
  await expectGerman(page, '#banner');
});

test('another language is chosen in the settings, and counts once the page is loaded again', async ({
  stage,
}) => {
  const page = await stage.open({ canvas: '64x36' });
  await page.locator('#settings-open').click();
  await page.getByLabel('Sprache').selectOption('en');
  const reloaded = page.waitForEvent('load');
  await page.getByRole('button', { name: 'Speichern und neu laden' }).click();
  await reloaded;
  await expect(page.locator('html')).toHaveAttribute('lang', 'en');
  await expect(page.locator('#settings-open')).toHaveText('Settings');
});

test('the watchers’ page is in German, too', async ({ stage }) => {
  const page = await stage.openOwn({}, '/watch.html');
  await expect(page.locator('html')).toHaveAttribute('lang', 'de');
  await expect(page).toHaveTitle('Farpoint: zusehen');
  await expect(page.locator('#failure h1')).toHaveText('Nichts zu sehen');
  await expect(page.locator('#from-above')).toHaveText('Von oben');
});

test('a page that cannot load its language speaks English, and says so on the console', async ({ stage }) => {
  const told: string[] = [];
  stage.page.on('console', (message) => told.push(message.text()));
  // The first that is asked for is the German one.
  await stage.page.route(/catalogue-[^/]*\.js$/, (route) => route.abort(), { times: 1 });
  const page = await stage.open({ canvas: '64x36' });
  await expect(page.locator('html')).toHaveAttribute('lang', 'en');
  await expect(page.locator('#settings-open')).toHaveText('Settings');
  expect(told.join('\n')).toContain('the page speaks English');
});
