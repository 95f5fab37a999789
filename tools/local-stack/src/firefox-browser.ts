import type { Browser, Page } from 'puppeteer-core';
import { findFirefox, firefoxNeedsDisplay } from './firefox.ts';
import { VirtualDisplay } from './virtual-display.ts';

const WINDOW = { width: 960, height: 540 };

/** An unmodified Firefox, driven by WebDriver BiDi, with software rendering. */
export class FirefoxBrowser {
  readonly #browser: Browser;
  readonly #display: VirtualDisplay | null;

  private constructor(browser: Browser, display: VirtualDisplay | null) {
    this.#browser = browser;
    this.#display = display;
  }

  /** @throws {Error} if there is none, or it does not start */
  static async launch(): Promise<FirefoxBrowser> {
    const executablePath = findFirefox();
    if (executablePath === null) throw new Error('no Firefox here');
    // A large library, which most users of a stack do not need.
    const { default: puppeteer } = await import('puppeteer-core');
    const display = firefoxNeedsDisplay ? await VirtualDisplay.start(1280, 800) : null;
    try {
      const browser = await puppeteer.launch({
        browser: 'firefox',
        executablePath,
        headless: display === null,
        defaultViewport: WINDOW,
        env: {
          ...process.env,
          ...(display === null ? {} : { DISPLAY: display.name, LIBGL_ALWAYS_SOFTWARE: '1' }),
        },
      });
      return new FirefoxBrowser(browser, display);
    } catch (error) {
      await display?.stop();
      throw error;
    }
  }

  version(): Promise<string> {
    return this.#browser.version();
  }

  /** Opens a tab in the foreground. */
  async newPage(): Promise<Page> {
    const page = await this.#browser.newPage();
    await page.bringToFront();
    return page;
  }

  async close(): Promise<void> {
    await this.#browser.close();
    await this.#display?.stop();
  }
}
