import type { Handover } from '@farpoint/protocol';
import { expect, it } from 'vitest';
import { givesYou, RobotPeople } from './robot-people.ts';

const [ada, bob] = [
  { number: 1, name: 'Ada' },
  { number: 2, name: 'Bob' },
];
const ask: Handover = { type: 'handover', id: 3, kind: 'ask', from: bob, to: ada, yours: false };

it('keeps what can be answered until the robot says how it ended, or its time is over', () => {
  const people = new RobotPeople();
  people.onHandover({ ...ask, leftMs: 15_000 }, 1000);
  const { type: _, ...open } = ask;
  expect(people.open(15_999)).toEqual([{ ...open, endsAtMs: 16_000 }]);
  expect(people.open(16_000)).toEqual([]);
  people.onHandover({ ...ask, ended: 'refused' }, 2000);
  expect(people.open(2000)).toEqual([]);
});

it('knows who drives after it was accepted', () => {
  const end = (kind: Handover['kind'], yours: boolean, ended: Handover['ended'] = 'accepted') =>
    givesYou({ ...ask, kind, yours, ended });
  expect([end('ask', true), end('offer', false)]).toEqual([true, true]);
  expect([end('ask', false), end('offer', true), end('ask', true, 'refused')]).toEqual([false, false, false]);
});

it('knows since when who drives has driven', () => {
  const people = new RobotPeople();
  people.onOperators({ type: 'operators', operators: [], drivesForS: 7 }, 10_000);
  expect(people.drivesSinceMs).toBe(3000);
  people.onOperators({ type: 'operators', operators: [] }, 11_000);
  expect(people.drivesSinceMs).toBeNull();
});

it('keeps no more than a robot can mean, whatever it sends, and forgets what is over', () => {
  const people = new RobotPeople();
  for (let id = 0; id < 1000; id++) people.onHandover({ ...ask, id, leftMs: 100 }, 0);
  expect(people.open(0)).toHaveLength(64);
  people.onHandover({ ...ask, id: 2000, leftMs: 100 }, 100);
  expect(people.open(100).map(({ id }) => id)).toEqual([2000]);
});
