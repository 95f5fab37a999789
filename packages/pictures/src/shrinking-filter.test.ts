import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { rgbaRows, ShrinkingFilter, shrinkFactor, shrunkSize } from './shrinking-filter.ts';

const side = fc.integer({ min: 1, max: 40 });

describe('ShrinkingFilter', () => {
  it('computes the mean of each square, cutting off the remainder', () => {
    const filter = new ShrinkingFilter();
    fc.assert(
      fc.property(side, side, fc.integer({ min: 1, max: 7 }), fc.nat(1000), (width, height, factor, seed) => {
        const rgba = Uint8Array.from(
          { length: width * height * 4 },
          (_, i) => (i * i * 31 + seed * i) & 0xff,
        );
        const small = filter.shrink(rgbaRows({ width, height, rgba }), factor);
        expect([small.width, small.height]).toEqual(Object.values(shrunkSize(width, height, factor)));
        const [across, down] = [Math.min(factor, width), Math.min(factor, height)];
        for (let y = 0; y < small.height; y++) {
          for (let x = 0; x < small.width; x++) {
            for (let channel = 0; channel < 3; channel++) {
              let sum = 0;
              for (let v = 0; v < down; v++) {
                for (let u = 0; u < across; u++) {
                  sum += rgba[((y * factor + v) * width + x * factor + u) * 4 + channel] as number;
                }
              }
              const got = small.rgba[(y * small.width + x) * 4 + channel] as number;
              expect(Math.abs(got - sum / (across * down))).toBeLessThanOrEqual(0.5);
            }
          }
        }
      }),
      { seed: 2, numRuns: 200 },
    );
  });

  it('chooses the smallest sufficient factor', () => {
    fc.assert(
      fc.property(
        fc.integer({ min: 1, max: 4096 }),
        fc.integer({ min: 1, max: 4096 }),
        fc.integer({ min: 16, max: 4096 }),
        (width, height, longest) => {
          const factor = shrinkFactor(width, height, longest);
          expect(Math.max(width, height) / factor).toBeLessThanOrEqual(longest);
          if (factor > 1) expect(Math.max(width, height) / (factor - 1)).toBeGreaterThan(longest);
        },
      ),
    );
  });
});
