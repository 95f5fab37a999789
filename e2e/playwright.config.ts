import { chromiumLaunchOptions } from '@farpoint/local-stack';
import { defineConfig } from '@playwright/test';
import { LONG, runsLong } from './src/long.ts';

// A software-rendered page shows its robot late: too late for a robot of default limits to move. Tests of those limits set
// their own.
for (const [name, value] of [
  ['VIEW_SLOW_MS', '3000'],
  ['VIEW_BRAKE_MS', '4000'],
  ['VIEW_STALL_MS', '3000'],
  ['BLIND_TRAVEL_M', '8'],
  // Its camera does not see the floor before its wheels: it would set off too slowly for tests.
  ['GUARD_UNSEEN_MPS', '10'],
] as const)
  process.env[`FARPOINT_ROBOT_${name}`] ??= value;

export default defineConfig({
  projects: [
    { name: 'chromium', testDir: 'tests', outputDir: 'output/chromium' },
    // Uses only Playwright's runner. Firefox itself is driven through WebDriver BiDi (FirefoxBrowser of
    // @farpoint/local-stack).
    { name: 'firefox', testDir: 'firefox', outputDir: 'output/firefox' },
  ],
  ...(runsLong ? {} : { grepInvert: new RegExp(LONG) }),
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
    colorScheme: 'dark',
    // A trace of each test costs a twentieth of the time. `--trace retain-on-failure` shows where a test failed.
    trace: 'off',
    screenshot: 'only-on-failure',
    // An action that waits for ever is named as such, not as the test's time-out.
    actionTimeout: 40_000,
  },
});
