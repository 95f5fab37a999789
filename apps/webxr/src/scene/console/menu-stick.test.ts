import { expect, test } from 'vitest';
import { MenuStick } from './menu-stick.ts';

test('one entry for each push; a stick that is deflected when the menu opens must come back first', () => {
  const stick = new MenuStick();
  expect([-1, 0, -1, -1, -0.5, -1].map((at) => stick.read(at))).toEqual([0, 0, -1, 0, 0, 0]);
  expect([0.1, 0.5, 0.7, 0.9].map((at) => stick.read(at))).toEqual([0, 0, 1, 0]);
  stick.read(0);
  stick.reset();
  expect(stick.read(1)).toBe(0);
});
