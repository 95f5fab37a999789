import { expect, test } from 'vitest';
import { type ControllerMap, EMPTY_MAP } from './controller-map.ts';
import { GamepadInput } from './gamepad-input.ts';

const axis = { axis: 0, centre: 0, least: -1, most: 1, inverted: false, deadZone: 0.1 };
/** A wheel: axis 0 steers, axis 1 is the throttle, axis 2 the brake, axis 3 the pedal that is the grip. Pedals rest at 1. */
const pedal = (index: number) => ({ ...axis, axis: index, centre: 1, inverted: true });
const wheel = {
  ...EMPTY_MAP,
  sticks: [{ forward: pedal(1), back: pedal(2), left: { ...axis, inverted: true } }],
  gripAxis: pedal(3),
};

function readAxes(input: GamepadInput, ...axes: number[]) {
  input.read({ axes, buttons: [] }, 0, wheel);
  return input;
}

test('a wheel with pedals: the throttle drives forward, the other pedal backward, the wheel turns', () => {
  const input = readAxes(new GamepadInput(), 0, 1, 1, 1);
  readAxes(input, 0, -1, 1, -1);
  expect(input.held).toBe(true);
  expect(input.wish).toEqual({ forward: 1, left: 0 });
  expect(readAxes(input, -1, 1, -1, -1).wish).toEqual({ forward: -1, left: 1 });
});

test('what drives backward alone does nothing to the other side', () => {
  const map = { ...wheel, sticks: [{ forward: null, back: axis, left: null }] };
  const input = new GamepadInput();
  const ahead = (x: number) => {
    input.read({ axes: [x, 0, 0, 1], buttons: [] }, 0, map);
    return input.wish.forward;
  };
  expect([1, -1].map(ahead)).toEqual([-1, 0]);
});

test('pedals that nobody has touched yet, of which the browser says 0, neither drive nor are a grip', () => {
  const input = readAxes(new GamepadInput(), 0, 0, 0, 0);
  expect([input.held, input.wish.forward]).toEqual([false, 0]);
  expect([readAxes(input, 0, -1, 0, -1).held, input.wish.forward]).toEqual([false, 0]);
  readAxes(input, 0, 1, 1, 1);
  expect([readAxes(input, 0, -1, 1, -1).held, input.wish.forward]).toEqual([true, 1]);
});

test('a pedal is the grip from half of its way on, and until a third of it', () => {
  const input = readAxes(new GamepadInput(), 0, 1, 1, 1);
  const held = (share: number) => readAxes(input, 0, 1, 1, 1 - 2 * share).held;
  expect([0.4, 0.49, 0.51, 0.4, 0.36, 0.34, 0.4, 0.51].map(held)).toEqual([
    ...[false, false, true, true, true, false, false, true],
  ]);
});

test('after a release the pedal must be let go of first', () => {
  const input = readAxes(new GamepadInput(), 0, 1, 1, 1);
  expect(readAxes(input, 0, 1, 1, -1).held).toBe(true);
  input.release();
  expect(readAxes(input, 0, 1, 1, -1).held).toBe(false);
  readAxes(input, 0, 1, 1, 1);
  expect(readAxes(input, 0, 1, 1, -1).held).toBe(true);
});

test('sideways counts beside whichever stick drives, and only where an axis has been taught it', () => {
  const stick = { axis: 0, centre: 0, least: -1, most: 1, inverted: true, deadZone: 0.1 };
  const map: ControllerMap = {
    ...wheel,
    sticks: [
      { forward: { ...stick, axis: 1 }, back: null, left: stick },
      { forward: null, back: null, left: null, sideways: { ...stick, axis: 2 } },
    ],
  };
  const input = new GamepadInput();
  const read = (...axes: number[]) => {
    input.read({ axes, buttons: [] }, 0, map);
    return input.wish;
  };
  expect(read(0, -1, 1)).toEqual({ forward: 1, left: 0, sideways: -1 });
  expect(read(0, -1, 0)).toEqual({ forward: 1, left: 0 });
  expect(read(-1, 0, -1)).toEqual({ forward: 0, left: 1, sideways: 1 });
  input.release();
  expect(input.wish).toEqual({ forward: 0, left: 0 });
});
