/** `pnpm bench cpu`: what a frame costs, by process and thread of the robot, the page and its browser. */
import { availableParallelism } from 'node:os';
import { simArguments } from '@farpoint/local-stack';
import type { Page } from '@playwright/test';
import { benchOptions, option } from './bench-options.ts';
import {
  type BudgetRow,
  CPU_BUDGETS,
  type CpuLoad,
  calibrationMs,
  compareWithBudget,
} from './cpu-budgets.ts';
import { type LiveStackOptions, startLiveStack } from './live-stack.ts';
import { driveInCircles } from './page.ts';
import { type Bench, printJson, printTable } from './report.ts';
import { type ProcessTree, perFrame, threadSeconds } from './thread-times.ts';

const USAGE = `pnpm bench cpu [--load drive] [--seconds 20] [--json]

Milliseconds of processor time for each cloud that the page draws, by process and thread, in the real stack: signaling, robot
(simulated office) and headless Chromium, driven in circles.

  --load drive    as \`pnpm dev\` on a computer with two cores, 1280 × 720
         sample   samples of 30,000 points, 30/s, canvas 160 × 90: the load of \`pnpm bench mtp\`
         link     whole clouds over the paper's link: the load of \`pnpm bench link --mode auto\`
  --seconds 20    how long it is measured

Beside each figure stands its budget, which cpu-budgets.ts keeps, for this computer's speed. A figure that is more than a
quarter over it is named.`;

/** The rate must have been found, and the page's pace. */
const WARM_UP_MS = 8000;
/** What takes less for a frame is added up. */
const LEAST_MS = 0.15;
/** The budgets' computer. */
const SMALL_COMPUTER_CORES = 2;

const LOADS: Readonly<Record<CpuLoad, Omit<LiveStackOptions, 'log' | 'robot'> & { args: string[] }>> = {
  drive: { args: simArguments(SMALL_COMPUTER_CORES), canvas: '1280x720', ownCanvas: true },
  sample: {
    args: [
      '--mode',
      'points64',
      '--fps',
      '30',
      '--max-points',
      '30000',
      '--rate-control',
      'fixed',
      '--plan',
      'paper',
      '--bitrate-mbps',
      '300',
    ],
    canvas: '160x90',
  },
  link: {
    args: ['--mode', 'auto', '--fps', '60'],
    canvas: '160x90',
    query: 'every=192',
    link: { args: ['--rate-mbps', '41.44', '--rtt-ms', '42.4', '--queue-ms', '100'] },
  },
};

export const bench: Bench = {
  name: 'cpu',
  summary: 'processor time of a frame, by process and thread, beside its budget',
  usage: USAGE,
  async run(argv) {
    const { load, seconds, json } = benchOptions(argv, {
      load: option.choice('drive', Object.keys(LOADS) as CpuLoad[]),
      seconds: option.number(20, { least: 1 }),
    });
    const { args, ...options } = LOADS[load];

    const speedMs = calibrationMs();
    const live = await startLiveStack({
      ...options,
      robot: { id: 'sim-1', name: 'Simulated robot', args },
      log: (line) => console.error(line),
    });
    try {
      const { page, stack, link, browserPid } = live;
      const trees: ProcessTree[] = [
        { name: 'robot', pid: stack.robot('sim-1').pid },
        { name: 'browser', pid: browserPid },
        ...(link === null ? [] : [{ name: 'link', pid: link.process.pid }]),
      ];
      const driving = page.evaluate(driveInCircles, { ms: WARM_UP_MS + seconds * 1000, forward: 0.4 });
      await page.waitForTimeout(WARM_UP_MS);
      console.error(`${seconds} s`);
      const [before, drawnBefore, beganMs] = [threadSeconds(trees), await drawn(page), performance.now()];
      await page.waitForTimeout(seconds * 1000);
      const [after, drawnAfter, endedMs] = [threadSeconds(trees), await drawn(page), performance.now()];
      await driving;
      if (before === null || after === null) throw new Error('there is no /proc here: this needs Linux');

      const frames = drawnAfter - drawnBefore;
      const msPerFrame = perFrame(before, after, frames, LEAST_MS);
      const elapsedS = (endedMs - beganMs) / 1000;
      const rows = compareWithBudget(msPerFrame, CPU_BUDGETS[load], speedMs);
      const framesPerSecond = frames / elapsedS;
      print(rows, framesPerSecond);
      if (json)
        printJson({
          bench: 'cpu',
          load,
          seconds,
          calibrationMs: speedMs,
          cores: availableParallelism(),
          framesPerSecond: Number(framesPerSecond.toFixed(1)),
          rows,
        });
    } finally {
      await live.close();
    }
  },
};

function drawn(page: Page): Promise<number> {
  return page.evaluate(() => window.farpoint.stats().framesDrawn);
}

function print(rows: readonly BudgetRow[], framesPerSecond: number): void {
  printTable(
    ['', 'ms a frame', 'budget', 'cores'],
    rows.map(({ name, ms, budgetMs }) => [
      name,
      ms,
      budgetMs,
      Number(((ms * framesPerSecond) / 1000).toFixed(3)),
    ]),
  );
  console.log(`${framesPerSecond.toFixed(1)} frames/s`);
  const over = rows.filter((row) => row.over);
  if (over.length > 0) console.log(`over budget: ${over.map(({ name }) => name).join(', ')}`);
}
