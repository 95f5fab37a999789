import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { repositoryRoot } from '@farpoint/local-stack';
import { test as base } from '@playwright/test';
import { noRecordings } from './recorded-clouds.ts';
import { type PageServer, servePage } from './serve-page.ts';
import { Stage } from './stage.ts';

export interface PageFixtures {
  /** The page, which {@link Stage.open} opens, with a scripted robot. Faults of the page's scripts fail the test. */
  stage: Stage;
  /** Loads recorded clouds that {@link Stage.cloud} can send then. The test is skipped where there are none. */
  loadRecordings: (...names: string[]) => Promise<void>;
}

export const test = base.extend<PageFixtures, { server: PageServer }>({
  server: [
    // biome-ignore lint/correctness/noEmptyPattern: Playwright reads the names of fixtures from the pattern.
    async ({}, use) => {
      if (!existsSync(join(repositoryRoot, 'apps/webxr/dist-testing/index.html')))
        throw new Error('the web app is not built: run `pnpm build`');
      const server = await servePage();
      await use(server);
      await server.close();
    },
    { scope: 'worker' },
  ],
  stage: async ({ page, server }, use) => {
    const faults: Error[] = [];
    page.on('pageerror', (error) => faults.push(error));
    await use(new Stage(page, server.origin));
    if (faults[0] !== undefined) throw faults[0];
  },
  loadRecordings: async ({ stage }, use, testInfo) => {
    await use(async (...names) => {
      testInfo.skip(noRecordings !== null, noRecordings ?? '');
      await stage.load(...names);
    });
  },
});

export { expect } from '@playwright/test';
