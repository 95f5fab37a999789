/** Tests with the real programs and a real browser: one stack for all tests of a worker. */
import { existsSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import {
  EmulatedLink,
  LocalStack,
  type RobotSpec,
  repositoryRoot,
  type StackSpec,
} from '@farpoint/local-stack';
import { test as base } from '@playwright/test';
import { SharedStack } from './shared-stack.ts';

/** The web app, built with `window.farpoint`. `pnpm build` makes it. */
const webRoot = join(repositoryRoot, 'apps', 'webxr', 'dist-testing');

export interface SmokeFixtures {
  /** Starts a robot beside the shared ones that lasts as long as the test: where it drives to is nobody else's matter. */
  startRobot: <Robot extends RobotSpec>(robot: Robot) => Promise<Robot>;
  /** Starts one of which all packets pass through an emulated link, with the link's flags. */
  startBehindLink: (robot: RobotSpec, flags: string[]) => Promise<EmulatedLink>;
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
  startRobot: ({ shared }, use) =>
    stoppingAfter((later) =>
      use(async (robot) => {
        later(() => shared.stack.robot(robot.id).stop());
        await shared.stack.startRobot(robot);
        return robot;
      }),
    ),
  startBehindLink: ({ shared, startRobot }, use) =>
    stoppingAfter((later) =>
      use(async (robot, flags) => {
        const link = await EmulatedLink.start(shared.stack, { args: flags });
        later(() => link.stop());
        await startRobot({ ...robot, args: [...(robot.args ?? []), '--signaling', link.signalingUrl] });
        return link;
      }),
    ),
  // biome-ignore lint/correctness/noEmptyPattern: Playwright reads the names of fixtures from the pattern.
  startStack: ({}, use, testInfo) =>
    stoppingAfter(async (later) => {
      const lines: string[] = [];
      await use(async (spec) => {
        const onLine = (name: string, line: string) => lines.push(`${name} ${line}`);
        const stack = await LocalStack.start({ webRoot, robots: [], onLine, ...spec });
        later(() => stack.stop());
        return stack;
      });
      // Before the programs are stopped: what they say of that explains no failure.
      if (testInfo.status !== testInfo.expectedStatus && lines.length > 0)
        keep(`${lines.join('\n')}\n`, testInfo.outputPath('own-programs.log'), testInfo);
    }),
  programLogs: [
    async ({ shared }, use, testInfo) => {
      await use(undefined);
      if (testInfo.status !== testInfo.expectedStatus)
        keep(shared.log, testInfo.outputPath('programs.log'), testInfo);
    },
    { auto: true },
  ],
});

/** Stops what a test has started, when it is over. @param use is given what notes how to stop something then */
async function stoppingAfter(use: (later: (stop: () => Promise<unknown>) => void) => Promise<void>) {
  const stops: (() => Promise<unknown>)[] = [];
  await use((stop) => stops.push(stop));
  const faults: unknown[] = [];
  for (const stop of stops) await stop().catch((fault: unknown) => faults.push(fault));
  if (faults.length > 0) throw faults[0];
}

function keep(text: string, path: string, { attachments }: ReturnType<typeof test.info>): void {
  writeFileSync(path, text);
  attachments.push({ name: 'programs.log', path, contentType: 'text/plain' });
}

export { expect } from './expect.ts';
