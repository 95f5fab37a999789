import fc from 'fast-check';
import { expect, test } from 'vitest';
import { SequenceNumber, SequenceUnwrapper } from './sequence-number.ts';

test.each([
  [1, 0, 1],
  [0, 0xffff, 1],
  [0xffff, 0, -1],
  [0x7fff, 0, 0x7fff],
  [0x8000, 0, -0x8000],
])('%i is ahead of %i by %i', (a, b, ahead) => {
  expect(SequenceNumber.ahead(a, b)).toBe(ahead);
});

test('adding steps and measuring them are inverse operations', () => {
  fc.assert(
    fc.property(fc.nat(0xffff), fc.integer({ min: -0x8000, max: 0x7fff }), (from, steps) => {
      const to = SequenceNumber.add(from, steps);
      expect(to).toBe(SequenceNumber.of(to));
      expect(SequenceNumber.ahead(to, from)).toBe(steps);
    }),
    { seed: 2 },
  );
  expect(SequenceNumber.next(0xffff)).toBe(0);
});

test('follows a counter over any number of wraps, in both directions', () => {
  fc.assert(
    fc.property(
      fc.nat(0xffff),
      fc.array(fc.integer({ min: -100, max: 32_767 }), { maxLength: 300, size: 'max' }),
      (start, steps) => {
        const unwrapper = new SequenceUnwrapper();
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
