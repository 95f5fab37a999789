import fc from 'fast-check';
import { expect, test } from 'vitest';
import { type KeyWord, KeyWords } from './key-words.ts';

function said(text: string): (KeyWord | null)[] {
  const words = new KeyWords();
  return [...Buffer.from(text)].map((byte) => words.take(byte)).filter((word) => word !== null);
}

test.each<[string, (KeyWord | null)[]]>([
  [' ', ['stop']],
  ['\r', ['stop']],
  ['\n', ['stop']],
  ['\r\n', ['stop']],
  ['release\n', ['release']],
  ['release\r', ['release']],
  ['release\r\n', ['release']],
  ['release', []],
  ['release \n', ['stop', 'stop']],
  ['rel\n', ['stop']],
  ['relase\n', ['stop', 'stop', 'stop', 'stop']],
  ['Re\n', ['stop', 'stop', 'stop']],
  ['\u001b[A', ['stop', 'stop', 'stop']],
  ['\u0003', ['interrupt']],
  ['x\nrelease\n', ['stop', 'stop', 'release']],
])('%j', (text, words) => {
  expect(said(text)).toEqual(words);
});

test('whatever is typed, only the word and Enter release', () => {
  const typed = fc.array(
    fc.constantFrom('r', 'e', 'l', 'release', 'release\n', '\r', '\n', ' ', 'é', '\u0003'),
  );
  fc.assert(
    fc.property(typed, (parts) => {
      const text = parts.join('');
      const words = new KeyWords();
      const bytes = Buffer.from(text);
      bytes.forEach((byte, i) => {
        const word = words.take(byte);
        if (word === 'release') expect(bytes.subarray(Math.max(0, i - 7), i).toString()).toBe('release');
        if (byte === 0x20) expect(word).toBe('stop');
      });
    }),
  );
});
