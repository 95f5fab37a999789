/** The parts of `pnpm soak`, and which of them run. Pure. */

/** A command of the workspace's root, run by this Node. */
export interface SoakCommand {
  args: readonly string[];
  env?: Readonly<Record<string, string>>;
}

export interface SoakPart {
  name: string;
  what: string;
  /** About how long, minutes on two cores. */
  minutes: number;
  /** Steps of `pnpm test` without which this part has nothing to do; one that exists is enough. */
  steps?: readonly string[];
  /** @param steps those that it names and that exist @param seed of this soak */
  commands(steps: readonly string[], seed: number): readonly SoakCommand[];
  /** Folders of logs, one of each command, that must be equal. */
  equalLogs?: readonly string[];
  /** Whether the last line of output has figures, which are compared with those of earlier soaks. */
  hasFigures?: boolean;
}

const TEST = 'scripts/test.ts';
const LAYERS = ['pure', 'scenario', 'page', 'stack', 'smoke'] as const;
const SCENARIO_LOGS = ['.farpoint/event-logs-1', '.farpoint/event-logs-2'];

const bench = (name: string, what: string, minutes: number): SoakPart => ({
  name,
  what,
  minutes,
  hasFigures: true,
  commands: () => [{ args: ['bench/main.ts', name, '--json'] }],
});

export const PARTS: readonly SoakPart[] = [
  {
    name: 'quarantine',
    what: 'no test is in quarantine longer than was promised',
    minutes: 0,
    commands: () => [],
  },
  {
    name: 'all',
    what: 'every test, in its long form (pnpm test --all)',
    minutes: 30,
    commands: () => [{ args: [TEST, '--all'] }],
  },
  {
    name: 'load',
    what: 'each layer three times beside two busy programs',
    minutes: 40,
    steps: LAYERS,
    commands: (steps) => [{ args: [TEST, '--only', steps.join(), '--repeat', '3', '--load', '2'] }],
  },
  {
    name: 'properties',
    what: 'all cases of long tests, with another seed',
    minutes: 4,
    commands: (_, seed) => [
      {
        args: [TEST, '--only', 'pure'],
        env: {
          FARPOINT_LONG_TESTS: '1',
          FAST_CHECK_SEED: String(seed),
          PROPTEST_RNG_SEED: String(seed),
        },
      },
    ],
  },
  {
    name: 'scenarios',
    what: 'scenarios twice, with equal logs',
    minutes: 1,
    steps: ['scenario'],
    equalLogs: SCENARIO_LOGS,
    commands: () =>
      SCENARIO_LOGS.map((folder) => ({
        args: [TEST, '--only', 'scenario'],
        env: { FARPOINT_EVENT_LOGS: folder },
      })),
  },
  {
    name: 'firefox',
    what: 'Firefox ten times',
    minutes: 10,
    steps: ['firefox'],
    commands: () => [{ args: [TEST, '--only', 'firefox', '--repeat', '10'] }],
  },
  {
    name: 'mutants',
    what: 'tests find each fault of tests/mutants.yaml',
    minutes: 60,
    commands: () => [{ args: ['scripts/mutants.ts'] }],
  },
  bench('faults', 'the table of faults on real clocks, with its strict limits', 4),
  bench('cameras', 'cameras and clouds over a link: shares, latency', 5),
  bench('link', 'a link whose rate changes: queue, rate, latency', 3),
  bench('mtp', 'from motion to what the operator sees', 3),
];

/**
 * @param only names of parts; empty: all @param without names of parts that do not run
 * @returns the parts that run, in their order
 * @throws {Error} that says which part there is not
 */
export function planSoak(only: readonly string[], without: readonly string[]): SoakPart[] {
  const unknown = [...only, ...without].find((name) => !PARTS.some((part) => part.name === name));
  if (unknown !== undefined)
    throw new Error(`there is no part ${unknown}; the parts are ${PARTS.map(({ name }) => name).join(', ')}`);
  const plan = PARTS.filter(
    ({ name }) => (only.length === 0 || only.includes(name)) && !without.includes(name),
  );
  if (plan.length === 0) throw new Error('no part is left to run');
  return plan;
}

/** The steps of a part that exist; `null` if it names some and none of them does. */
export function stepsOf({ steps }: SoakPart, existing: readonly string[]): string[] | null {
  if (steps === undefined) return [];
  const there = steps.filter((step) => existing.includes(step));
  return there.length === 0 ? null : there;
}
