import { expect, test } from 'vitest';
import { VignetteAmount } from './vignette-amount.ts';

/** Frames of 10 ms. */
function after(amount: VignetteAmount, frames: number, turnRate: number, speed: number): number {
  for (let i = 0; i < frames; i++) amount.update(turnRate, speed, 10);
  return amount.value;
}

test('comes within a fifth of a second of turning or moving, and goes to nothing', () => {
  const amount = new VignetteAmount({ vignette: 0.5 });
  expect(after(amount, 20, -2, 0)).toBeGreaterThan(0.45);
  expect(amount.value).toBeLessThanOrEqual(0.5);
  expect(after(amount, 300, 0, 0)).toBe(0);
  expect(after(amount, 20, 0, 3)).toBeGreaterThan(0.45);
});

test('is weaker for gentle motion, and nothing at strength 0', () => {
  expect(after(new VignetteAmount({ vignette: 1 }), 100, 0.2, 0)).toBeCloseTo(0.2 / (Math.PI / 4), 2);
  expect(after(new VignetteAmount({ vignette: 0 }), 100, 9, 9)).toBe(0);
});

test('a rate that is no number darkens nothing', () => {
  const amount = new VignetteAmount({ vignette: 1 });
  amount.update(Number.NaN, 0, 10);
  expect(after(amount, 1, Number.POSITIVE_INFINITY, 0)).toBe(0);
});
