import { expect, test } from 'vitest';
import { EventQueue } from './event-queue.ts';

test('runs actions in order of time, including those they schedule, and never in the past', () => {
  const events = new EventQueue();
  const ran: [string, number][] = [];
  const note = (name: string) => () => ran.push([name, events.nowMs]);
  events.at(20, note('late'));
  events.at(10, () => {
    note('first')();
    events.at(5, note('due already'));
    events.at(15, note('between'));
    events.at(Number.POSITIVE_INFINITY, note('never'));
  });
  events.at(10, note('second'));
  events.runUntil(19);
  expect(ran).toEqual([
    ['first', 10],
    ['second', 10],
    ['due already', 10],
    ['between', 15],
  ]);
  expect(events.nowMs).toBe(19);
  events.runUntil(20);
  expect(ran.at(-1)).toEqual(['late', 20]);
});
