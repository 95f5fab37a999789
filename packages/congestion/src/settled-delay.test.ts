import { expect, test } from 'vitest';
import { SettledDelay } from './settled-delay.ts';

const after = (delays: readonly number[]): number => {
  const delay = new SettledDelay();
  for (const ms of delays) delay.add(ms);
  return delay.value;
};
const ten = (of: (i: number) => number) => Array.from({ length: 10 }, (_, i) => of(i));

test('finds the floor that the delay falls to again and again', () => {
  expect(after(ten(() => 37))).toBe(37);
  expect(after(ten((i) => (i % 2 === 0 ? 37 + 0.1 * i : 42 + i)))).toBe(37);
});

test('finds no floor for a queue that grows, shrinks or oscillates', () => {
  expect(after(ten((i) => 37 + i))).toBeNaN();
  expect(after(ten((i) => 60 - 0.5 * i))).toBeNaN();
  expect(after(ten((i) => 40 + 8 * Math.sin(1.3 * i)))).toBeNaN();
});

test('needs time to find a floor, and forgets', () => {
  expect(after(ten(() => 37).slice(1))).toBeNaN();
  expect(after([...ten((i) => i), ...ten(() => 21)])).toBe(21);
  const delay = new SettledDelay();
  for (let i = 0; i < 20; i++) delay.add(5);
  delay.reset();
  expect(delay.value).toBeNaN();
});
