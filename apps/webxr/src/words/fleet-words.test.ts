import type { RobotStatus } from '@farpoint/protocol';
import { afterEach, describe, expect, it } from 'vitest';
import { type FleetFacts, isSearched, listedRobots, seenWords } from './fleet-words.ts';
import { speak } from './language.ts';

const SINCE_MS = new Date(2026, 5, 1, 14, 32).getTime();
const free: RobotStatus = {
  state: 'free',
  sinceMs: SINCE_MS,
  operators: 0,
  watchers: 0,
  maxOperators: 4,
  alarms: 0,
};
const robots = [
  { id: 'r-3', name: 'Zebra' },
  { id: 'r-1', name: 'ant' },
  { id: 'r-2', name: 'Bee' },
];
const facts = (change: Partial<FleetFacts> = {}): FleetFacts => ({
  robots,
  statuses: new Map(),
  search: '',
  unixMs: SINCE_MS + 60_000,
  ...change,
});
const names = (change: Partial<FleetFacts>) => listedRobots(facts(change)).map(({ name }) => name);
const wordsOf = (status: Partial<RobotStatus>, change: Partial<FleetFacts> = {}) => {
  const statuses = new Map([['r-1', { ...free, ...status }]]);
  const listed = listedRobots(facts({ statuses, ...change })).find(({ id }) => id === 'r-1');
  return listed?.words.map(({ text, tone }) => `${text}: ${tone}`);
};

afterEach(() => speak('en'));

describe('the list of robots', () => {
  it('is in the order of the names, whatever their case, and numbers count as numbers', () => {
    expect(names({})).toEqual(['ant', 'Bee', 'Zebra']);
    const numbered = ['Robot 10', 'Robot 9'].map((name) => ({ id: name.toLowerCase(), name }));
    expect(names({ robots: numbered })).toEqual(['Robot 9', 'Robot 10']);
  });

  it('says nothing of a robot that tells nothing', () => {
    expect(listedRobots(facts())[0]).toEqual({ id: 'r-1', name: 'ant', words: [], version: null });
  });

  it('finds a part of a name or an id', () => {
    expect(names({ search: ' BE ' })).toEqual(['Bee']);
    expect(names({ search: 'e' })).toEqual(['Bee', 'Zebra']);
    expect(names({ search: 'r-3' })).toEqual(['Zebra']);
    expect(names({ search: 'x' })).toEqual([]);
  });

  it('is searched from seven robots on', () => {
    expect([6, 7].map(isSearched)).toEqual([false, true]);
  });

  it('says what a robot does, the most urgent first', () => {
    expect(wordsOf({})).toEqual([
      expect.stringMatching(/^Free since .*32.*: good$/),
      '0 of 4 operators: neutral',
    ]);
    expect(
      wordsOf({ state: 'stopped', alarms: 2, battery: 0.194, operators: 4, watchers: 3 })?.slice(1),
    ).toEqual([
      '2 alarms: warning',
      'Battery 19 %: warning',
      'Full: 4 operators: warning',
      '3 watching: neutral',
    ]);
    expect(wordsOf({ battery: 0.2 })).toContain('Battery 20 %: neutral');
    expect(wordsOf({ state: 'fault' })?.[0]).toMatch(/^Wheels not responding since .*: bad$/);
    expect(wordsOf({ state: 'stopped', driver: 'Ada' })?.[0]).toMatch(/^STOP on since .*: bad$/);
  });

  it('names the driver if the robot does', () => {
    expect(wordsOf({ state: 'driven' })?.[0]).toMatch(/^In use since .*: neutral$/);
    expect(wordsOf({ state: 'driven', driver: 'Ada' })?.[0]).toMatch(/^Driven by Ada since /);
  });

  it('has the date of what is longer ago than a day', () => {
    expect(wordsOf({}, { unixMs: SINCE_MS + 86_399_999 })?.[0]).toContain('32');
    expect(wordsOf({}, { unixMs: SINCE_MS + 86_400_000 })?.[0]).toContain('2026');
  });

  it('speaks German', async () => {
    await speak('de');
    expect(wordsOf({ state: 'driven', driver: 'Ada' })?.[0]).toMatch(/^Gefahren von Ada seit /);
  });
});

it('says how long ago a robot was seen here', () => {
  expect([0, 59_999, 60_000, 7_199_999, 7_200_000].map(seenWords)).toEqual([
    'Seen here just now',
    'Seen here just now',
    'Seen here 1 min ago',
    'Seen here 119 min ago',
    'Seen here 2 h ago',
  ]);
});
