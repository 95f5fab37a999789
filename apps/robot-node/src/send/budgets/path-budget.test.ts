import fc from 'fast-check';
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
    const wanted = new Map([
      [0, 1e6],
      [2, 1e6],
    ]);
    budget.wantVideos(() => wanted);
    expect(budget.videoBitsPerSecond(0, 20e6)).toBeCloseTo(1e6);
    expect(budget.cloudBitsPerSecond(20e6)).toBeCloseTo(20e6 - 20_000 - 2 * 1.08e6);
    // Clouds count twice.
    const [video, cloud] = [budget.videoBitsPerSecond(2, 2.02e6), budget.cloudBitsPerSecond(2.02e6)];
    expect(video * 1.08).toBeCloseTo(0.5e6);
    expect(cloud).toBeCloseTo(1e6);
    expect(budget.videoBitsPerSecond(1, 20e6)).toBe(0);
    budget.wantVideos(() => new Map());
    expect(budget.cloudBitsPerSecond(20e6)).toBe(20e6 - 20_000);
  });

  it('weighs streams as the operator asks', () => {
    const budget = new PathBudget();
    const wanted = new Map([0, 1, 2].map((video) => [video, 4e6]));
    budget.wantVideos(() => wanted);
    budget.weigh({ cloud: 1, videos: [5, 2] });
    const target = 9.02e6;
    expect(budget.cloudBitsPerSecond(target)).toBeCloseTo(1.17e6);
    budget.weigh({ cloud: 4, videos: [2, 2] });
    const shares = [0, 1, 2].map((video) => budget.videoBitsPerSecond(video, target) * 1.08);
    expect(shares[0]).toBeCloseTo(2e6);
    expect(shares[1]).toBeCloseTo(2e6);
    expect(shares[2]).toBeCloseTo(1e6);
    expect(budget.cloudBitsPerSecond(target)).toBeCloseTo(4e6);
  });

  it('gives the share of a video without pictures to the others', () => {
    const budget = new PathBudget();
    const working = new Map([[0, 4e6]]);
    budget.wantVideos(() => working);
    const both = budget.cloudBitsPerSecond(3.02e6);
    expect(both).toBeCloseTo(2e6);
    working.delete(0);
    budget.update(0, 0, 0);
    expect(budget.cloudBitsPerSecond(3.02e6)).toBeCloseTo(3e6);
  });

  it('pauses videos that would get too little, the least important first, and returns them with a margin', () => {
    const budget = new PathBudget();
    const wanted = new Map([0, 1].map((video) => [video, 1e6]));
    budget.wantVideos(() => wanted);
    budget.weigh({ cloud: 1, videos: [2, 1] });
    const at = (target: number) => {
      budget.update(0, 0, 0);
      return [0, 1].map((video) => Math.round(budget.videoBitsPerSecond(video, target) / 1000));
    };
    // Four parts of 65 kbit/s.
    expect(at(20_000 + 4 * 65_000)).toEqual([120, 60]);
    expect(at(20_000 + 4 * 64_000)).toEqual([158, 0]);
    expect(budget.cloudBitsPerSecond(20_000 + 4 * 64_000)).toBeCloseTo((4 * 64_000) / 3);
    expect(at(20_000 + 4 * 66_000)).toEqual([163, 0]);
    expect(at(20_000 + 4 * 86_000)).toEqual([159, 80]);
    expect(at(20_000 + 60_000)).toEqual([0, 0]);
    expect(budget.cloudBitsPerSecond(20_000 + 60_000)).toBeCloseTo(60_000);
  });

  it('never gives more than there is, and no video less than shows something', () => {
    fc.assert(
      fc.property(
        fc.array(fc.tuple(fc.integer({ min: 64_000, max: 5e6 }), fc.integer({ min: 1, max: 100 })), {
          maxLength: 8,
        }),
        fc.integer({ min: 1, max: 100 }),
        fc.array(fc.double({ min: 0, max: 20e6, noNaN: true }), { minLength: 1, maxLength: 5 }),
        (videos, cloud, targets) => {
          const budget = new PathBudget();
          const wanted = new Map(videos.map(([most], video) => [video, most]));
          budget.wantVideos(() => wanted);
          budget.weigh({ cloud, videos: videos.map(([, weight]) => weight) });
          for (const target of targets) {
            const rates = videos.map((_, video) => budget.videoBitsPerSecond(video, target));
            for (const rate of rates) expect(rate === 0 || rate >= 59_999).toBe(true);
            const all = rates.reduce((sum, rate) => sum + rate * 1.08, budget.cloudBitsPerSecond(target));
            expect(all).toBeLessThanOrEqual(target + 1);
          }
        },
      ),
    );
  });

  it('gives messages all of a path that carries almost nothing', () => {
    expect(new PathBudget().cloudBitsPerSecond(15_000)).toBe(0);
  });

  it('gives sound its part before pictures, clouds and videos, and after messages', () => {
    const budget = new PathBudget(0.15);
    budget.wantVideos(() => new Map([[0, 1e6]]));
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
