import { expect, it } from 'vitest';
import type { CodedFormat, DrawnMost } from '../../sense/encode/plan.ts';
import { type BudgetTarget, sensorBudget } from './sensor-budget.ts';

class Viewer implements BudgetTarget {
  readonly id: string;
  streaming = true;
  display: DrawnMost | null = null;
  sender: BudgetTarget['sender'] = null;
  /** The sensor whose frames carry the target's probes. */
  probed = 0;
  readonly #bitsPerSecond: number;
  readonly #formats: readonly CodedFormat[];

  constructor(id: string, cloudBitsPerSecond: number, formats: readonly CodedFormat[]) {
    this.id = id;
    this.#bitsPerSecond = cloudBitsPerSecond;
    this.#formats = formats;
  }

  reads(format: CodedFormat): boolean {
    return this.#formats.includes(format);
  }
  wants(sensor: number): boolean {
    return sensor === 0;
  }
  probesWith(sensor: number): boolean {
    return sensor === this.probed;
  }
  cloudBitsPerSecond(): number {
    return this.#bitsPerSecond;
  }
}

const BOTH = ['organised', 'unorganised'] as const;

const budgetOf = (viewers: readonly Viewer[], driver: string | null = null) =>
  sensorBudget(viewers, { sensor: 0, driver, mayCode: true, wantedAnyway: false });

const coded = (
  format: CodedFormat,
  targetBitsPerSecond: number,
  plainBitsPerSecond: number | null = null,
) => ({
  format,
  targetBitsPerSecond,
  plainBitsPerSecond,
});

it('sends each coded format to those who read it, independently of other formats', () => {
  expect(budgetOf([new Viewer('a', 5e6, ['organised'])]).coded).toEqual([coded('organised', 5e6)]);
  expect(budgetOf([new Viewer('a', 5e6, ['unorganised'])]).coded).toEqual([coded('unorganised', 5e6)]);
  expect(budgetOf([new Viewer('a', 5e6, BOTH)]).coded).toEqual([
    coded('organised', 5e6),
    coded('unorganised', 5e6),
  ]);
  expect(budgetOf([new Viewer('a', 5e6, [])]).coded).toEqual([]);
});

it('lets the driver decide formats and rate, with points64 in parallel for those who cannot read them', () => {
  const viewers = [
    new Viewer('driver', 8e6, ['organised']),
    new Viewer('both', 1e6, BOTH),
    new Viewer('other', 3e6, ['unorganised']),
    new Viewer('plain', 2e6, []),
  ];
  expect(budgetOf(viewers, 'driver')).toMatchObject({
    coded: [coded('organised', 8e6, 2e6)],
    targetBitsPerSecond: 8e6,
  });
});

it('wants frames without delay while somebody drives', () => {
  const viewers = [new Viewer('driver', 8e6, BOTH), new Viewer('watcher', 8e6, BOTH)];
  expect(budgetOf(viewers, 'driver').prompt).toBe(true);
  expect(budgetOf(viewers, null).prompt).toBeUndefined();
});

it('sends points64 to everyone if the driver reads nothing else', () => {
  const budget = budgetOf([new Viewer('driver', 8e6, []), new Viewer('both', 1e6, BOTH)], 'driver');
  expect(budget).toMatchObject({ coded: [], targetBitsPerSecond: 8e6 });
});

it('uses every format that anyone reads if nobody drives, at the slowest path among its readers', () => {
  const viewers = [
    new Viewer('a', 8e6, ['organised']),
    new Viewer('b', 4e6, BOTH),
    new Viewer('c', 1e6, []),
    new Viewer('paused', 1e5, BOTH),
  ];
  viewers[3]!.streaming = false;
  expect(budgetOf(viewers)).toMatchObject({
    coded: [coded('organised', 4e6, 1e6), coded('unorganised', 4e6, 1e6)],
    targetBitsPerSecond: 4e6,
  });
});

it('enlarges the frames of one sensor for a probe, if a single path decides', () => {
  const probeWish = { clusterId: 4, bytes: 9000 };
  const viewers = ['a', 'b'].map((id) => new Viewer(id, 1e6, []));
  for (const viewer of viewers) viewer.sender = { probeWish, overheadBytes: 0 } as Viewer['sender'];
  expect(budgetOf(viewers, 'a').probe).toEqual(probeWish);
  expect(budgetOf(viewers).probe).toBeNull();
  for (const viewer of viewers) viewer.probed = 1;
  expect(budgetOf(viewers, 'a').probe).toBeNull();
});

it('captures no more than the driver’s computer draws, and without one no more than the fastest watcher’s', () => {
  const viewers = [
    new Viewer('slow', 8e6, BOTH),
    new Viewer('quick', 8e6, BOTH),
    new Viewer('fast', 8e6, BOTH),
  ] as const;
  const [slow, quick, fast] = viewers;
  slow.display = { framesPerSecond: 5, points: 20_000 };
  quick.display = { framesPerSecond: 20, points: 10_000 };
  expect(budgetOf([slow, quick]).display).toEqual({ framesPerSecond: 20, points: 20_000 });
  expect(budgetOf([slow, quick], 'slow').display).toEqual({ framesPerSecond: 5, points: 20_000 });
  expect(budgetOf([...viewers], 'slow').display).toEqual({ framesPerSecond: 5, points: 20_000 });
  // One that draws all that comes.
  expect(fast.display).toBe(null);
  expect(budgetOf([...viewers]).display).toBe(undefined);
  expect(budgetOf([...viewers], 'fast').display).toBe(undefined);
});

it('captures nothing for nobody, and little for live viewers only', () => {
  const paused = new Viewer('a', 8e6, BOTH);
  paused.streaming = false;
  const demand = { driver: 'a', mayCode: true, wantedAnyway: false };
  expect(sensorBudget([paused], { ...demand, sensor: 0 }).streaming).toBe(false);
  expect(sensorBudget([new Viewer('a', 8e6, BOTH)], { ...demand, sensor: 1 }).streaming).toBe(false);
  expect(sensorBudget([], { ...demand, sensor: 0, wantedAnyway: true })).toMatchObject({
    streaming: true,
    unsent: true,
  });
});
