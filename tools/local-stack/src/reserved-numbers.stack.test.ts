import { spawnSync } from 'node:child_process';
import { expect, test } from 'vitest';
import { reserveNumber, reserveNumberNow, tryReserve } from './reserved-numbers.ts';

/** Kinds of their own, or those of another run on this machine would be in the way. */
const kind = `test-of-${process.pid}`;
const module = new URL('./reserved-numbers.ts', import.meta.url).href;

/** What another process, that ends thereupon, gets from the same range. */
function inAnotherProcess(range: object, end = ''): string {
  const program = `const { reserveNumberNow } = await import(process.argv[1]);
    try { console.log(reserveNumberNow(${JSON.stringify(range)})) } catch { console.log('none') }
    ${end}`;
  const args = ['--input-type=module', '--eval', program, module];
  return spawnSync(process.execPath, args, { encoding: 'utf8' }).stdout.trim();
}

test('nobody gets a number twice, in this process or in another', () => {
  const range = { kind: `${kind}-a`, first: 5, last: 11, step: 3 };
  const got = [
    reserveNumberNow(range),
    Number(inAnotherProcess(range)),
    reserveNumberNow(range),
    reserveNumberNow(range),
  ];
  expect(new Set([got[0], got[2], got[3]])).toEqual(new Set([5, 8, 11]));
  expect(got[1]).not.toBe(got[0]);
  expect(() => reserveNumberNow(range)).toThrow('no test-of');
  expect(inAnotherProcess(range)).toBe('none');
});

test('a process that ends or is killed holds nothing', () => {
  const range = { kind: `${kind}-b`, first: 1, last: 1 };
  expect(inAnotherProcess(range, "process.kill(process.pid, 'SIGKILL')")).toBe('1');
  expect(inAnotherProcess(range)).toBe('1');
  expect(tryReserve(range.kind, 1)).toBe(true);
});

test('a number that something else uses is left out, and stays free', async () => {
  const range = { kind: `${kind}-c`, first: 1, last: 3 };
  expect(await reserveNumber(range, (number) => number === 2)).toBe(2);
  expect(new Set([reserveNumberNow(range), reserveNumberNow(range)])).toEqual(new Set([1, 3]));
});
