import { join } from 'node:path';
import { chromiumLaunchOptions, findHeadlessShell } from '@farpoint/local-stack';
import { defineConfig } from '@playwright/test';
import { voiceFlags } from './src/voice.ts';

/**
 * `pnpm test` runs a failed test again, alone, and names the folder for what it leaves behind, by which the failure is to be
 * understood.
 */
const secondRun = process.env.FARPOINT_SECOND_RUN ?? '';
const isSecondRun = secondRun !== '';
const outputOf = (project: string): string => join('output', isSecondRun ? secondRun : project);

const browser = chromiumLaunchOptions();
const FIREFOX = 'firefox*.smoke.ts';

export default defineConfig({
  projects: [
    // The page without a robot, on a clock of its own: nothing to wait for, so a test that takes long hangs.
    {
      ...{ name: 'page', testDir: 'pages', testMatch: '*.page.ts', outputDir: outputOf('page') },
      // Each test has a page of its own, and nothing else.
      fullyParallel: true,
      ...{ timeout: 60_000, expect: { timeout: 10_000 } },
      use: { launchOptions: chromiumLaunchOptions(findHeadlessShell() ?? undefined) },
    },
    // One stack and one software-rendered browser at a time, because two would slow each other down.
    {
      ...{ name: 'smoke', testDir: 'smoke', testMatch: '*.smoke.ts', testIgnore: FIREFOX },
      ...{ outputDir: outputOf('smoke'), workers: 1 },
      use: {
        permissions: ['microphone'],
        launchOptions: { ...browser, args: [...(browser.args ?? []), ...voiceFlags()] },
      },
    },
    // Uses only Playwright's runner. Firefox itself is driven through WebDriver BiDi (FirefoxBrowser of
    // @farpoint/local-stack).
    {
      ...{ name: 'firefox', testDir: 'smoke', testMatch: FIREFOX },
      ...{ outputDir: outputOf('firefox'), workers: 1 },
    },
  ],
  workers: 2,
  retries: 0,
  timeout: 120_000,
  expect: { timeout: 30_000 },
  forbidOnly: process.env.CI !== undefined,
  reporter: [['list']],
  use: {
    launchOptions: browser,
    viewport: { width: 960, height: 540 },
    // Playwright's own browsers ask for light pages.
    colorScheme: 'dark',
    // A trace has each WebSocket frame and each change of the page: it makes a page slow that draws in software.
    trace: isSecondRun ? { mode: 'on', screenshots: false } : 'off',
    screenshot: isSecondRun ? 'only-on-failure' : 'off',
    // An action that waits for ever is named as such, not as the test's time-out.
    actionTimeout: 40_000,
  },
});
