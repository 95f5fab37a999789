/** Tests with the real programs and a real browser: one stack for all tests of a worker. */
import { existsSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { LocalStack, repositoryRoot, type StackSpec } from '@farpoint/local-stack';
import { test as base } from '@playwright/test';
import { SharedStack } from './shared-stack.ts';

/** The web app, built with `window.farpoint`. `pnpm build` makes it. */
const webRoot = join(repositoryRoot, 'apps', 'webxr', 'dist-testing');

export interface SmokeFixtures {
  /** Starts a stack that lasts as long as the test, for one that needs a signaling service of its own. */
  startStack: (spec: Partial<StackSpec>) => Promise<LocalStack>;
  /** Keeps what the programs have said, if the test fails. */
  programLogs: undefined;
}

export const test = base.extend<SmokeFixtures, { shared: SharedStack }>({
  shared: [
    // biome-ignore lint/correctness/noEmptyPattern: Playwright reads the names of fixtures from the pattern.
    async ({}, use) => {
      if (!existsSync(join(webRoot, 'index.html')))
        throw new Error('the web app is not built: run `pnpm build`');
      const shared = await SharedStack.start(webRoot);
      await use(shared);
      await shared.stack.stop();
    },
    { scope: 'worker' },
  ],
  // biome-ignore lint/correctness/noEmptyPattern: Playwright reads the names of fixtures from the pattern.
  startStack: async ({}, use, testInfo) => {
    const stacks: LocalStack[] = [];
    const lines: string[] = [];
    await use(async (spec) => {
      const onLine = (name: string, line: string) => lines.push(`${name} ${line}`);
      const stack = await LocalStack.start({ webRoot, robots: [], onLine, ...spec });
      stacks.push(stack);
      return stack;
    });
    // Before the programs are stopped: what they say of that explains no failure.
    if (testInfo.status !== testInfo.expectedStatus && lines.length > 0)
      keep(`${lines.join('\n')}\n`, testInfo.outputPath('own-programs.log'), testInfo);
    for (const stack of stacks) await stack.stop();
  },
  programLogs: [
    async ({ shared }, use, testInfo) => {
      await use(undefined);
      if (testInfo.status !== testInfo.expectedStatus)
        keep(shared.log, testInfo.outputPath('programs.log'), testInfo);
    },
    { auto: true },
  ],
});

function keep(text: string, path: string, { attachments }: ReturnType<typeof test.info>): void {
  writeFileSync(path, text);
  attachments.push({ name: 'programs.log', path, contentType: 'text/plain' });
}

export { expect } from './expect.ts';
