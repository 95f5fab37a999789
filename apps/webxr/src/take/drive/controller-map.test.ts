import { expect, test } from 'vitest';
import {
  assignAxis,
  assignButton,
  assignGripAxis,
  type ControllerMap,
  EMPTY_MAP,
  type MapChange,
  missingOf,
  removeButton,
  STANDARD_MAP,
  STANDARD_STOP,
} from './controller-map.ts';

const axis = { axis: 2, centre: 0, least: -1, most: 1, inverted: false, deadZone: 0.1 };

function mapAfter(change: MapChange): ControllerMap {
  if (!('map' in change)) throw new Error(change.reason);
  return change.map;
}

test('a device drives only with a grip and an axis', () => {
  expect(missingOf(STANDARD_MAP)).toBe(null);
  expect(missingOf(EMPTY_MAP)).toBe('grip');
  const steered = mapAfter(assignAxis(EMPTY_MAP, 0, 'left', axis));
  expect(missingOf(steered)).toBe('grip');
  expect(missingOf(mapAfter(assignButton(steered, 'grip', 0)))).toBe(null);
  expect(missingOf(mapAfter(assignButton(EMPTY_MAP, 'grip', 0)))).toBe('axis');
  const pedalled = mapAfter(assignGripAxis(steered, { ...axis, axis: 4 }));
  expect(missingOf(pedalled)).toBe(null);
  // A pedal for driving backward does not make a device that can be driven.
  expect(missingOf(mapAfter(assignAxis(mapAfter(assignButton(EMPTY_MAP, 'grip', 0)), 0, 'back', axis)))).toBe(
    'axis',
  );
});

test('a button has one role, and a role has four buttons at most', () => {
  expect(assignButton(STANDARD_MAP, 'estop', 5)).toEqual({ reason: 'taken', by: 'grip' });
  expect(assignButton(STANDARD_MAP, 'grip', 8)).toEqual({ reason: 'full' });
  expect(mapAfter(assignButton(STANDARD_MAP, 'estop', 8)).buttons.estop).toEqual([STANDARD_STOP, 8]);
  expect(mapAfter(removeButton(STANDARD_MAP, 'grip', 5, true)).buttons.grip).toEqual([4, 6, 7]);
});

test('B of a standard gamepad keeps stopping; of another device every button is free', () => {
  expect(removeButton(STANDARD_MAP, 'estop', STANDARD_STOP, true)).toEqual({ reason: 'keeps-stop' });
  expect(mapAfter(removeButton(STANDARD_MAP, 'estop', STANDARD_STOP, false)).buttons.estop).toEqual([]);
});

test('an axis that drives is no grip, and the grip does not drive', () => {
  const driven = mapAfter(assignAxis(EMPTY_MAP, 0, 'forward', axis));
  expect(assignGripAxis(driven, axis)).toEqual({ reason: 'taken', by: 'forward' });
  expect(assignAxis(driven, 0, 'left', axis)).toEqual({ reason: 'taken', by: 'forward' });
  const held = mapAfter(assignGripAxis(EMPTY_MAP, axis));
  expect(assignAxis(held, 0, 'left', axis)).toEqual({ reason: 'taken', by: 'grip' });
  expect(mapAfter(assignGripAxis(held, null)).gripAxis).toBe(null);
  // It may be set anew.
  expect(
    mapAfter(assignAxis(driven, 0, 'forward', { ...axis, inverted: true })).sticks[0]?.forward?.inverted,
  ).toBe(true);
});
