import type { Operators } from '@farpoint/operator';
import { expect, it } from 'vitest';
import { type PeopleFacts, shownPeople as shown } from './people-words.ts';

const sue = { number: 3, name: 'Sue', role: 'supervise', drives: false, you: true } as const;
const grace = { number: 1, name: 'Grace', role: 'drive', drives: true, you: false } as const;
const wim = { number: 2, name: 'Wim', role: 'watch', drives: false, you: false } as const;
const here: Operators = { type: 'operators', operators: [sue, grace, wim] };

const facts: PeopleFacts = {
  operators: here,
  role: 'drive',
  holder: 'other',
  waits: false,
  stopped: false,
  drivesMinutes: null,
};
const shownPeople = (operators: Operators | null, supervises: boolean) =>
  shown({ ...facts, operators, role: supervises ? 'supervise' : 'drive' });

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
  expect(shownPeople({ ...here, operators: [{ ...sue, drives: true }] }, true).line).toBe(
    'Only you are here: you drive',
  );
  expect(shownPeople(null, true)).toEqual({ line: null, persons: [], mayAsk: false, hasHeirs: false });
});

it('offers the drive to who may drive, and asks for it, one at a time, while no STOP is on', () => {
  const offers = (change: Partial<PeopleFacts>) =>
    shown({ ...facts, ...change }).persons.map(({ mayOffer }) => mayOffer);
  expect(offers({})).toEqual([false, false, false]);
  expect(offers({ holder: 'you' })).toEqual([false, true, false]);
  expect(offers({ holder: 'you', waits: true })).toEqual([false, false, false]);
  expect(offers({ holder: 'you', stopped: true })).toEqual([false, false, false]);
  const asks = (change: Partial<PeopleFacts>) => shown({ ...facts, ...change }).mayAsk;
  expect([asks({}), asks({ role: null })]).toEqual([true, true]);
  expect([
    asks({ holder: 'nobody' }),
    asks({ holder: 'you' }),
    asks({ role: 'watch' }),
    asks({ waits: true }),
    asks({ stopped: true }),
  ]).toEqual(Array(5).fill(false));
});

it('knows whether there is anybody to hand the drive to', () => {
  const heirs = (operators: Operators['operators']) =>
    shown({ ...facts, operators: { ...here, operators } }).hasHeirs;
  expect([heirs([sue, grace]), heirs([sue, wim]), heirs([sue])]).toEqual([true, false, false]);
});

it.each([
  [0, 'driving for less than 1 min'],
  [12, 'driving for 12 min'],
  [125, 'driving for 2 h 5 min'],
])('says for how long the driver drives: %d min', (drivesMinutes, text) => {
  expect(shown({ ...facts, drivesMinutes }).persons[1]?.text).toBe(`Grace (${text})`);
});

it('says who is not heard from, and whose name nothing proves', () => {
  const operators: Operators = { ...here, operators: [sue, grace, { ...wim, claimed: true, away: true }] };
  expect(shown({ ...facts, operators }).persons[2]).toMatchObject({
    name: '“Wim”',
    text: '“Wim” (watching, away: not heard from)',
  });
  const alone: Operators = { ...here, operators: [{ ...sue, claimed: true }] };
  expect(shown({ ...facts, operators: alone }).line).toBeNull();
});
