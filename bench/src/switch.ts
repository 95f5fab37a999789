/** `pnpm bench switch`: how long it takes from choosing another robot to its first cloud on the screen. */
import type {} from '@farpoint/webxr/test-api';
import type { Page } from '@playwright/test';
import { benchOptions, option } from './bench-options.ts';
import { startLiveStack } from './live-stack.ts';
import { type Bench, distributionCells, printJson, printTable } from './report.ts';
import { distribution, rounded } from './stats.ts';

const USAGE = `pnpm bench switch [--count 20] [--canvas 160x90] [--driven] [--json]

Real signaling, two robots (simulated office) and headless Chromium, without a network between them. The page switches from
one robot to the other --count times, by the list in its bar. left: until the first robot is left; session: until the session
with the other is established; cloud: until its first cloud has been drawn, by the page's clock. --driven: the first robot is
driven at the time, and must have stopped before it is left.`;

const ROBOTS = ['sim-1', 'sim-2'] as const;
const ARGS = ['--sim-size', '128'];
/** A robot that has just been chosen is at full speed after this, ms. */
const DRIVE_MS = 1500;

interface Times {
  left: number;
  session: number;
  cloud: number;
}

export const bench: Bench = {
  name: 'switch',
  summary: 'time from choosing another robot to its first cloud on the screen',
  usage: USAGE,
  async run(argv) {
    const { count, canvas, driven, json } = benchOptions(argv, {
      count: option.number(20, { least: 1 }),
      canvas: option.text('160x90'),
      driven: option.flag,
    });
    const [first, second] = ROBOTS.map((id) => ({ id, name: id, args: ARGS }));
    if (first === undefined || second === undefined) throw new Error('two robots are needed');
    const live = await startLiveStack({ robot: first, otherRobots: [second], canvas, log: console.error });
    try {
      const times: Times[] = [];
      for (let i = 0; i < count; i++) {
        if (driven)
          await live.page.evaluate((ms) => void window.farpoint.drive({ forward: 1, left: 0 }, ms), DRIVE_MS);
        await live.page.waitForTimeout(driven ? DRIVE_MS / 2 : 500);
        times.push(await switchTo(live.page, ROBOTS[(i + 1) % 2] as string));
      }
      const results = Object.fromEntries(
        (['left', 'session', 'cloud'] as const).map((name) => [
          name,
          rounded(distribution(times.map((each) => each[name])), 0),
        ]),
      );
      printTable(
        ['ms from the choice', 'p50', 'p95', 'p99', 'max'],
        Object.entries(results).map(([name, values]) => [name, ...distributionCells(values)]),
      );
      if (json) printJson({ bench: 'switch', count, driven, ...results });
    } finally {
      await live.close();
    }
  },
};

/** Switches as an operator does. Times are in ms from the choice. */
function switchTo(page: Page, robotId: string): Promise<Times> {
  return page.evaluate(async (wanted) => {
    const { farpoint } = window;
    const { sessionsOpened } = farpoint.state();
    const choice = document.querySelector<HTMLSelectElement>('#robot-switch');
    if (choice === null) throw new Error('the page has no list of robots in its bar');
    const beganMs = performance.now();
    const until = (holds: () => boolean) =>
      new Promise<number>((resolve) => {
        const channel = new MessageChannel();
        channel.port1.onmessage = () => {
          if (holds()) resolve(performance.now() - beganMs);
          else setTimeout(() => channel.port2.postMessage(null), 4);
        };
        channel.port2.postMessage(null);
      });
    choice.value = wanted;
    choice.dispatchEvent(new Event('change'));
    const left = await until(
      () => farpoint.state().robotId === wanted && farpoint.state().session !== 'live',
    );
    const session = await until(() => farpoint.state().sessionsOpened > sessionsOpened);
    const { framesDrawn } = farpoint.stats();
    const cloud = await until(() => farpoint.stats().framesDrawn > framesDrawn);
    return { left, session, cloud };
  }, robotId);
}
