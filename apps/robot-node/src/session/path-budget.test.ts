import { describe, expect, it } from 'vitest';
import { PathBudget } from './path-budget.ts';

describe('PathBudget', () => {
  it('leaves the cloud what messages do not take', () => {
    const budget = new PathBudget();
    expect(budget.cloudBitsPerSecond(10e6)).toBe(10e6 - 20_000);
    // 20 kB a second.
    budget.update(0, 0);
    budget.update(10_000, 500);
    budget.update(20_000, 1000);
    expect(budget.cloudBitsPerSecond(10e6)).toBe(9.8e6);
  });

  it('gives messages all of a path that carries hardly anything', () => {
    expect(new PathBudget().cloudBitsPerSecond(15_000)).toBe(0);
  });
});
