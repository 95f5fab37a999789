import { describe, expect, test } from 'vitest';
import { BUTTON_ROLES, EMPTY_MAP, STANDARD_MAP } from '../drive/controller-map.ts';
import { assignKey, DEFAULT_KEYS, KEY_ROLES, type KeyMap, removeKey } from '../drive/key-map.ts';
import { gestureWords } from '../status/help-words.ts';
import { keyName, keyRoleWords } from '../status/input-words.ts';
import { GROUPS, helpGroups } from './help-groups.ts';

const pad = { name: 'Pad', map: STANDARD_MAP, isStandard: true };
const rows = (...args: Parameters<typeof helpGroups>) => helpGroups(...args).flatMap((group) => group.rows);
const row = (what: string, ...args: Parameters<typeof helpGroups>) =>
  rows(...args).find((each) => each.what === what);

function with_(keys: KeyMap, role: 'forward', code: string): KeyMap {
  const change = assignKey(keys, role, code);
  if (!('keys' in change)) throw new Error(change.reason);
  return change.keys;
}

describe('the help', () => {
  test('has every role of a key and every gesture exactly once', () => {
    const listed = GROUPS.flatMap(({ roles }) => roles);
    expect(new Set(listed).size).toBe(listed.length);
    expect(new Set(listed)).toEqual(new Set([...KEY_ROLES, ...Object.keys(gestureWords)]));
  });

  test('names every key, button and axis that does something', () => {
    const listed = rows(DEFAULT_KEYS, false, [pad]);
    const keys = listed.flatMap((each) => each.keys);
    expect(new Set(keys)).toEqual(new Set([...Object.values(DEFAULT_KEYS).flat().map(keyName), '?']));
    const parts = new Set(listed.flatMap(({ controllers }) => controllers.flatMap((each) => each.parts)));
    const mapped = BUTTON_ROLES.flatMap((role) => STANDARD_MAP.buttons[role]);
    // Four axes besides.
    expect(parts.size).toBe(mapped.length + 4);
    expect(row(keyRoleWords.estop, DEFAULT_KEYS, false, [pad])).toMatchObject({
      ...{ keys: ['X'], controllers: [{ name: 'Pad', parts: ['B'] }] },
      hand: expect.stringContaining('STOP'),
    });
  });

  test('follows what was chosen', () => {
    const removed = removeKey(DEFAULT_KEYS, 'forward', 'KeyW');
    if (!('keys' in removed)) throw new Error('not removed');
    const keys = with_(removed.keys, 'forward', 'KeyI');
    expect(row('Forward', keys, false, [])?.keys).toEqual(['↑', 'I']);
    const axis = { axis: 2, centre: 1, least: -1, most: 1, inverted: true, deadZone: 0.1 };
    const map = {
      sticks: [{ forward: axis, back: { ...axis, axis: 5 }, left: { ...axis, axis: 0 } }],
      buttons: { ...EMPTY_MAP.buttons, grip: [0] },
    };
    const raw = { name: 'Wheel', map, isStandard: false };
    const partsOf = (what: string) => row(what, keys, false, [raw])?.controllers;
    expect(partsOf('Forward')).toEqual([{ name: 'Wheel', parts: ['axis 3'] }]);
    expect(partsOf('Backward')).toEqual([{ name: 'Wheel', parts: ['axis 6'] }]);
    expect(partsOf('Right')).toEqual([{ name: 'Wheel', parts: ['axis 1'] }]);
    expect(partsOf('Grip (hold to drive)')).toEqual([{ name: 'Wheel', parts: ['button 1'] }]);
    expect(partsOf('STOP')).toEqual([]);
  });

  test('says that a key for a direction is the grip, if it is', () => {
    expect(row(keyRoleWords.grip, DEFAULT_KEYS, false, [])?.hand).not.toContain('direction');
    expect(row(keyRoleWords.grip, DEFAULT_KEYS, true, [])?.hand).toContain('any key for a direction');
  });
});
