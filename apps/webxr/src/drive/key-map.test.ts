import fc from 'fast-check';
import { expect, test } from 'vitest';
import {
  assignKey,
  DEFAULT_KEYS,
  isFreeKey,
  KEY_ROLES,
  type KeyMap,
  MOST_KEYS,
  removeKey,
  roleOf,
  STOP_KEY,
  usableKeys,
} from './key-map.ts';

function mapAfter(change: ReturnType<typeof assignKey>): KeyMap {
  if (!('keys' in change)) throw new Error(change.reason);
  return change.keys;
}

function expectSafe(keys: KeyMap): void {
  expect(keys.estop).toContain(STOP_KEY);
  const all = KEY_ROLES.flatMap((role) => keys[role]);
  expect(new Set(all).size).toBe(all.length);
  for (const code of all) expect(isFreeKey(code), code).toBe(true);
  for (const role of KEY_ROLES) expect(keys[role].length).toBeLessThanOrEqual(MOST_KEYS);
}

test('the usual keys are usable', () => {
  expectSafe(DEFAULT_KEYS);
  expect(usableKeys({})).toEqual(DEFAULT_KEYS);
});

test('a key moves to another role once it has been removed', () => {
  expect(assignKey(DEFAULT_KEYS, 'forward', 'KeyR')).toEqual({ reason: 'taken', by: 'release' });
  const free = mapAfter(removeKey(DEFAULT_KEYS, 'release', 'KeyR'));
  const moved = mapAfter(assignKey(free, 'forward', 'KeyR'));
  expect(roleOf(moved, 'KeyR')).toBe('forward');
  expect(moved.release).toEqual([]);
});

test('X stops, whatever is asked for; other keys can stop as well', () => {
  expect(assignKey(DEFAULT_KEYS, 'forward', STOP_KEY)).toEqual({ reason: 'stops' });
  expect(removeKey(DEFAULT_KEYS, 'estop', STOP_KEY)).toEqual({ reason: 'stops' });
  const more = mapAfter(assignKey(DEFAULT_KEYS, 'estop', 'Numpad0'));
  expect(more.estop).toEqual([STOP_KEY, 'Numpad0']);
  expect(mapAfter(removeKey(more, 'estop', 'Numpad0')).estop).toEqual([STOP_KEY]);
});

test('keys with which the page is used without a mouse stay free, and a role has four at most', () => {
  for (const code of ['Tab', 'Enter', 'Escape', 'F5', 'ControlLeft', 'nonsense', '', 'Key W'])
    expect(assignKey(DEFAULT_KEYS, 'grip', code)).toEqual({ reason: 'reserved' });
  const four = mapAfter(assignKey(DEFAULT_KEYS, 'grip', 'Numpad0'));
  expect(assignKey(four, 'grip', 'Numpad1')).toEqual({ reason: 'full' });
});

test('whatever is stored, assigned and removed: X stops, and no key does two things', () => {
  const code = fc.oneof(
    fc.constantFrom(STOP_KEY, 'KeyW', 'Space', 'Tab', 'Numpad0', 'KeyR', '__proto__', 'Enter'),
    fc.string(),
  );
  const role = fc.constantFrom(...KEY_ROLES);
  const stored = fc.dictionary(role, fc.array(code, { maxLength: 6 }));
  const step = fc.record({ role, code, add: fc.boolean() });
  fc.assert(
    fc.property(stored, fc.array(step, { maxLength: 20 }), (stored, steps) => {
      let keys = usableKeys(stored);
      expectSafe(keys);
      for (const { role, code, add } of steps) {
        const change = add ? assignKey(keys, role, code) : removeKey(keys, role, code);
        if ('keys' in change) keys = change.keys;
        expectSafe(keys);
      }
    }),
    { seed: 12, numRuns: 500 },
  );
});
