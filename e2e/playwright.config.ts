import { chromiumLaunchOptions } from '@farpoint/local-stack';
import { defineConfig } from '@playwright/test';

export default defineConfig({
  projects: [
    { name: 'chromium', testDir: 'tests', outputDir: 'output/chromium' },
    // Uses only Playwright's runner. Firefox itself is driven through WebDriver BiDi (FirefoxBrowser of
    // @farpoint/local-stack).
    { name: 'firefox', testDir: 'firefox', outputDir: 'output/firefox' },
  ],
  // One stack and one software-rendered browser at a time, because two would slow each other down.
  workers: 1,
  retries: 0,
  timeout: 120_000,
  expect: { timeout: 30_000 },
  forbidOnly: process.env.CI !== undefined,
  reporter: [['list']],
  use: {
    launchOptions: chromiumLaunchOptions(),
    viewport: { width: 960, height: 540 },
    // Without its pictures: taking them is a quarter of what a test costs a software renderer.
    trace: { mode: 'retain-on-failure', screenshots: false },
    screenshot: 'only-on-failure',
  },
});
