import { expect, test } from 'vitest';
import { languageFor } from './languages.ts';

test('without a choice, the browser’s first language that the page speaks', () => {
  expect(languageFor('system', ['fr-CH', 'de-AT', 'en'])).toBe('de');
  expect(languageFor('system', ['EN-gb', 'de'])).toBe('en');
  expect(languageFor('system', ['fr', 'den'])).toBe('en');
  expect(languageFor('system', [])).toBe('en');
});

test('a choice comes before the browser', () => {
  expect(languageFor('en', ['de'])).toBe('en');
  expect(languageFor('de', ['en'])).toBe('de');
});
