import { expect, test } from 'vitest';
import { CONTROLS } from '../../words/controller-label-words.ts';
import { controlPlace, FIRST_MS, showsLabels } from './controller-shape.ts';

test('the left hand’s controller is the mirror image of the right hand’s', () => {
  for (const control of CONTROLS) {
    const [right, left] = [controlPlace(control, 'right'), controlPlace(control, 'left')];
    expect([left.x + right.x, left.y, left.z]).toEqual([0, right.y, right.z]);
  }
});

test('labels are there in the first minute, with the menu, and when a hand is before the eyes; never in the way', () => {
  const aside = { cosine: 0.5, sinceMs: FIRST_MS, menuOpen: false, inTheWay: false };
  expect(showsLabels(aside)).toBe(false);
  for (const change of [{ sinceMs: FIRST_MS - 1 }, { menuOpen: true }, { cosine: 0.99 }]) {
    expect(showsLabels({ ...aside, ...change })).toBe(true);
    expect(showsLabels({ ...aside, ...change, inTheWay: true })).toBe(false);
  }
});
