/** No state of the page breaks a rule of accessibility that a program can check, in any theme and on any screen. */
import type { StageStateName } from '@farpoint/webxr/stage-states';
import type { Page } from '@playwright/test';
import { expectAccessible } from '../src/stage/accessibility.ts';
import { expect, test } from '../src/stage/page-test.ts';

const SCREENS = [
  { width: 1280, height: 720, isTouched: false },
  { width: 360, height: 740, isTouched: true },
  { width: 667, height: 320, isTouched: true },
] as const;
const THEMES = [
  { theme: 'light', colorScheme: 'light', contrast: 'no-preference' },
  { theme: 'contrast', colorScheme: 'dark', contrast: 'more' },
  { theme: 'dark', colorScheme: 'dark', contrast: 'no-preference' },
] as const;

interface Audited {
  readonly what: string;
  readonly state: StageStateName;
  /** When the state has come about, ms. */
  readonly forMs?: number;
  /** More than there is room for on a phone: its panels are reached by scrolling. */
  readonly onLaptopsOnly?: true;
  open?(page: Page): Promise<void>;
}

const openSettings = (page: Page) => page.locator('#settings-open').click();

const AUDITED: readonly Audited[] = [
  { what: 'the list of robots', state: 'disconnected' },
  { what: 'a list of many robots that tell what they do', state: 'fleet' },
  { what: 'the settings', state: 'live', open: openSettings },
  {
    what: 'the grants',
    state: 'live',
    async open(page) {
      await openSettings(page);
      await page.locator('#access-open').click();
    },
  },
  {
    what: 'the inputs, while a joystick is set up',
    state: 'live',
    async open(page) {
      await page.evaluate(() => {
        const buttons = [{ pressed: false, touched: false, value: 0 }];
        navigator.getGamepads = () => [{ id: 'Stick', mapping: '', axes: [0, 0], buttons }] as never;
      });
      await openSettings(page);
      await page.locator('#inputs-open').click();
      await page.getByRole('button', { name: 'Set up Stick' }).click();
    },
  },
  {
    what: 'the event log',
    state: 'stop-latched',
    forMs: 1000,
    open: (page) => page.locator('#events-open').click(),
  },
  { what: 'the help', state: 'live', open: (page) => page.locator('#help-open').click() },
  {
    what: 'the first drive',
    state: 'live',
    async open(page) {
      await page.locator('#help-open').click();
      await page.locator('#tour-start').click();
    },
  },
  { what: 'driving', state: 'driving', forMs: 1000 },
  { what: 'an emergency stop that is latched', state: 'stop-latched', forMs: 1000 },
  { what: 'the dashboard', state: 'alarm', open: (page) => page.locator('#dashboard-open').click() },
  { what: 'the commands', state: 'commands', open: (page) => page.locator('#commands summary').click() },
  { what: 'everything at once', state: 'everything', forMs: 1500, onLaptopsOnly: true },
];

for (const { what, state, forMs, onLaptopsOnly = false, open } of AUDITED)
  test(`axe finds nothing wrong with ${what}`, async ({ stage }) => {
    const page = await stage.open({ state, canvas: '64x36', ...(forMs === undefined ? {} : { forMs }) });
    await open?.(page);
    // The page follows the system while it is open: what a state takes to come about, it takes once.
    for (const { theme, ...preference } of THEMES) {
      await page.emulateMedia(preference);
      // The browser says so with its next picture.
      await expect(page.locator('html')).toHaveAttribute('data-theme', theme);
      for (const { width, height, isTouched } of SCREENS) {
        // A theme has the same colours on every screen.
        if (isTouched && (onLaptopsOnly || theme !== 'dark')) continue;
        await stage.touched(isTouched);
        await stage.resize(width, height);
        await stage.run(500);
        await expectAccessible(stage, `${what}, ${theme}, ${width} × ${height}`);
      }
    }
  });
