import fc from 'fast-check';
import { expect, test } from 'vitest';
import { splitKeys } from './split-keys.ts';

test('brackets make keys', () => {
  expect(splitKeys('Hold [Space] and [W][A] · stop')).toEqual([
    { text: 'Hold ', isKey: false },
    { text: 'Space', isKey: true },
    { text: ' and ', isKey: false },
    { text: 'W', isKey: true },
    { text: 'A', isKey: true },
    { text: ' · stop', isKey: false },
  ]);
  expect(splitKeys('no [key')).toEqual([{ text: 'no [key', isKey: false }]);
});

test('nothing of a text is lost', () => {
  fc.assert(
    fc.property(fc.string(), (text) => {
      const joined = splitKeys(text).map((part) => (part.isKey ? `[${part.text}]` : part.text));
      expect(joined.join('')).toBe(text);
    }),
    { seed: 1 },
  );
});
