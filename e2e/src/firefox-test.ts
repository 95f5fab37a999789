import { FirefoxBrowser, firefoxMissing } from '@farpoint/local-stack';
import type { Page } from 'puppeteer-core';
import { test as base } from './smoke-test.ts';

/** Tests in Firefox. They are skipped, with the reason, if Firefox is unavailable. */
export const test = base.extend<{ firefoxPage: Page }, { firefox: FirefoxBrowser | string }>({
  firefox: [
    async ({ browserName: _ }, use) => {
      const missing = firefoxMissing();
      if (missing !== null) return use(missing);
      const browser = await FirefoxBrowser.launch();
      await use(browser);
      await browser.close();
    },
    { scope: 'worker' },
  ],
  firefoxPage: async ({ firefox }, use, testInfo) => {
    testInfo.skip(typeof firefox === 'string', String(firefox));
    const page = await (firefox as FirefoxBrowser).newPage();
    await use(page);
    await page.close();
  },
});

export { expect } from './expect.ts';
