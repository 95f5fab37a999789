import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { LocalStack, repositoryRoot, type StackSpec } from '@farpoint/local-stack';
import { test as base } from '@playwright/test';
import { OperatorPage } from './operator-page.ts';

/** The built web app; `pnpm build` makes it. */
export const webRoot = join(repositoryRoot, 'apps', 'webxr', 'dist');

/** Recorded clouds that lie beside the repository on some machines; tests that use them skip where they are absent. */
export const cloudsFolder = join(repositoryRoot, '..', 'shared', 'data', 'clouds');

export interface StackFixtures {
  /** Starts a stack of the real programs that lasts as long as the test. */
  startStack: (spec?: Partial<StackSpec>) => Promise<LocalStack>;
  /** Starts a stack with {@link simulatedRobot} and opens the page on it; its points are drawn. */
  openRobot: () => Promise<{ stack: LocalStack; operator: OperatorPage }>;
}

export const simulatedRobot = {
  id: 'sim-1',
  name: 'Simulated robot 1',
  args: ['--source', 'sim', '--sim-seed', '1', '--mode', 'points64', '--max-points', '15000'],
};

/** Two of them, light enough to stream one after the other. */
export const twoRobots = [1, 2].map((n) => ({
  id: `sim-${n}`,
  name: `Simulated robot ${n}`,
  args: [
    '--source',
    'sim',
    '--sim-seed',
    String(n),
    '--mode',
    'points64',
    '--max-points',
    '6000',
    '--fps',
    '15',
  ],
}));

export const test = base.extend<StackFixtures>({
  startStack: async ({ browserName: _ }, use, testInfo) => {
    if (!existsSync(join(webRoot, 'index.html')))
      throw new Error('the web app is not built: run `pnpm build`');
    const stacks: LocalStack[] = [];
    const lines: string[] = [];
    await use(async (spec = {}) => {
      const stack = await LocalStack.start({
        webRoot,
        robots: [simulatedRobot],
        onLine: (name, line) => lines.push(`${name} ${line}`),
        ...spec,
      });
      stacks.push(stack);
      return stack;
    });
    for (const stack of stacks) await stack.stop();
    if (testInfo.status !== testInfo.expectedStatus) {
      await testInfo.attach('programs.log', { body: lines.join('\n'), contentType: 'text/plain' });
    }
  },
  openRobot: async ({ page, startStack }, use) => {
    await use(async () => {
      const stack = await startStack();
      const operator = await OperatorPage.open(page, stack, { robot: simulatedRobot.id });
      await operator.expectPoints();
      return { stack, operator };
    });
  },
});

export { expect } from '@playwright/test';
