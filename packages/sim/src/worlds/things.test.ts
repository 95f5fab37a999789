import { expect, test } from 'vitest';
import { SimulatedBase } from '../simulated-base.ts';
import { officeWorld } from './office.ts';
import { THING_SIZE, withThings } from './things.ts';

test('a thing stands where it was put, and stops the robot if it is higher than what the robot drives over', () => {
  const world = officeWorld();
  const reached = (height: number) => {
    const base = new SimulatedBase(withThings(world, [{ ahead: 0.9, left: 0, height }]));
    base.setCommand({ linear: { x: 0.5, y: 0, z: 0 }, angular: { x: 0, y: 0, z: 0 } });
    base.step(3);
    return base.state.pose.position.x - world.start.x;
  };
  expect(reached(0.01)).toBeGreaterThan(1);
  expect(reached(0.3)).toBeLessThan(0.9 - THING_SIZE / 2);
  expect(reached(0.3)).toBeGreaterThan(0.3);
});
