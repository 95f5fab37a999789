import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { LimitJudge } from './limits.ts';

const battery = () => new LimitJudge({ low: { warn: 20, error: 10 }, hysteresis: 2 });
const levelsOf = (judge: LimitJudge, values: number[]) =>
  values.map((value) => {
    judge.take(value);
    return judge.verdict.level;
  });

describe('LimitJudge', () => {
  it('raises at once, and clears only beyond the hysteresis', () => {
    expect(levelsOf(battery(), [50, 20, 19.9, 20.5, 21.9, 22, 19])).toEqual([
      ...['ok', 'ok', 'warn', 'warn', 'warn', 'ok', 'warn'],
    ]);
    expect(levelsOf(battery(), [9, 11, 12, 15, 22.1])).toEqual(['error', 'error', 'warn', 'warn', 'ok']);
  });

  it('names the limit and the side that were exceeded', () => {
    const judge = new LimitJudge({ low: { warn: 0 }, high: { warn: 60, error: 80 }, hysteresis: 0 });
    expect(judge.take(50)).toBe(false);
    expect(judge.take(90)).toBe(true);
    expect(judge.verdict).toEqual({ level: 'error', side: 'high', limit: 80 });
    expect(judge.take(85)).toBe(false);
    expect(judge.take(70)).toBe(true);
    expect(judge.verdict).toEqual({ level: 'warn', side: 'high', limit: 60 });
    expect(judge.take(-1)).toBe(true);
    expect(judge.verdict).toEqual({ level: 'warn', side: 'low', limit: 0 });
    judge.take(1);
    expect(judge.verdict).toEqual({ level: 'ok', side: 'low', limit: 0 });
  });

  it('does not flutter with noise smaller than the hysteresis, and never misses a value beyond a limit', () => {
    const noise = fc.array(fc.double({ min: -0.99, max: 0.99, noNaN: true }), {
      minLength: 1,
      maxLength: 200,
    });
    fc.assert(
      fc.property(noise, fc.double({ min: -100, max: 100, noNaN: true }), (offsets, at) => {
        const judge = new LimitJudge({ high: { warn: 10 }, hysteresis: 2 });
        let changes = 0;
        for (const offset of offsets) {
          if (judge.take(at + offset)) changes++;
          if (at + offset > 10) expect(judge.verdict.level).toBe('warn');
          if (at + offset < 8) expect(judge.verdict.level).toBe('ok');
        }
        expect(changes).toBeLessThanOrEqual(1);
      }),
      { seed: 1, numRuns: 500 },
    );
  });
});
