import type { RobotStatus } from '@farpoint/protocol';
import { describe, expect, it } from 'vitest';
import { type FleetFacts, foundWords, listedRobots, seenWords } from './fleet-words.ts';

const quiet: RobotStatus = {
  ...{ estop: false, moving: false, driven: false, operators: 0, maxOperators: 4, alarms: 0 },
};
const robots = [
  { id: 'r-3', name: 'Zebra' },
  { id: 'r-1', name: 'ant' },
  { id: 'r-2', name: 'Bee' },
];
const facts = (change: Partial<FleetFacts> = {}): FleetFacts => ({
  ...{ robots, statuses: new Map(), order: 'name', search: '' },
  ...change,
});
const names = (change: Partial<FleetFacts>) => listedRobots(facts(change)).map(({ name }) => name);
const wordsOf = (status: Partial<RobotStatus>) =>
  listedRobots(facts({ statuses: new Map([['r-1', { ...quiet, ...status }]]) }))[0]?.words;

describe('the list of robots', () => {
  it('is in the order of the names, whatever their case, and nothing is said of who says nothing', () => {
    expect(names({})).toEqual(['ant', 'Bee', 'Zebra']);
    expect(listedRobots(facts()).map(({ words }) => words)).toEqual([null, null, null]);
  });

  it('finds a part of a name or an id', () => {
    expect(names({ search: ' BE ' })).toEqual(['Bee']);
    expect(names({ search: 'e' })).toEqual(['Bee', 'Zebra']);
    expect(names({ search: 'r-3' })).toEqual(['Zebra']);
    expect(names({ search: 'x' })).toEqual([]);
    expect([foundWords(2, 3), foundWords(3, 3)]).toEqual(['2 of 3 robots', '3 robots']);
  });

  it('puts first what needs attention, or the lowest battery; who says nothing comes last', () => {
    const statuses = new Map<string, RobotStatus>([
      ['r-1', { ...quiet, battery: 0.15 }],
      ['r-3', { ...quiet, estop: true, battery: 0.9 }],
    ]);
    expect(names({ statuses, order: 'attention' })).toEqual(['Zebra', 'ant', 'Bee']);
    expect(names({ statuses, order: 'battery' })).toEqual(['ant', 'Zebra', 'Bee']);
    statuses.set('r-2', { ...quiet, alarms: 1 });
    expect(names({ statuses, order: 'attention' })).toEqual(['Zebra', 'Bee', 'ant']);
  });

  it('says how long ago a robot was seen here', () => {
    expect([0, 59_999, 60_000, 7_199_999, 7_200_000].map(seenWords)).toEqual([
      ...['seen here just now', 'seen here just now', 'seen here 1 min ago'],
      ...['seen here 119 min ago', 'seen here 2 h ago'],
    ]);
  });

  it('says what a robot does, the most urgent first', () => {
    expect(wordsOf({})).toEqual([
      { text: 'Nobody drives', tone: 'neutral' },
      { text: '0 of 4 here', tone: 'neutral' },
    ]);
    const busy = { estop: true, alarms: 2, driven: true, moving: true, battery: 0.194, operators: 4 };
    expect(wordsOf(busy)?.map(({ text, tone }) => `${text}: ${tone}`)).toEqual([
      'STOP is on: bad',
      '2 alarms: warning',
      'Somebody drives: neutral',
      'moving: neutral',
      'battery 19 %: warning',
      'full: 4 here: warning',
    ]);
    expect(wordsOf({ driven: true, driver: 'Ada' })?.[0]?.text).toBe('Ada drives');
  });
});
