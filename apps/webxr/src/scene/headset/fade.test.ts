import { expect, test } from 'vitest';
import { Fade } from './fade.ts';

test('comes and goes in steps, and is wholly there or gone within a quarter of a second', () => {
  const fade = new Fade();
  expect(fade.update(100)).toBe(0);
  fade.shown = true;
  expect(fade.update(80)).toBeCloseTo(0.4);
  expect(fade.update(170)).toBe(1);
  fade.shown = false;
  expect(fade.update(40)).toBeCloseTo(0.8);
  expect(fade.update(210)).toBe(0);
});

test('is gone at once where nobody sees it go', () => {
  const fade = new Fade();
  fade.shown = true;
  fade.update(1000);
  fade.clear();
  expect(fade.update(1)).toBe(0);
});
