/** Keeps tests from depending on what nobody controls: real time, the load of the machine, fixed ports. */
import { expect, test } from 'vitest';
import { layerOf, violationsOf } from './lib/test-rules.ts';
import { workspaceFiles as files, readWorkspaceFile as read } from './lib/workspace-files.ts';

const tests = files.flatMap((file) => {
  const layer = layerOf(file);
  return layer === null ? [] : [{ file, violations: violationsOf(layer, read(file)) }];
});

test('there are tests that have rules', () => {
  expect(tests.length).toBeGreaterThan(50);
});

test('there are at most 20 smoke tests: what takes ten seconds each, and real time', () => {
  const smoke = tests.filter(({ file }) => layerOf(file) === 'smoke').map(({ file }) => read(file));
  const count = smoke.reduce((sum, text) => sum + (text.match(/^ *test\(/gm)?.length ?? 0), 0);
  expect(count).toBeGreaterThan(10);
  expect(count).toBeLessThanOrEqual(20);
});

test('no test breaks a rule of its layer', () => {
  const broken = tests.flatMap(({ file, violations }) =>
    violations.map(({ rule, line, text }) => `${file}:${line}: ${rule}: ${text}`),
  );
  expect(broken).toEqual([]);
});

test('vitest is told of every folder that has tests', () => {
  const [, rooms = ''] = /const ROOMS = '\{(.*)\}'/.exec(read('vitest.config.ts')) ?? [];
  const told = new Set(rooms.split(','));
  expect(
    files.filter((file) => file.endsWith('.test.ts') && !told.has(file.split('/')[0] as string)),
  ).toEqual([]);
});
