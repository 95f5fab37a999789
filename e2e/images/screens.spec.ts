/** The documents' pictures of the page's states, dark and light: docs/images/screens. Not tests. */
import { join } from 'node:path';
import { repositoryRoot } from '@farpoint/local-stack';
import type { StageStateName } from '@farpoint/webxr/stage-states';
import type { Page } from '@playwright/test';
import { cloudFile } from '../src/stage/cloud-files.ts';
import { test } from '../src/stage/page-test.ts';

/** So seldom that a small machine draws each whole cloud, ms. */
const FRAME_MS = 500;

interface Screen {
  readonly name: string;
  readonly state: StageStateName;
  /** When the state has come about, and what was only told for a while is gone, ms. */
  readonly forMs: number;
  open?(page: Page): Promise<void>;
}

const SCREENS: readonly Screen[] = [
  { name: 'robots', state: 'fleet', forMs: 1000 },
  { name: 'driving', state: 'driving', forMs: 7000 },
  { name: 'stop', state: 'stop-latched', forMs: 7000 },
  { name: 'lost', state: 'robot-lost', forMs: 4000 },
  { name: 'asked', state: 'asked-to-drive', forMs: 7000 },
  { name: 'obstacle', state: 'obstacle-ahead', forMs: 7000 },
  { name: 'cameras', state: 'videos', forMs: 7000 },
  {
    name: 'commands',
    state: 'commands',
    forMs: 7000,
    open: (page) => page.locator('#commands summary').click(),
  },
  {
    name: 'dashboard',
    state: 'alarm',
    forMs: 7000,
    open: (page) => page.locator('#dashboard-open').click(),
  },
  {
    name: 'settings',
    state: 'live',
    forMs: 7000,
    open: (page) => page.locator('#settings-open').click(),
  },
  { name: 'help', state: 'live', forMs: 7000, open: (page) => page.locator('#help-open').click() },
  {
    name: 'events',
    state: 'stop-latched',
    forMs: 7000,
    open: (page) => page.locator('#events-open').click(),
  },
];

for (const theme of ['dark', 'light'] as const)
  for (const { name, state, forMs, open } of SCREENS)
    test(`screens ${name} ${theme}`, async ({ stage, page }) => {
      await page.setViewportSize({ width: 1280, height: 720 });
      // The scripted robot is in the simulated office.
      const body = (await cloudFile('sim-office')) ?? '';
      await page.route(/\/clouds\/light\.json$/, (route) =>
        route.fulfill({ contentType: 'application/json', body }),
      );
      const stored = { 'farpoint.display': { theme } };
      await stage.open({ state, canvas: 'full', forMs, frameMs: FRAME_MS, stored, query: { every: '1' } });
      await open?.(page);
      await stage.run(2 * FRAME_MS);
      const path = join(repositoryRoot, 'docs', 'images', 'screens', `${name}-${theme}.jpg`);
      await page.screenshot({ path, type: 'jpeg', quality: 80 });
    });
