import fc from 'fast-check';
import { expect, test } from 'vitest';
import {
  compareVersions,
  formatVersion,
  leastStep,
  nextVersion,
  parseVersion,
  STEPS,
  type Version,
} from './version.ts';

const part = fc.nat(1000);
const version = fc.tuple(part, part, part) satisfies fc.Arbitrary<Version>;

test('what is written can be read', () => {
  fc.assert(
    fc.property(version, (v) => {
      expect(parseVersion(formatVersion(v))).toEqual(v);
    }),
  );
});

test.each(['', '1', '1.2', 'v1.2.3', '1.2.3-rc.1', '01.2.3', '1.2.3 ', '1.2.x'])(
  '%j is no version',
  (text) => {
    expect(parseVersion(text)).toBe(null);
  },
);

test('each step leads further than the one before it', () => {
  fc.assert(
    fc.property(version, (v) => {
      const path = [v, ...STEPS.map((step) => nextVersion(v, step))];
      for (let i = 1; i < path.length; i++)
        expect(compareVersions(path[i]!, path[i - 1]!)).toBeGreaterThan(0);
    }),
  );
});

test.each([
  [[0, 3, 1], ['Breaking changes', 'Fixed'], 'minor'],
  [[0, 3, 1], ['Added'], 'minor'],
  [[0, 3, 1], ['Fixed', 'Security'], 'patch'],
  [[1, 3, 1], ['Breaking changes'], 'major'],
  [[1, 3, 1], ['Removed'], 'major'],
  [[1, 3, 1], ['Deprecated', 'Fixed'], 'minor'],
  [[1, 3, 1], ['Fixed'], 'patch'],
] as const)('after %j, %j ask for a %s release', (present, kinds, step) => {
  expect(leastStep(kinds, present)).toBe(step);
});
