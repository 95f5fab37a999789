import { expect, test } from 'vitest';
import { emptyListWords } from './robots-words.ts';

test('only a service that lets the page in knows that there are no robots', () => {
  expect(emptyListWords('ready', 'x').text).toMatch(/^No robots are online/);
  for (const state of ['refused', 'waiting', 'connecting', 'stopped'] as const)
    expect(emptyListWords(state, 'x').text).not.toContain('No robots are online');
});

test('names the service, and what to do about it', () => {
  expect(emptyListWords('refused', 'sig.example:8080')).toMatchObject({
    text: expect.stringMatching(/sig\.example:8080 refused this page’s token.*Settings/),
    tone: 'bad',
  });
  expect(emptyListWords('waiting', 'sig.example').text).toMatch(/sig\.example cannot be reached/);
});
