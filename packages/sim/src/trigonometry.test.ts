import fc from 'fast-check';
import { expect, test } from 'vitest';
import { cos, sin, wrapAngle } from './trigonometry.ts';

test('sine and cosine agree with the library to 1e-13', () => {
  fc.assert(
    fc.property(fc.double({ min: -1000, max: 1000, noNaN: true }), (x) => {
      expect(Math.abs(sin(x) - Math.sin(x))).toBeLessThan(1e-13);
      expect(Math.abs(cos(x) - Math.cos(x))).toBeLessThan(1e-13);
    }),
    { seed: 1 },
  );
});

test('a wrapped angle has the same direction', () => {
  fc.assert(
    fc.property(fc.double({ min: -100, max: 100, noNaN: true }), (x) => {
      const wrapped = wrapAngle(x);
      expect(wrapped).toBeGreaterThan(-Math.PI - 1e-12);
      expect(wrapped).toBeLessThanOrEqual(Math.PI + 1e-12);
      expect(Math.cos(wrapped)).toBeCloseTo(Math.cos(x), 9);
      expect(Math.sin(wrapped)).toBeCloseTo(Math.sin(x), 9);
    }),
    { seed: 1 },
  );
});
