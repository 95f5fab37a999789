import fc from 'fast-check';
import { expect, test } from 'vitest';
import { SequenceUnwrapper16, sequenceDelta16, sequenceDelta32 } from './sequence.ts';

test.each([
  [1, 0, 1],
  [0, 1, -1],
  [0, 0xffffffff, 1],
  [0xffffffff, 0, -1],
  [0x7fffffff, 0, 0x7fffffff],
  [0x80000000, 0, -0x80000000],
])('32 bits: %i against %i is %i', (a, b, delta) => {
  expect(sequenceDelta32(a, b)).toBe(delta);
});

test.each([
  [0, 0xffff, 1],
  [0xffff, 0, -1],
  [0x7fff, 0, 0x7fff],
  [0x8000, 0, -0x8000],
])('16 bits: %i against %i is %i', (a, b, delta) => {
  expect(sequenceDelta16(a, b)).toBe(delta);
});

test('follows a counter over any number of wraps, forwards and back', () => {
  fc.assert(
    fc.property(
      fc.nat(0xffff),
      fc.array(fc.integer({ min: -100, max: 32_767 }), { maxLength: 300, size: 'max' }),
      (start, steps) => {
        const unwrapper = new SequenceUnwrapper16();
        let value = start;
        expect(unwrapper.unwrap(value)).toBe(value);
        for (const step of steps) {
          value += step;
          expect(unwrapper.unwrap(((value % 65_536) + 65_536) % 65_536)).toBe(value);
        }
      },
    ),
    { seed: 1 },
  );
});
