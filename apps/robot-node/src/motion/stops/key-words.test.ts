import fc from 'fast-check';
import { expect, test } from 'vitest';
import { type KeyWord, KeyWords } from './key-stop.ts';

/** Each text by itself, as a terminal sends keys. */
function said(...texts: string[]): KeyWord[] {
  const words = new KeyWords();
  return texts.flatMap((text) => words.take(Buffer.from(text)));
}

const stops = (count: number): KeyWord[] => Array<KeyWord>(count).fill('stop');

test.each<[string, KeyWord[]]>([
  [' ', stops(1)],
  ['\r', stops(1)],
  ['\n', stops(1)],
  ['\r\n', stops(1)],
  ['r', stops(1)],
  ['re', stops(2)],
  ['release', stops(7)],
  ['release\n', [...stops(7), 'release']],
  ['release\r', [...stops(7), 'release']],
  ['release\r\n', [...stops(7), 'release']],
  ['release\n\n', [...stops(7), 'release', 'stop']],
  ['release \n', stops(9)],
  ['rel\n', stops(4)],
  ['relase\n', stops(7)],
  ['Re\n', stops(3)],
  ['rrelease\n', [...stops(8), 'release']],
  ['\u001b[A', stops(3)],
  ['\u0003', ['interrupt']],
  ['x\nrelease\n', [...stops(9), 'release']],
])('%j', (text, words) => {
  expect(said(text)).toEqual(words);
});

test('a word typed key by key releases, and a line feed after its Enter is a key of its own', () => {
  expect(said(...'release\r')).toEqual([...stops(7), 'release']);
  expect(said(...'release\r\n')).toEqual([...stops(7), 'release', 'stop']);
});

test('whatever is typed, every key stops but Ctrl+C, and the Enter after the word', () => {
  const typed = fc.array(
    fc.constantFrom('r', 'e', 'l', 'release', 'release\n', '\r', '\n', ' ', 'é', '\u0003'),
  );
  fc.assert(
    fc.property(typed, (parts) => {
      const words = new KeyWords();
      let before = '';
      for (const byte of Buffer.from(parts.join(''))) {
        const key = String.fromCharCode(byte);
        const isEnter = key === '\r' || key === '\n';
        const word = key === '\u0003' ? 'interrupt' : isEnter && isWord(before) ? 'release' : 'stop';
        expect(words.take(Uint8Array.of(byte))).toEqual([word]);
        before += key;
      }
    }),
  );
});

/** Whether the last keys are the word; keys before it do not matter. */
function isWord(before: string): boolean {
  return before.endsWith('release');
}
