/** What a frame may cost, by process and thread, and how a figure of another computer compares with it. */

/** What is measured (`pnpm bench cpu --load`). */
export type CpuLoad = 'drive' | 'sample' | 'link';

/** Milliseconds a frame by `process: thread`, on a computer whose calibration takes {@link BUDGETS_CALIBRATION_MS}. */
export type CpuBudget = Readonly<Record<string, number>>;

/** Of the computer on which the budgets were measured: two cores without a graphics processor. */
export const BUDGETS_CALIBRATION_MS = 8.5;

/** A figure may be over its budget by this share before it is named: single runs differ so much. */
const TOLERANCE = 0.25;
/** What is over by less than this is not named, milliseconds. */
const LEAST_OVER_MS = 0.2;

export const CPU_BUDGETS: Readonly<Record<CpuLoad, CpuBudget>> = {
  drive: {
    'graphics: software renderer': 15.2,
    'page: main thread': 4.5,
    'robot: main thread': 4.3,
    'robot: capture': 3.7,
    'graphics: compositor': 3.3,
    'page: workers': 1.7,
    'graphics: chromium': 1.4,
    'page: compositor': 1.2,
    'page: WebRTC': 1.2,
    'robot: base': 1.1,
    'robot: garbage and compiler': 0.8,
    'graphics: main thread': 0.7,
    total: 42.1,
  },
  sample: {
    'graphics: software renderer': 14.8,
    'robot: capture': 6.4,
    'robot: main thread': 4.1,
    'page: main thread': 3.1,
    'page: workers': 2.8,
    'graphics: chromium': 2.1,
    'page: WebRTC': 1.8,
    'page: compositor': 0.9,
    'robot: base': 0.8,
    'graphics: compositor': 0.7,
    'graphics: main thread': 0.6,
    'robot: garbage and compiler': 0.5,
    total: 43.3,
  },
  link: {
    'robot: capture': 7.9,
    'page: workers': 4.8,
    'graphics: software renderer': 2.7,
    'robot: main thread': 2.2,
    'page: main thread': 1.8,
    'page: WebRTC': 1.1,
    'page: compositor': 0.5,
    'graphics: compositor': 0.5,
    'graphics: main thread': 0.4,
    'robot: base': 0.4,
    'robot: garbage and compiler': 0.3,
    total: 27.1,
  },
};

/** A figure and its budget. */
export interface BudgetRow {
  name: string;
  /** Milliseconds a frame. */
  ms: number;
  /** For this computer's speed; `null`: it has none. */
  budgetMs: number | null;
  /** Whether it is named as over its budget. */
  over: boolean;
}

/**
 * Compares figures with their budgets.
 *
 * @param msPerFrame by `process: thread`
 * @param calibrationMs of this computer ({@link calibrationMs})
 */
export function compareWithBudget(
  msPerFrame: ReadonlyMap<string, number>,
  budget: CpuBudget,
  calibrationMs: number,
): BudgetRow[] {
  const slower = calibrationMs / BUDGETS_CALIBRATION_MS;
  const total = [...msPerFrame.values()].reduce((sum, ms) => sum + ms, 0);
  return [...msPerFrame, ['total', total] as const].map(([name, ms]) => {
    const known = budget[name];
    const budgetMs = known === undefined ? null : known * slower;
    const over = budgetMs !== null && ms > budgetMs * (1 + TOLERANCE) && ms > budgetMs + LEAST_OVER_MS;
    return {
      name,
      ms: Number(ms.toFixed(2)),
      budgetMs: budgetMs === null ? null : Number(budgetMs.toFixed(2)),
      over,
    };
  });
}

/** How long a fixed piece of work takes this computer, milliseconds: the best of several, as nothing makes it faster. */
export function calibrationMs(): number {
  let best = Number.POSITIVE_INFINITY;
  for (let round = 0; round < 20; round++) {
    const beganMs = performance.now();
    calibrate();
    best = Math.min(best, performance.now() - beganMs);
  }
  return Number(best.toFixed(2));
}

function calibrate(): number {
  const values = new Float64Array(100_000);
  let state = 1;
  for (let i = 0; i < values.length; i++) {
    state ^= state << 13;
    state ^= state >>> 17;
    state ^= state << 5;
    values[i] = state;
  }
  return values.sort()[0] as number;
}
