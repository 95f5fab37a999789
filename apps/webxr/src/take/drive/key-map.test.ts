import fc from 'fast-check';
import { expect, test } from 'vitest';
import {
  assignKey,
  DEFAULT_KEYS,
  isFreeKey,
  KEY_PRESETS,
  KEY_ROLES,
  type KeyMap,
  type KeyRole,
  MOST_KEYS,
  mainKey,
  pressedRole,
  removeKey,
  roleOf,
  SIDEWAYS_ROLES,
  STOP_KEY_ALWAYS,
  usableKeys,
} from './key-map.ts';

function mapAfter(change: ReturnType<typeof assignKey>): KeyMap {
  if (!('keys' in change)) throw new Error(change.reason);
  return change.keys;
}

function expectSafe(keys: KeyMap): void {
  expect(keys.estop.length).toBeGreaterThan(0);
  const all = KEY_ROLES.flatMap((role) => keys[role]);
  expect(new Set(all).size).toBe(all.length);
  for (const code of all) expect(isFreeKey(code), code).toBe(true);
  for (const role of KEY_ROLES) expect(keys[role].length).toBeLessThanOrEqual(MOST_KEYS);
}

/** Needed too rarely for one hand to have a key for it: each has a button, or few robots' bases can. */
const RARE: readonly KeyRole[] = ['events', 'picture', 'clip', ...SIDEWAYS_ROLES];

test('all presets are usable, and have a key for everything that is needed often', () => {
  for (const preset of Object.values(KEY_PRESETS)) {
    expectSafe(preset);
    expect(usableKeys(preset)).toEqual(preset);
    for (const role of KEY_ROLES)
      if (!RARE.includes(role)) expect(preset[role].length, role).toBeGreaterThan(0);
  }
  expect(usableKeys({})).toEqual(DEFAULT_KEYS);
});

test('the keys of the left hand lie at the left, those of the right hand at the right; X stops in all of them', () => {
  const left = /^(Digit[1-6]|Key[QWERTASDFGZXCVB]|Backquote|Space|ShiftLeft)$/;
  const right =
    /^(Digit[6-90]|Minus|Key[YUIOPHJKLNM]|Comma|Period|Equal|Bracket(Left|Right)|Semicolon|Quote|Slash|Space|ShiftRight|Arrow(Left|Right)|Numpad.+)$/;
  for (const role of KEY_ROLES) {
    for (const code of KEY_PRESETS.left[role]) expect(code).toMatch(left);
    for (const code of KEY_PRESETS.right[role]) if (code !== 'KeyX') expect(code).toMatch(right);
  }
  for (const { estop } of Object.values(KEY_PRESETS)) expect(estop).toContain('KeyX');
});

test('a key moves to another role once it has been removed', () => {
  expect(assignKey(DEFAULT_KEYS, 'forward', 'KeyR')).toEqual({ reason: 'taken', by: 'release' });
  const free = mapAfter(removeKey(DEFAULT_KEYS, 'release', 'KeyR'));
  const moved = mapAfter(assignKey(free, 'forward', 'KeyR'));
  expect(roleOf(moved, 'KeyR')).toBe('forward');
  expect(moved.release).toEqual([]);
});

test('a role is known by its usual key, or else by the one that was chosen in its place', () => {
  const added = mapAfter(assignKey(DEFAULT_KEYS, 'forward', 'KeyI'));
  expect(mainKey(added, 'forward')).toBe('KeyW');
  const changed = mapAfter(removeKey(added, 'forward', 'KeyW'));
  expect([changed.forward, mainKey(changed, 'forward')]).toEqual([['ArrowUp', 'KeyI'], 'KeyI']);
  const arrow = mapAfter(removeKey(changed, 'forward', 'KeyI'));
  expect(mainKey(arrow, 'forward')).toBe('ArrowUp');
  expect(mainKey(mapAfter(removeKey(arrow, 'forward', 'ArrowUp')), 'forward')).toBe(undefined);
});

test('a question mark asks for help wherever the keyboard has it, but no key that drives or stops does', () => {
  // On a German keyboard it is on the key to the right of 0.
  expect(pressedRole(DEFAULT_KEYS, 'Minus', '?')).toBe('help');
  expect(pressedRole(DEFAULT_KEYS, 'Slash', '-')).toBe('help');
  expect(pressedRole(KEY_PRESETS.right, 'Minus', '?')).toBe('help');
  expect(pressedRole(KEY_PRESETS.right, 'Minus', 'ß')).toBe('predict');
  for (const role of ['estop', 'grip', 'forward', 'back', 'left', 'right', 'release', 'talk'] as const) {
    const keys = { ...DEFAULT_KEYS, help: [], [role]: ['Slash'] };
    expect(pressedRole(keys, 'Slash', '?')).toBe(role);
  }
});

test('X may give way to another key for STOP, but the last one stays; F9 gets no other use', () => {
  expect(removeKey(DEFAULT_KEYS, 'estop', 'KeyX')).toEqual({ reason: 'last-stop' });
  const more = mapAfter(assignKey(DEFAULT_KEYS, 'estop', 'Numpad0'));
  const other = mapAfter(removeKey(more, 'estop', 'KeyX'));
  expect(other.estop).toEqual(['Numpad0']);
  expect(mapAfter(assignKey(other, 'recentre', 'KeyX')).recentre).toEqual(['KeyC', 'KeyX']);
  expect(assignKey(DEFAULT_KEYS, 'recentre', STOP_KEY_ALWAYS)).toEqual({ reason: 'always-stops' });
});

test('keys with which the page is used without a mouse stay free, and a role has four at most', () => {
  for (const code of ['Tab', 'Enter', 'Escape', 'F5', 'ControlLeft', 'nonsense', '', 'Key W'])
    expect(assignKey(DEFAULT_KEYS, 'grip', code)).toEqual({ reason: 'reserved' });
  const four = mapAfter(assignKey(DEFAULT_KEYS, 'grip', 'Numpad0'));
  expect(assignKey(four, 'grip', 'Numpad1')).toEqual({ reason: 'full' });
});

test('whatever is stored, assigned and removed: a key stops, and no key does two things', () => {
  const code = fc.oneof(
    fc.constantFrom('KeyX', 'KeyW', 'Space', 'Tab', 'F9', 'Numpad0', 'KeyR', '__proto__', 'Enter'),
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
