import type { Operators } from '@farpoint/operator';
import { expect, it } from 'vitest';
import { shownPeople } from './people-words.ts';

const here: Operators = {
  type: 'operators',
  operators: [
    { number: 3, name: 'Sue', role: 'supervise', drives: false, you: true },
    { number: 1, name: 'Grace', role: 'drive', drives: true, you: false },
    { number: 2, name: 'Wim', role: 'watch', drives: false, you: false },
  ],
};

it('names everybody, and says who drives', () => {
  const { line, persons } = shownPeople(here, false);
  expect(line).toBe('3 are here: Grace drives');
  expect(persons.map(({ text }) => text)).toEqual([
    'Sue (you, supervisor)',
    'Grace (driving)',
    'Wim (watching)',
  ]);
  expect(persons.some(({ mayEnd }) => mayEnd)).toBe(false);
});

it('lets a supervisor end the sessions of others, not its own', () => {
  expect(shownPeople(here, true).persons.map(({ mayEnd }) => mayEnd)).toEqual([false, true, true]);
});

it('counts those who are not listed, and says nothing where the robot does not tell', () => {
  expect(shownPeople({ ...here, more: 4 }, false).line).toBe('7 are here: Grace drives');
  const [you] = here.operators;
  expect(
    shownPeople({ ...here, operators: you === undefined ? [] : [{ ...you, drives: true }] }, true).line,
  ).toBe('Only you are here: you drive');
  expect(shownPeople(null, true)).toEqual({ line: null, persons: [] });
});
