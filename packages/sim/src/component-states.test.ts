import { expect, test } from 'vitest';
import { componentStates } from './component-states.ts';
import { SimulatedBase } from './simulated-base.ts';
import { officeWorld } from './worlds/office.ts';

const levels = (base: SimulatedBase) =>
  Object.fromEntries(componentStates(base.state).map(({ name, level }) => [name, level]));

test('a robot with a full battery is well', () => {
  expect(levels(new SimulatedBase(officeWorld()))).toEqual({
    ...{ Battery: 0, 'Left motor': 0, 'Right motor': 0, Bumper: 0 },
  });
});

test('a low battery is a warning, an almost empty one an error', () => {
  expect(levels(new SimulatedBase(officeWorld(), {}, 0.15)).Battery).toBe(1);
  expect(levels(new SimulatedBase(officeWorld(), {}, 0.05)).Battery).toBe(2);
  expect(() => new SimulatedBase(officeWorld(), {}, 1.5)).toThrow('not between 0 and 1');
});

test('the bumper reports contact', () => {
  const base = new SimulatedBase(officeWorld());
  base.setCommand({ linear: { x: 1, y: 0, z: 0 }, angular: { x: 0, y: 0, z: 0 } });
  for (let i = 0; i < 600 && levels(base).Bumper === 0; i++) base.step(0.1);
  expect(levels(base).Bumper).toBe(1);
});
