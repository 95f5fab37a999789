import { expect, it } from 'vitest';
import { BUDGETS_CALIBRATION_MS, CPU_BUDGETS, compareWithBudget } from './cpu-budgets.ts';

const budget = { 'robot: capture': 4, 'page: main thread': 0.3, total: 10 };
const measured = (capture: number, page = 0.3) =>
  new Map([
    ['robot: capture', capture],
    ['page: main thread', page],
  ]);

it('names what is more than a quarter over its budget, and not what is over by nearly nothing', () => {
  const over = (capture: number, page?: number) =>
    compareWithBudget(measured(capture, page), budget, BUDGETS_CALIBRATION_MS)
      .filter((row) => row.over)
      .map(({ name }) => name);
  expect(over(4.9)).toEqual([]);
  expect(over(5.1)).toEqual(['robot: capture']);
  expect(over(4, 0.45)).toEqual([]);
  expect(over(4, 0.6)).toEqual(['page: main thread']);
  expect(over(13)).toEqual(['robot: capture', 'total']);
});

it('gives a slower computer more', () => {
  const [row] = compareWithBudget(measured(8), budget, 2 * BUDGETS_CALIBRATION_MS);
  expect(row).toEqual({ name: 'robot: capture', ms: 8, budgetMs: 8, over: false });
});

it('says so where there is no budget', () => {
  expect(compareWithBudget(new Map([['page: new', 1]]), budget, BUDGETS_CALIBRATION_MS)[0]).toEqual({
    ...{ name: 'page: new', ms: 1, budgetMs: null, over: false },
  });
});

it('has budgets for every load, and for the whole', () => {
  for (const [load, rows] of Object.entries(CPU_BUDGETS)) {
    expect(rows.total, load).toBeGreaterThan(0);
    expect(rows['robot: main thread'], load).toBeGreaterThan(0);
    expect(rows['page: main thread'], load).toBeGreaterThan(0);
  }
});
