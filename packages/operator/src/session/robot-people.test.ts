import type { ChatLine, Handover } from '@farpoint/protocol';
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

it('keeps the last twenty lines, and when they were said', () => {
  const people = new RobotPeople();
  const line = (number: number): ChatLine => ({
    ...{ type: 'chatLine', number, from: ada, yours: false, text: 'x', agoS: 2 },
  });
  for (let n = 1; n <= 25; n++) people.onChatLine(line(n), 5000);
  expect(people.lines.map(({ number }) => number)).toEqual(Array.from({ length: 20 }, (_, i) => i + 6));
  expect(people.lines[0]?.saidAtMs).toBe(3000);
});
