import { expect, test } from 'vitest';
import { CommandHistory } from './command-history.ts';

test('keeps changes only, and finds what was valid when', () => {
  const commands = new CommandHistory(() => 150);
  for (let ms = 0; ms <= 100; ms += 25) commands.add(ms, 1, 0);
  commands.add(125, 1, 0.5);
  expect(commands.length).toBe(2);
  expect([-1, 0, 124, 125, 1000].map((ms) => commands.angular(commands.indexAt(ms)))).toEqual([
    0, 0, 0, 0.5, 0.5,
  ]);
  expect(commands.indexAt(-1)).toBe(-1);
  expect(commands.linear(-1)).toBe(0);
});

test('commands that stop coming stop the robot after the watchdog’s time', () => {
  const commands = new CommandHistory(() => 150);
  commands.add(0, 1, 0);
  commands.expire(149);
  expect(commands.length).toBe(1);
  commands.expire(400);
  expect([commands.timeMs(1), commands.linear(1)]).toEqual([150, 0]);
  // Also where nobody asked in between.
  commands.add(500, 1, 0);
  commands.add(900, 1, 0);
  expect([2, 3, 4].map((index) => commands.linear(index))).toEqual([1, 0, 1]);
  expect(commands.timeMs(3)).toBe(650);
});

test('a wish lasts from when it began until a command carries it, or it is given up', () => {
  const commands = new CommandHistory(() => 150);
  commands.wish(10, 1, 0);
  commands.wish(20, 1, 0.1);
  expect([commands.wishMs, commands.wishLinear, commands.wishAngular]).toEqual([10, 1, 0.1]);
  commands.add(30, 1, 0.1);
  expect(commands.wishMs).toBe(Number.POSITIVE_INFINITY);
  commands.wish(40, 0, 0);
  commands.wish(50, 1, 0.1);
  expect(commands.wishMs).toBe(Number.POSITIVE_INFINITY);
});

test('memory is bounded, and says since when it knows', () => {
  const commands = new CommandHistory(() => 150);
  for (let i = 0; i < 3000; i++) commands.add(i * 25, i % 7, 0);
  expect(commands.length).toBe(1024);
  expect(commands.knownSinceMs).toBe((3000 - 1024) * 25);
  expect(commands.linear(commands.indexAt(2999 * 25))).toBe(2999 % 7);
  commands.clear();
  expect([commands.length, commands.knownSinceMs]).toEqual([0, Number.NEGATIVE_INFINITY]);
});

test('a change to the side is a change, also of the wish', () => {
  const commands = new CommandHistory(() => 150);
  commands.add(0, 0, 0, 0.3);
  commands.add(20, 0, 0, 0.3);
  commands.add(40, 0, 0);
  expect([commands.length, commands.lateral(0), commands.lateral(1), commands.lateral(-1)]).toEqual([
    2, 0.3, 0, 0,
  ]);
  commands.wish(50, 0, 0, -0.3);
  expect([commands.wishMs, commands.wishLateral]).toEqual([50, -0.3]);
  commands.wish(60, 0, 0);
  expect(commands.wishMs).toBe(Number.POSITIVE_INFINITY);
  commands.add(70, 0, 0, 0.3);
  commands.expire(220);
  expect(commands.lateral(commands.length - 1)).toBe(0);
});
