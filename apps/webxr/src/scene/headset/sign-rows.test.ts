import { expect, test } from 'vitest';
import { signRows } from './sign-rows.ts';

/** Each letter is 10 pixels wide. */
const measure = (text: string) => 10 * text.length;
const words = (count: number) => Array.from({ length: count }, (_, n) => `word${n}`).join(' ');

test('what fits has the usual size, row by row', () => {
  const said = [
    { text: 'Emergency stop', look: 'title' },
    { text: words(3), look: 'text' },
  ];
  expect(signRows(said, 140, 3, measure)).toEqual({
    rows: [
      { text: 'Emergency stop', look: 'title' },
      { text: 'word0 word1', look: 'text' },
      { text: 'word2', look: 'text' },
    ],
    share: 1,
  });
});

test('what is longer has smaller letters and loses no word', () => {
  for (const count of [20, 100, 400]) {
    const { rows, share } = signRows([{ text: words(count), look: 0 }], 140, 4, measure);
    expect(share).toBeLessThan(1);
    expect(rows.length * share).toBeLessThanOrEqual(4);
    expect(rows.map(({ text }) => text).join(' ')).toBe(words(count));
    // The next larger letters would not fit.
    const larger = signRows([{ text: words(count), look: 0 }], (140 / share) * 0.95, 1000, measure).rows;
    expect((larger.length * share) / 0.95).toBeGreaterThan(4);
    for (const { text } of rows) expect(measure(text) * share).toBeLessThanOrEqual(140 + 1e-9);
  }
});
