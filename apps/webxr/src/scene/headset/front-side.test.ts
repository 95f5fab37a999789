import fc from 'fast-check';
import { expect, test } from 'vitest';
import { frontSide } from './headset-rig.ts';

test('says to which side to turn the head, the short way', () => {
  expect(frontSide(0.5, 0.4)).toBe(0);
  expect(frontSide(1.5, 0)).toBe(-1);
  expect(frontSide(-1.5, 0)).toBe(1);
  expect(frontSide(3, -3)).toBe(0);
  expect(frontSide(2.5, -2.5)).toBe(1);
  expect(frontSide(Number.NaN, 0)).toBe(0);
});

test('a head that turns to that side comes to see it', () => {
  const angle = fc.double({ min: -10, max: 10, noNaN: true });
  fc.assert(
    fc.property(angle, angle, (front, face) => {
      let at = face;
      for (let i = 0; i < 20 && frontSide(front, at) !== 0; i++) at -= 0.2 * frontSide(front, at);
      expect(frontSide(front, at)).toBe(0);
    }),
    { seed: 15 },
  );
});
