import { expect, test } from 'vitest';
import { CONTROLS } from '../../status/controller-label-words.ts';
import { controlPlace, FIRST_MS, showsLabels } from './controller-shape.ts';

test('the left hand’s controller is the mirror image of the right hand’s', () => {
  for (const control of CONTROLS) {
    const [right, left] = [controlPlace(control, 'right'), controlPlace(control, 'left')];
    expect([left.x + right.x, left.y, left.z]).toEqual([0, right.y, right.z]);
  }
});

test('labels are there at first, and later when the controller is looked at', () => {
  expect(showsLabels(-1, 0)).toBe(true);
  expect(showsLabels(0.5, FIRST_MS)).toBe(false);
  expect(showsLabels(0.99, FIRST_MS)).toBe(true);
});
