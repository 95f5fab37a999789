import { expect, it } from 'vitest';
import { OTHER_THREADS, perFrame, processName, threadName, threadSeconds } from './thread-times.ts';

it('calls Chromium’s processes by their types, and others as what they belong to', () => {
  expect(processName('/chrome\0--type=renderer\0--lang=en', 'browser')).toBe('page');
  expect(processName('/chrome\0--type=gpu-process', 'browser')).toBe('graphics');
  expect(processName('/chrome\0--headless', 'browser')).toBe('browser');
  expect(processName('node\0main.ts', 'robot')).toBe('robot');
});

it('calls threads by what they do, and numbered ones alike', () => {
  const named = (name: string) => threadName(`12 (${name}) S 7 42 42 0 -1`);
  expect(named('V8Worker')).toBe('garbage and compiler');
  expect(named('DedicatedWorker')).toBe('workers');
  expect(named('ThreadPoolForeg12')).toBe('ThreadPoolForeg');
  expect(named('a (b) 3')).toBe('a (b)');
});

it('divides by frames, adds up what takes little, and counts no time twice', () => {
  const before = new Map([
    ['robot: main thread', 1],
    ['robot: gone', 9],
  ]);
  const after = new Map([
    ['robot: main thread', 1.5],
    ['robot: gone', 2],
    ['robot: new', 0.001],
  ]);
  expect([...perFrame(before, after, 100, 0.15)]).toEqual([
    ['robot: main thread', 5],
    [`robot: ${OTHER_THREADS}`, 0.01],
  ]);
});

it.runIf(process.platform === 'linux')('finds this process’s main thread', () => {
  expect(threadSeconds([{ name: 'test', pid: process.pid }])?.get('test: main thread')).toBeGreaterThan(0);
});
