import { fstatSync, openSync } from 'node:fs';
import { pino } from 'pino';
import { expect, test } from 'vitest';
import { isJournal, toJournal } from './journal.ts';

test('the journal is the file with that device and inode, and no other', () => {
  const descriptor = openSync(import.meta.filename, 'r');
  const { dev, ino } = fstatSync(descriptor, { bigint: true });
  expect(isJournal(`${dev}:${ino}`, descriptor)).toBe(true);
  expect(isJournal(`${dev}:${ino + 1n}`, descriptor)).toBe(false);
  expect(isJournal(undefined, descriptor)).toBe(false);
  expect(isJournal('', descriptor)).toBe(false);
});

test('each line has the priority of its level', () => {
  const lines: string[] = [];
  const log = pino({ level: 'trace' }, toJournal({ write: (line) => void lines.push(line) }));
  for (const level of ['trace', 'debug', 'info', 'warn', 'error', 'fatal'] as const) log[level]('x');
  log.child({ session: 's' }).warn('x');
  expect(lines.map((line) => line.slice(0, 4))).toEqual([
    ...['<7>{', '<7>{', '<6>{', '<4>{', '<3>{', '<2>{'],
    '<4>{',
  ]);
});
