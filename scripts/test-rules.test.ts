/**
 * Keeps tests from depending on what nobody controls: real time, the load of the machine, fixed ports. What breaks a rule
 * today is an exception; there may be fewer of them, and no new ones.
 */
import { expect, test } from 'vitest';
import { layerOf, violationsOf } from './lib/test-rules.ts';
import { workspaceFiles as files, readWorkspaceFile as read } from './lib/workspace-files.ts';

/** A socket brings a message when the browser does. */
const POLLING = 'no polling';

/** Rules that these files break. Delete an entry as soon as its file keeps the rule. */
const EXCEPTIONS: Readonly<Record<string, readonly string[]>> = {
  'e2e/pages/signaling.page.ts': [POLLING],
};

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
    violations
      .filter(({ rule }) => !(EXCEPTIONS[file] ?? []).includes(rule))
      .map(({ rule, line, text }) => `${file}:${line}: ${rule}: ${text}`),
  );
  expect(broken).toEqual([]);
});

test('every exception is needed', () => {
  const needless = Object.entries(EXCEPTIONS).flatMap(([file, rules]) => {
    const broken = new Set(tests.find((each) => each.file === file)?.violations.map(({ rule }) => rule));
    return rules.filter((rule) => !broken.has(rule)).map((rule) => `${file}: ${rule}`);
  });
  expect(needless, 'delete these from EXCEPTIONS').toEqual([]);
});
