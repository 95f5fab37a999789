import fc from 'fast-check';
import { expect, it } from 'vitest';
import { readNack } from './nack.ts';
import { writeNack } from './nack-writer.ts';

it('names exactly the missing packets', () => {
  fc.assert(
    fc.property(
      fc.nat(0xffff),
      fc.array(fc.integer({ min: 1, max: 40 }), { minLength: 1, maxLength: 60 }),
      (begin, gaps) => {
        let sequence = begin;
        const missing = gaps.map((gap) => (sequence = (sequence + gap) & 0xffff));
        const read: number[] = [];
        expect(readNack(writeNack(1, 2, missing), (one) => read.push(one))).toBeNull();
        expect(read).toEqual(missing);
      },
    ),
    { seed: 12 },
  );
});
