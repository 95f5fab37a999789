import fc from 'fast-check';
import { expect, test } from 'vitest';
import { KeyIndex } from './key-index.ts';

const CAPACITY = 64;
/** Few keys, so that they collide and come back. */
const action = fc.record({
  key: fc.oneof(
    fc.nat(40),
    fc.nat(40).map((key) => key * 2 ** 32),
  ),
  remove: fc.boolean(),
});

test('finds what a map finds, whatever is added and removed', () => {
  fc.assert(
    fc.property(fc.array(action, { maxLength: 300 }), (actions) => {
      const keys = new Float64Array(CAPACITY).fill(-1);
      const index = new KeyIndex(CAPACITY, (item) => keys[item] as number);
      const expected = new Map<number, number>();
      for (const { key, remove } of actions) {
        const there = expected.get(key);
        if (remove && there !== undefined) {
          index.remove(key, there);
          keys[there] = -1;
          expected.delete(key);
        } else if (!remove && there === undefined) {
          const item = keys.indexOf(-1);
          if (item < 0) continue;
          keys[item] = key;
          index.add(key, item);
          expected.set(key, item);
        } else if (there !== undefined && keys.includes(-1)) {
          const to = keys.indexOf(-1);
          index.move(key, there, to);
          keys[to] = key;
          keys[there] = -1;
          expected.set(key, to);
        }
        for (const [each, item] of expected) expect(index.find(each)).toBe(item);
        if (!expected.has(key)) expect(index.find(key)).toBe(-1);
      }
    }),
    { numRuns: 60 },
  );
});
