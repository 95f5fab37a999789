import { describe, expect, it } from 'vitest';
import { PathBudget } from './path-budget.ts';

describe('PathBudget', () => {
  it('leaves the cloud whatever messages do not use', () => {
    const budget = new PathBudget();
    expect(budget.cloudBitsPerSecond(10e6)).toBe(10e6 - 20_000);
    // 20 kB a second.
    budget.update(0, 0, 0);
    budget.update(10_000, 0, 500);
    budget.update(20_000, 0, 1000);
    expect(budget.cloudBitsPerSecond(10e6)).toBe(9.8e6);
  });

  it('leaves clouds at least 85 % of what messages do not use, however much pictures want', () => {
    for (const target of [0.1e6, 0.5e6, 1e6, 2e6, 4e6, 8e6, 20e6, 60e6]) {
      const budget = new PathBudget(0.15);
      // Pictures use their whole allowance, and more.
      for (let i = 0; i <= 10; i++) budget.update(i * 200, i * 1e6, i * 100);
      const cloud = budget.cloudBitsPerSecond(target);
      expect(cloud).toBeGreaterThanOrEqual(target * 0.85 - 20_000 - 1);
      expect(cloud + budget.pictureBitsPerSecond(target)).toBeLessThanOrEqual(target);
    }
  });

  it('gives clouds the part of the allowance that pictures do not use', () => {
    const budget = new PathBudget(0.15);
    for (let i = 0; i <= 10; i++) budget.update(0, 0, i * 100);
    expect(budget.pictureBitsPerSecond(10e6)).toBe(1.5e6);
    expect(budget.cloudBitsPerSecond(10e6)).toBe(10e6 - 20_000);
  });

  it('gives videos what they want where there is room, and a share where there is none', () => {
    const budget = new PathBudget();
    budget.wantVideos(
      new Map([
        [0, 1e6],
        [2, 1e6],
      ]),
    );
    expect(budget.videoBitsPerSecond(0, 20e6)).toBeCloseTo(1e6);
    expect(budget.cloudBitsPerSecond(20e6)).toBeCloseTo(20e6 - 20_000 - 2 * 1.08e6);
    // Clouds count twice.
    const [video, cloud] = [budget.videoBitsPerSecond(2, 2.02e6), budget.cloudBitsPerSecond(2.02e6)];
    expect(video * 1.08).toBeCloseTo(0.5e6);
    expect(cloud).toBeCloseTo(1e6);
    expect(budget.videoBitsPerSecond(1, 20e6)).toBe(0);
    budget.wantVideos(new Map());
    expect(budget.cloudBitsPerSecond(20e6)).toBe(20e6 - 20_000);
  });

  it('gives messages all of a path that carries almost nothing', () => {
    expect(new PathBudget().cloudBitsPerSecond(15_000)).toBe(0);
  });

  it('gives sound its part before pictures, clouds and videos, and after messages', () => {
    const budget = new PathBudget(0.15);
    budget.wantVideos(new Map([[0, 1e6]]));
    budget.takeSound(60_000);
    expect(budget.cloudBitsPerSecond(100_000) + budget.videoBitsPerSecond(0, 100_000) * 1.08).toBeCloseTo(
      20_000,
    );
    expect(budget.pictureBitsPerSecond(85_000)).toBeLessThanOrEqual(5000);
    budget.takeSound(0);
    expect(budget.cloudBitsPerSecond(100_000) + budget.videoBitsPerSecond(0, 100_000) * 1.08).toBeCloseTo(
      80_000,
    );
  });

  it('leaves sound a third of what messages leave', () => {
    const budget = new PathBudget();
    expect(budget.soundBitsPerSecond(320_000)).toBe(100_000);
    expect(budget.soundBitsPerSecond(10_000)).toBe(0);
  });
});
