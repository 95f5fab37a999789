import { afterEach, describe, expect, test } from 'vitest';
import { BUTTON_ROLES, EMPTY_MAP, STANDARD_MAP } from '../take/drive/controller-map.ts';
import { DEFAULT_KEYS, KEY_ROLES } from '../take/drive/key-map.ts';
import { HELP_GROUPS, helpGroups } from './help-rows.ts';
import { keyName } from './input-words.ts';
import { laterTexts, speak } from './language.ts';

afterEach(() => speak('en'));

const pad = { name: 'Pad', map: STANDARD_MAP, isStandard: true };
const rows = (...args: Parameters<typeof helpGroups>) => helpGroups(...args).flatMap((group) => group.rows);
const row = (what: string, ...args: Parameters<typeof helpGroups>) =>
  rows(...args).find((each) => each.what === what);

describe('the help', () => {
  test('has every role of a key and every gesture exactly once', () => {
    const listed = Object.values(HELP_GROUPS).flat();
    expect(new Set(listed).size).toBe(listed.length);
    expect(new Set(listed)).toEqual(new Set([...KEY_ROLES, ...Object.keys(laterTexts().help.gestures)]));
  });

  test('names every key, button and axis that does something', () => {
    const listed = rows(DEFAULT_KEYS, [pad]);
    const keys = listed.flatMap((each) => each.keys);
    const mapped = Object.values(DEFAULT_KEYS).flat().map(keyName);
    expect(keys.toSorted()).toEqual([...mapped, 'F9', '?'].toSorted());
    const parts = new Set(listed.flatMap(({ controllers }) => controllers.flatMap((each) => each.parts)));
    const buttons = BUTTON_ROLES.flatMap((role) => STANDARD_MAP.buttons[role]);
    // Both ways of either stick besides.
    expect(parts.size).toBe(buttons.length + 4);
    expect(row('STOP', DEFAULT_KEYS, [pad])).toEqual({
      what: 'STOP',
      keys: ['X', 'F9'],
      controllers: [{ name: 'Pad', parts: ['B'] }],
      hand: 'press STOP',
    });
  });

  test('follows what was chosen, and numbers what the browser does not know', () => {
    const keys = { ...DEFAULT_KEYS, forward: ['ArrowUp', 'KeyI'], predict: [], help: ['KeyQ'] };
    expect(row('Forward', keys, [])).toMatchObject({ keys: ['↑', 'I'], controllers: [] });
    expect(row('Predicted view', keys, [pad])).toMatchObject({ keys: [], controllers: [], hand: null });
    expect(row('Help', keys, [])?.keys).toEqual(['Q', '?']);
    const axis = { axis: 2, centre: 1, least: -1, most: 1, inverted: true, deadZone: 0.1 };
    const map = {
      sticks: [{ forward: axis, back: { ...axis, axis: 5 }, left: { ...axis, axis: 0 } }],
      buttons: { ...EMPTY_MAP.buttons, grip: [0] },
      gripAxis: { ...axis, axis: 3 },
    };
    const parts = (what: string, back: typeof axis | null = map.sticks[0]!.back) => {
      const sticks = [{ ...map.sticks[0]!, back }];
      const wheel = { name: 'Wheel', map: { ...map, sticks }, isStandard: false };
      return row(what, keys, [wheel])?.controllers;
    };
    expect(parts('Forward')).toEqual([{ name: 'Wheel', parts: ['axis 3'] }]);
    expect(parts('Backward')).toEqual([{ name: 'Wheel', parts: ['axis 6'] }]);
    expect(parts('Backward', null)).toEqual([{ name: 'Wheel', parts: ['axis 3'] }]);
    expect(parts('Turn right')).toEqual([{ name: 'Wheel', parts: ['axis 1'] }]);
    expect(parts('Grip (hold to drive)')).toEqual([{ name: 'Wheel', parts: ['button 1', 'axis 4'] }]);
    expect(parts('STOP')).toEqual([]);
  });

  test('is in the page’s language', async () => {
    await speak('de');
    expect(helpGroups(DEFAULT_KEYS, [])[0]?.title).toBe('Fahren');
    expect(row('Umsehen', DEFAULT_KEYS, [])?.hand).toBe('das Bild ziehen');
  });
});

test('what goes sideways is listed only with a robot that can', () => {
  const aside = (goesSideways: boolean) =>
    rows(DEFAULT_KEYS, [pad], goesSideways).filter(({ what }) => what.startsWith('Sideways'));
  expect(aside(true).map(({ keys, controllers }) => [keys, controllers])).toEqual([
    [[','], []],
    [['.'], []],
  ]);
  expect(aside(false)).toEqual([]);
  const axis = { axis: 2, centre: 0, least: -1, most: 1, inverted: true, deadZone: 0.1 };
  const map = { ...EMPTY_MAP, sticks: [{ forward: null, back: null, left: null, sideways: axis }] };
  const [left] = rows(DEFAULT_KEYS, [{ name: 'Pad', map, isStandard: true }]).filter(
    ({ what }) => what === 'Sideways to the left',
  );
  expect(left?.controllers).toEqual([{ name: 'Pad', parts: ['right stick ↔'] }]);
});
