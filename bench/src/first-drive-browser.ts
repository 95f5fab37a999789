/** The browsers of `pnpm bench first-drive`, each with a newcomer's hand in it. */
import { chromiumLaunchOptions, FirefoxBrowser, wearEmulatedHeadset } from '@farpoint/local-stack';
import { chromium } from '@playwright/test';
import {
  type DriveKey,
  type DrivenPage,
  type Hand,
  handOnController,
  handOnKeys,
  pause,
} from './first-drive-hand.ts';

export const FIRST_DRIVE_BROWSERS = ['chromium', 'firefox'] as const;
export type FirstDriveBrowser = (typeof FIRST_DRIVE_BROWSERS)[number];

export interface FirstDriveOptions {
  kind: FirstDriveBrowser;
  /** CSS pixels. */
  viewport: { width: number; height: number };
  /** How many times slower the page's main thread is; Chromium only. */
  throttle: number;
  /** Whether an emulated headset is worn; Chromium only. */
  headset: boolean;
}

/** A page that shows the robot, and what drives it. */
export interface FirstDrive {
  page: DrivenPage;
  hold: Hand;
  close(): Promise<void>;
}

/** The robot must be there, and its picture, within so long. */
const WAIT_MS = 60_000;
const LOOKS_MS = 100;

/**
 * Opens the address, chooses the robot, and waits for its picture.
 *
 * @throws {Error} if there is none in time
 */
export async function openFirstDrive(address: string, options: FirstDriveOptions): Promise<FirstDrive> {
  const drive = await (options.kind === 'firefox'
    ? inFirefox(address, options)
    : inChromium(address, options));
  try {
    await clickWhenThere(drive.page, '#robot-list button');
    await until(drive.page, () => window.farpoint.stats().framesDrawn > 5);
    if (options.headset) {
      await clickWhenThere(drive.page, '#vr');
      await until(drive.page, () => window.farpoint.state().vr);
    }
    return drive;
  } catch (error) {
    await drive.close();
    throw error;
  }
}

async function inChromium(address: string, options: FirstDriveOptions): Promise<FirstDrive> {
  const { viewport, throttle, headset } = options;
  const browser = await chromium.launch(chromiumLaunchOptions());
  const page = await browser.newPage({ viewport });
  if (throttle > 1) {
    const devTools = await page.context().newCDPSession(page);
    await devTools.send('Emulation.setCPUThrottlingRate', { rate: throttle });
  }
  if (headset) await wearEmulatedHeadset(page);
  await page.goto(address);
  const driven = page as unknown as DrivenPage;
  const hold = headset ? handOnController(driven) : handOnKeys(page.keyboard);
  return { page: driven, hold, close: () => browser.close() };
}

async function inFirefox(address: string, { viewport }: FirstDriveOptions): Promise<FirstDrive> {
  const browser = await FirefoxBrowser.launch();
  const page = await browser.newPage();
  await page.setViewport(viewport);
  await page.goto(address);
  // WebDriver BiDi names keys by what they write.
  const written = (key: DriveKey) =>
    key === 'Space' ? ' ' : (key.slice(-1).toLowerCase() as 'w' | 'a' | 'd');
  const hold = handOnKeys({
    down: (key) => page.keyboard.down(written(key)),
    up: (key) => page.keyboard.up(written(key)),
  });
  return { page: page as unknown as DrivenPage, hold, close: () => browser.close() };
}

async function clickWhenThere(page: DrivenPage, selector: string): Promise<void> {
  const click = (selector: string) => {
    const button = document.querySelector<HTMLElement>(selector);
    if (button === null || button.hidden) return false;
    button.click();
    return true;
  };
  await waitFor(() => page.evaluate(click, selector), selector);
}

async function until(page: DrivenPage, is: () => boolean): Promise<void> {
  await waitFor(() => page.evaluate(is, null as never), 'the picture');
}

async function waitFor(is: () => Promise<boolean>, what: string): Promise<void> {
  for (let waitedMs = 0; waitedMs < WAIT_MS; waitedMs += LOOKS_MS) {
    if (await is().catch(() => false)) return;
    await pause(LOOKS_MS);
  }
  throw new Error(`no ${what} within ${WAIT_MS / 1000} s`);
}
