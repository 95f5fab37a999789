import { toTwist } from '@farpoint/operator';
import fc from 'fast-check';
import { expect, test } from 'vitest';
import { deflection, GRIP_SHARES } from './axis-map.ts';
import {
  BUTTON_ROLES,
  type ControllerMap,
  EMPTY_MAP,
  missingOf,
  STANDARD_MAP,
  STANDARD_STOP,
} from './controller-map.ts';
import { GamepadInput } from './gamepad-input.ts';
import {
  choicesText,
  controllerKey,
  DEFAULT_CHOICES,
  type InputChoices,
  isStandardKey,
  MOST_CONTROLLERS,
  parseChoices,
} from './input-choices.ts';
import { InputSettings } from './input-settings.ts';
import { DEFAULT_KEYS, KEY_PRESETS, KEY_ROLES } from './key-map.ts';
import { ScaledInput, SpeedChoice } from './speed-choice.ts';

const axis = { axis: 2, centre: 1, least: -1, most: 1, inverted: true, deadZone: 0.12 };
const wheel = {
  sticks: [{ forward: axis, back: { ...axis, axis: 1 }, left: { ...axis, axis: 0, centre: 0 } }],
  buttons: { ...STANDARD_MAP.buttons, grip: [10, 11], estop: [20] },
  gripAxis: { ...axis, axis: 5 },
};
const settingsOf = (choices: InputChoices) => new InputSettings(choices, () => {});

test('what is chosen is read back as it was', () => {
  const choices: InputChoices = {
    keys: { ...DEFAULT_CHOICES.keys, release: ['Numpad5'] },
    controllers: new Map([['raw:wheel', wheel]]),
    speed: 0.5,
  };
  expect(parseChoices(choicesText(choices))).toEqual(choices);
  expect(parseChoices(choicesText(DEFAULT_CHOICES))).toEqual(DEFAULT_CHOICES);
});

test('an axis for sideways is read back; as the grip it would drive, and is none', () => {
  const aside = { ...wheel, sticks: [{ ...wheel.sticks[0], sideways: { ...axis, axis: 3, centre: 0 } }] };
  const stored = (map: typeof aside) =>
    parseChoices(JSON.stringify({ controllers: [{ key: 'raw:wheel', ...map }] })).controllers.get(
      'raw:wheel',
    );
  expect(stored(aside)).toEqual(aside);
  expect(stored({ ...aside, gripAxis: { ...axis, axis: 3 } })?.gripAxis).toBe(null);
  const broken = { ...axis, deadZone: 7 };
  expect(stored({ ...aside, sticks: [{ ...wheel.sticks[0], sideways: broken }] } as typeof aside)).toBe(
    undefined,
  );
});

test('what cannot be read is replaced by what is usual, and nothing else with it', () => {
  for (const text of [null, '', '{', '[]', '7', 'null', '{"keys":1}', JSON.stringify({ keys: {}, speed: 1 })])
    expect(parseChoices(text)).toEqual(DEFAULT_CHOICES);
  const { left } = KEY_PRESETS;
  const keys = {
    ...left,
    talk: 'KeyQ',
    recentre: [7],
    view: ['x'.repeat(33)],
    dashboard: Array(5).fill('KeyZ'),
  };
  const broken: unknown[] = [
    { ...wheel, sticks: [{ ...wheel.sticks[0], left: { ...axis, least: 1, centre: 0 } }] },
    { ...wheel, sticks: [{ ...wheel.sticks[0], left: { ...axis, deadZone: 0.01 } }] },
    { ...wheel, sticks: [{ ...wheel.sticks[0], left: { ...axis, deadZone: 0.61 } }] },
    { ...wheel, sticks: [] },
    { ...wheel, buttons: { grip: [1] } },
  ].map((each, i) => ({ key: `raw:${i}`, ...each }));
  const controllers = [...broken, { key: 'raw:wheel', ...wheel }, { ...wheel, key: 'xbox' }, 7];
  const read = parseChoices(JSON.stringify({ keys, controllers, speed: 9 }));
  expect([...read.controllers.keys()]).toEqual(['raw:wheel']);
  expect(read.speed).toBe(1);
  const { talk, recentre, view, dashboard } = DEFAULT_KEYS;
  expect(read.keys).toEqual({ ...left, talk, recentre, view, dashboard });
});

test('a device without a grip that is held is as if nobody had set it up; a grip that drives is none', () => {
  const buttons = { ...wheel.buttons, grip: [] };
  const read = (map: ControllerMap) =>
    parseChoices(JSON.stringify({ controllers: [{ key: 'raw:a', ...map }] })).controllers.size;
  expect(read({ ...wheel, buttons })).toBe(1);
  expect(read({ ...wheel, buttons, gripAxis: null })).toBe(0);
  expect(read({ ...wheel, buttons, gripAxis: axis })).toBe(0);
  expect(read({ ...wheel, sticks: EMPTY_MAP.sticks })).toBe(0);
});

test('a browser remembers the devices that were set up last', () => {
  const many = new Map(Array.from({ length: 40 }, (_, i) => [`raw:${i}`, wheel] as const));
  const { controllers } = parseChoices(choicesText({ ...DEFAULT_CHOICES, controllers: many }));
  expect([controllers.size, MOST_CONTROLLERS]).toEqual([32, 32]);
  expect([...controllers.keys()].at(-1)).toBe('raw:39');
});

test('a device that nobody knows does nothing; one in the standard mapping always stops by B', () => {
  const raw = controllerKey({ id: 'Joystick (Vendor: 1)', mapping: '' });
  const usual = settingsOf(DEFAULT_CHOICES);
  expect(missingOf(usual.mapOf(raw))).toBe('grip');
  expect([usual.isUnknown(raw), usual.isUnknown('standard:x')]).toEqual([true, false]);
  const standard = controllerKey({ id: 'Pad', mapping: 'standard' });
  expect(usual.mapOf(standard)).toBe(STANDARD_MAP);
  const stolen = {
    key: standard,
    ...STANDARD_MAP,
    buttons: { ...STANDARD_MAP.buttons, grip: [STANDARD_STOP, 5], estop: [] },
  };
  const { buttons } = settingsOf(parseChoices(JSON.stringify({ controllers: [stolen] }))).mapOf(standard);
  expect([buttons.estop, buttons.grip]).toEqual([[STANDARD_STOP], [5]]);
});

test('each choice is kept, and only once somebody has chosen', () => {
  const kept: InputChoices[] = [];
  const settings = new InputSettings(DEFAULT_CHOICES, (choices) => kept.push(choices));
  expect(kept).toEqual([]);
  settings.usePreset('left');
  settings.speed.set(0.5);
  settings.setController('raw:wheel', wheel);
  expect(kept.at(-1)).toEqual({
    ...{ keys: KEY_PRESETS.left, speed: 0.5 },
    controllers: new Map([['raw:wheel', wheel]]),
  });
  settings.setController('raw:wheel', null);
  expect(kept.at(-1)?.controllers.size).toBe(0);
});

const anyNumber = fc.oneof(fc.double(), fc.constantFrom(Number.NaN, Infinity, -Infinity, 1, -1, 0));
const anyAxis = fc.oneof(
  fc.constant(null),
  fc.record({
    ...{ axis: fc.nat(4), inverted: fc.boolean(), deadZone: fc.constantFrom(0.02, 0.1, 0.6, 7) },
    centre: fc.constantFrom(-1, -0.2, 0, 0.1, 1),
    least: fc.constantFrom(-1, -0.1, 0, 1),
    most: fc.constantFrom(-1, 0, 0.1, 1, 5),
  }),
);
const anyButtons = fc.array(fc.nat(6), { maxLength: 5 });
const anyController = fc.record({
  key: fc.constantFrom('raw:a', 'standard:a', 'other'),
  sticks: fc.array(fc.record({ forward: anyAxis, back: anyAxis, left: anyAxis }), { maxLength: 3 }),
  buttons: fc.record(Object.fromEntries(BUTTON_ROLES.map((role) => [role, anyButtons]))),
  gripAxis: anyAxis,
});
const anyStored = fc.oneof(
  fc.jsonValue(),
  fc.record({
    keys: fc.dictionary(
      fc.constantFrom(...KEY_ROLES),
      fc.array(fc.constantFrom('KeyX', 'KeyW', 'Tab', 'F9', 'Space')),
    ),
    controllers: fc.array(anyController, { maxLength: 3 }),
    speed: anyNumber,
  }),
);

/** Whether the axis that is the grip is pressed at all. */
function isPressed(state: { axes: readonly (number | null)[] } | null, { gripAxis }: ControllerMap): boolean {
  return gripAxis !== null && deflection(state?.axes[gripAxis.axis], gripAxis) > GRIP_SHARES.open;
}

test('whatever is stored and whatever a controller reads, nothing moves without a grip nor beyond the limits', () => {
  const limits = { maxLinear: 1.5, maxAngular: 2 };
  const reading = fc.record({
    axes: fc.array(fc.oneof(anyNumber, fc.constant(null)), { maxLength: 6 }),
    buttons: fc.array(fc.record({ pressed: fc.boolean(), value: anyNumber }), { maxLength: 8 }),
  });
  const readings = fc.array(fc.option(reading), { minLength: 1, maxLength: 5 });
  fc.assert(
    fc.property(anyStored, readings, (stored, readings) => {
      const choices = parseChoices(JSON.stringify(stored));
      expect(choices.keys.estop.length).toBeGreaterThan(0);
      for (const [key, map] of [
        ['raw:b', settingsOf(choices).mapOf('raw:b')] as const,
        ...choices.controllers,
      ]) {
        const all = BUTTON_ROLES.flatMap((role) => map.buttons[role]);
        expect(new Set(all).size).toBe(all.length);
        if (isStandardKey(key)) expect(map.buttons.estop).toContain(STANDARD_STOP);
        const pad = new GamepadInput();
        const input = new ScaledInput(pad, new SpeedChoice(choices.speed));
        for (const [nowMs, state] of readings.entries()) {
          const { estop } = pad.read(state, nowMs, map);
          const isDown = (index: number) => (state?.buttons[index]?.value ?? 0) > 0.5;
          if (input.held) expect(map.buttons.grip.some(isDown) || isPressed(state, map)).toBe(true);
          if (state === null)
            expect([input.held, input.wish, estop]).toEqual([false, { forward: 0, left: 0 }, false]);
          const { linear, angular } = toTwist(input.wish, limits);
          expect(Math.abs(linear.x)).toBeLessThanOrEqual(limits.maxLinear);
          expect(Math.abs(angular.z)).toBeLessThanOrEqual(limits.maxAngular);
        }
      }
    }),
    { seed: 14, numRuns: 1000 },
  );
});
