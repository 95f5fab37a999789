import type { StageSummary } from '@farpoint/operator';
import { expect, test } from 'vitest';
import { menuTimes } from './menu-times-words.ts';

const of = (p50: number) => ({ p50, p95: 2 * p50, p99: 2 * p50, max: 2 * p50 });
const rows = { rows: 60, untold: 0, clockless: 0 };

test('a line with the total and one for each stage; the longest stands out', () => {
  const stages = { hand: of(4), page: of(2), link: of(60), gate: of(1), wheels: of(20) };
  const commands = { ...rows, totalMs: of(90), stages, worst: 'link' } as const;
  const told = menuTimes(null, commands);
  expect(told.clouds).toHaveLength(1);
  expect(told.commands).toHaveLength(6);
  expect(told.commands[0]?.text).toBe('Commands: 90 ms, 95 of 100 within 180 ms');
  expect(told.commands.find(({ tone }) => tone === 'warning')?.text).toBe('link: 60 ms, 95 % within 120 ms');
});

test('what nobody has told is said to be unknown', () => {
  const stages = { hand: null, page: null, link: null, gate: null, wheels: null };
  const untold: StageSummary<'hand' | 'page' | 'link' | 'gate' | 'wheels'> = {
    rows: 60,
    untold: 60,
    clockless: 0,
    totalMs: null,
    stages,
    worst: null,
  };
  expect(menuTimes(null, untold).commands.at(-1)?.text).toContain('has told its own times of none');
});
