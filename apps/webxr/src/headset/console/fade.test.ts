import { expect, test } from 'vitest';
import { Fade } from './fade.ts';

test('comes and goes in steps, and is wholly there or gone in the end', () => {
  const fade = new Fade();
  expect(fade.update(100)).toBe(0);
  fade.shown = true;
  expect(fade.update(100)).toBeCloseTo(0.4);
  expect(fade.update(1000)).toBe(1);
  fade.shown = false;
  expect(fade.update(50)).toBeCloseTo(0.8);
  expect(fade.update(1000)).toBe(0);
});
