import { expect, test } from 'vitest';
import { SimulatedBase } from './simulated-base.ts';
import { readSnapshot, snapshotNumbers, writeSnapshot } from './world-snapshot.ts';
import { officeWorld } from './worlds/office.ts';

test('the numbers contain the whole snapshot', () => {
  const base = new SimulatedBase(officeWorld());
  base.setCommand({ linear: { x: 0.5, y: 0, z: 0 }, angular: { x: 0, y: 0, z: 0.3 } });
  base.step(3);
  const { snapshot } = base;
  const numbers = new Float64Array(snapshotNumbers(base.world.movers.length));
  writeSnapshot(snapshot, numbers);
  expect(snapshot.bodies.length).toBeGreaterThan(0);
  expect(readSnapshot(numbers)).toEqual(snapshot);
});
