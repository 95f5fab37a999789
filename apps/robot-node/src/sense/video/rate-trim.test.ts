import { describe, expect, it } from 'vitest';
import { RateTrim } from './rate-trim.ts';

/** An encoder that gives this part of what it is asked for. */
function run(trim: RateTrim, part: number, pictures: number): number {
  let bytes = 0;
  for (let i = 0; i < pictures; i++) {
    bytes = 2000 * trim.factor * part;
    trim.onPicture(bytes, 2000);
  }
  return bytes / 2000;
}

describe('RateTrim', () => {
  it('makes an encoder that stays below its rate give what is wanted', () => {
    expect(run(new RateTrim(), 0.8, 300)).toBeCloseTo(1, 2);
  });

  it('makes an encoder that exceeds its rate give what is wanted, at the next measurement', () => {
    const trim = new RateTrim();
    expect(run(trim, 1.2, 30)).toBeCloseTo(1.2);
    expect(run(trim, 1.2, 1)).toBeCloseTo(1);
  });

  it('does not ask for much more when a still picture needs nothing', () => {
    const trim = new RateTrim();
    run(trim, 0.05, 3000);
    expect(trim.factor).toBe(1.3);
    // The scene moves again: too much for one measurement, at most.
    expect(run(trim, 1, 31)).toBeCloseTo(1);
  });

  it('says when the factor has changed', () => {
    const trim = new RateTrim();
    const changed = Array.from({ length: 60 }, () => trim.onPicture(1000, 2000));
    expect(changed.filter(Boolean)).toHaveLength(1);
    expect(changed[29]).toBe(true);
  });

  it('takes pictures without bytes for no measurement', () => {
    const trim = new RateTrim();
    for (let i = 0; i < 100; i++) trim.onPicture(0, 0);
    expect(trim.factor).toBe(1);
  });
});
