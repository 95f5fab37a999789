import { toTwist } from '@farpoint/operator';
import fc from 'fast-check';
import { expect, test } from 'vitest';
import { BUTTON_ROLES, canDrive, STANDARD_MAP, STANDARD_STOP } from './controller-map.ts';
import { GamepadInput } from './gamepad-input.ts';
import {
  choicesText,
  controllerKey,
  DEFAULT_CHOICES,
  type InputChoices,
  isStandardKey,
  mapOf,
  parseChoices,
} from './input-choices.ts';
import { KEY_ROLES, STOP_KEY } from './key-map.ts';
import { ScaledInput, SpeedChoice } from './speed-choice.ts';

const axis = { axis: 2, centre: 1, least: -1, most: 1, inverted: true, deadZone: 0.12 };
const wheel = {
  sticks: [{ forward: axis, back: { ...axis, axis: 1 }, left: { ...axis, axis: 0, centre: 0 } }],
  buttons: { ...STANDARD_MAP.buttons, grip: [10, 11], estop: [20] },
};

test('what is chosen is read back as it was', () => {
  const choices: InputChoices = {
    keys: { ...DEFAULT_CHOICES.keys, release: ['Numpad5'] },
    oneHanded: true,
    controllers: new Map([['raw:wheel', wheel]]),
    speed: 0.5,
  };
  expect(parseChoices(choicesText(choices))).toEqual(choices);
  expect(parseChoices(choicesText(DEFAULT_CHOICES))).toEqual(DEFAULT_CHOICES);
});

test('what cannot be read is replaced by what is usual; a controller that cannot be used is left out', () => {
  for (const text of [null, '', '{', '[]', '{"keys":1}', JSON.stringify({ keys: {}, speed: 1 })])
    expect(parseChoices(text)).toEqual(DEFAULT_CHOICES);
  const stored = { keys: {}, oneHanded: false, speed: 9 };
  const broken = {
    key: 'raw:x',
    ...wheel,
    sticks: [{ ...wheel.sticks[0], left: { ...axis, least: 1, centre: 0 } }],
  };
  const read = parseChoices(
    JSON.stringify({ ...stored, controllers: [broken, { key: 'raw:wheel', ...wheel }, 7] }),
  );
  expect([...read.controllers.keys()]).toEqual(['raw:wheel']);
  expect(read.speed).toBe(1);
});

test('a controller that nobody knows does nothing; one in the standard mapping always stops by B', () => {
  const raw = controllerKey({ id: 'Joystick (Vendor: 1)', mapping: '' });
  expect(canDrive(mapOf(DEFAULT_CHOICES, raw))).toBe(false);
  const standard = controllerKey({ id: 'Pad', mapping: 'standard' });
  expect(mapOf(DEFAULT_CHOICES, standard)).toBe(STANDARD_MAP);
  const stolen = {
    key: standard,
    ...STANDARD_MAP,
    buttons: { ...STANDARD_MAP.buttons, grip: [STANDARD_STOP, 5], estop: [] },
  };
  const stored = { keys: {}, oneHanded: false, speed: 1, controllers: [stolen] };
  const { buttons } = mapOf(parseChoices(JSON.stringify(stored)), standard);
  expect([buttons.estop, buttons.grip]).toEqual([[STANDARD_STOP], [5]]);
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
});
const anyStored = fc.oneof(
  fc.jsonValue(),
  fc.record({
    keys: fc.dictionary(
      fc.constantFrom(...KEY_ROLES),
      fc.array(fc.constantFrom('KeyX', 'KeyW', 'Tab', 'Space')),
    ),
    oneHanded: fc.boolean(),
    controllers: fc.array(anyController, { maxLength: 3 }),
    speed: anyNumber,
  }),
);

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
      expect(choices.keys.estop).toContain(STOP_KEY);
      for (const [key, map] of [['raw:b', mapOf(choices, 'raw:b')] as const, ...choices.controllers]) {
        const all = BUTTON_ROLES.flatMap((role) => map.buttons[role]);
        expect(new Set(all).size).toBe(all.length);
        if (isStandardKey(key)) expect(map.buttons.estop).toContain(STANDARD_STOP);
        const pad = new GamepadInput();
        const input = new ScaledInput(pad, new SpeedChoice(choices.speed));
        for (const [nowMs, state] of readings.entries()) {
          const { estop } = pad.read(state, nowMs, map);
          const isDown = (index: number) => (state?.buttons[index]?.value ?? 0) > 0.5;
          if (input.held) expect(map.buttons.grip.some(isDown)).toBe(true);
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
