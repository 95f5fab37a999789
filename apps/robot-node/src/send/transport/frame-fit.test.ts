import { describe, expect, it } from 'vitest';
import { FrameFit } from './frame-fit.ts';

describe('FrameFit', () => {
  it('plans for the whole rate while frames fit', () => {
    const fit = new FrameFit();
    for (let i = 0; i < 10; i++) fit.onSent();
    expect(fit.share).toBe(1);
  });

  it('settles if every other frame would be cut, and recovers', () => {
    const fit = new FrameFit();
    for (let i = 0; i < 100; i++) fit.onCut();
    expect(fit.share).toBe(0.25);
    // About one second at 30 frames/s.
    for (let i = 0; i < 36; i++) fit.onSent();
    expect(fit.share).toBe(1);
    fit.onCut();
    expect(fit.share).toBe(1);
    fit.onSent();
    fit.onCut();
    expect(fit.share).toBe(0.8);
  });

  it.each([
    [14, 'within half a second', 0.8],
    [15, 'later', 1],
  ])('counts two cut frames with %i whole ones between them: the second came %s', (whole, _, share) => {
    const fit = new FrameFit();
    fit.onCut();
    for (let i = 0; i < whole; i++) fit.onSent();
    fit.onCut();
    expect(fit.share).toBe(share);
  });

  it('settles near what can be sent', () => {
    const fit = new FrameFit();
    const shares: number[] = [];
    for (let i = 0; i < 500; i++) {
      if (fit.share > 0.6) fit.onCut();
      else fit.onSent();
      shares.push(fit.share);
    }
    expect(Math.min(...shares.slice(100))).toBeGreaterThan(0.37);
    expect(Math.max(...shares.slice(100))).toBeLessThan(0.63);
  });
});
