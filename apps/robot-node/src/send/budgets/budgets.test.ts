import { expect, it } from 'vitest';
import type { CaptureBudget } from '../../sense/encode/capture-budget.ts';
import { type BudgetedSensor, Budgets } from './budgets.ts';
import type { BudgetTarget } from './sensor-budget.ts';

/** An operator who wants both sensors' clouds, and has twice the rate for the first. */
const operator = {
  id: 'a',
  streaming: true,
  wants: () => true,
  reads: () => false,
  probesWith: () => true,
  cloudBitsPerSecond: (sensor: number) => 2e6 / (sensor + 1),
  sender: { probeWish: null, overheadBytes: 40 },
} as unknown as BudgetTarget & { sender: { probeWish: CaptureBudget['probe'] } };

function setUp() {
  const told: [sensor: number, bitsPerSecond: number][] = [];
  const targets: BudgetTarget[] = [];
  const budgets = new Budgets({ targets: () => targets, driver: () => null, mayCode: true });
  const sensors = [0, 1].map(
    (number): BudgetedSensor => ({
      number,
      wantedAnyway: false,
      setBudget: ({ targetBitsPerSecond }) => void told.push([number, targetBitsPerSecond]),
    }),
  );
  for (const sensor of sensors) budgets.add(sensor);
  const update = () => {
    budgets.update();
    return told.splice(0);
  };
  return { budgets, targets, sensors, update };
}

it('tells each sensor its budget when that has changed, and not again', () => {
  const { targets, update, budgets, sensors } = setUp();
  expect(update()).toEqual([]);
  targets.push(operator);
  expect(update()).toEqual([
    [0, 2e6],
    [1, 1e6],
  ]);
  expect(sensors.map((sensor) => budgets.overheadBytes(sensor))).toEqual([40, 40]);
  expect(update()).toEqual([]);
  targets.pop();
  expect(update().map(([, bitsPerSecond]) => bitsPerSecond)).toEqual([0, 0]);
});

it('asks once for each probe, whatever becomes of its size', () => {
  const { targets, update } = setUp();
  const probe = (clusterId: number, bytes: number) =>
    targets.splice(0, 1, {
      ...operator,
      sender: { probeWish: { clusterId, bytes }, overheadBytes: 40 },
    } as never);
  probe(1, 5000);
  expect(update()).toHaveLength(2);
  probe(1, 3000);
  expect(update()).toHaveLength(0);
  probe(2, 3000);
  expect(update()).toHaveLength(2);
});

it('a sensor that is gone is told nothing more', () => {
  const { targets, sensors, budgets, update } = setUp();
  targets.push(operator);
  budgets.remove(sensors[0] as BudgetedSensor);
  expect(update()).toEqual([[1, 1e6]]);
});
