import { describe, expect, it } from 'vitest';
import { UsefulRate } from './useful-rate.ts';

const frame = {
  ...{ wireBits: 500_000, budgetBits: 1_200_000, limited: true },
  ...{ framesPerSecond: 30, mostBitsPerSecond: 60e6 },
};

describe('UsefulRate', () => {
  it('is a little more than what frames take that do not use their budget up', () => {
    expect(new UsefulRate().update(frame)).toBeCloseTo(19.5e6);
  });

  it('is the upper bound while frames use their budget up, and never more', () => {
    const useful = new UsefulRate();
    expect(useful.update({ ...frame, budgetBits: 520_000 })).toBe(60e6);
    expect(useful.update({ ...frame, mostBitsPerSecond: 10e6 })).toBe(10e6);
  });

  it('is what frames take that have all they can use, at the rate that the machine makes them', () => {
    expect(new UsefulRate().update({ ...frame, budgetBits: 500_000, limited: false })).toBeCloseTo(19.5e6);
  });

  it('stays where it is when the budget shrinks to it', () => {
    const useful = new UsefulRate();
    let claim = useful.update(frame);
    for (let i = 0; i < 50; i++) claim = useful.update({ ...frame, budgetBits: claim / 30 });
    expect(claim).toBeCloseTo(19.5e6);
  });

  it('forgets a high use slowly', () => {
    const useful = new UsefulRate();
    useful.update({ ...frame, wireBits: 1e6 });
    const next = useful.update(frame);
    expect(next).toBeGreaterThan(35e6);
    let claim = next;
    for (let i = 0; i < 100; i++) claim = useful.update(frame);
    expect(claim).toBeCloseTo(19.5e6);
  });
});
