import type { Pose } from '@farpoint/protocol';
import { officeWorld } from '@farpoint/sim';
import { expect, it } from 'vitest';
import { SimNavigation } from './sim-navigation.ts';

const world = officeWorld();
const at = (x: number, y: number): Pose => ({
  position: { x, y, z: 0 },
  orientation: { x: 0, y: 0, z: 0, w: 1 },
});
const START = at(world.start.x, world.start.y);

it('has neither map nor plan unless asked', () => {
  expect(new SimNavigation(world, { map: false, planTo: null }).readings(START, 0)).toEqual([]);
});

it('plans from where the robot is, and repeats its map', () => {
  const navigation = new SimNavigation(world, { map: true, planTo: { x: 12.2, y: 6 } });
  const [plan, map] = navigation.readings(START, 0);
  expect(plan).toMatchObject({ topic: '/plan', level: 'ok', navigation: { kind: 'path' } });
  expect(map).toMatchObject({ topic: '/map', level: 'ok', navigation: { kind: 'map', map: { cellM: 0.1 } } });
  expect(navigation.readings(START, 1000).map(({ topic }) => topic)).toEqual(['/plan']);
  expect(navigation.readings(START, 5000).map(({ topic }) => topic)).toEqual(['/plan', '/map']);
  if (plan?.navigation?.kind !== 'path') throw new Error('no path');
  const { points } = plan.navigation;
  expect(points[0]).toEqual([world.start.x, world.start.y]);
  const [x, y] = points.at(-1) ?? [0, 0];
  expect(Math.hypot(x - 12.2, y - 6)).toBeLessThan(0.1);
});

it('has no plan to where nobody can go', () => {
  const navigation = new SimNavigation(world, { map: false, planTo: { x: 16, y: 7 } });
  expect(navigation.readings(START, 0)).toMatchObject([{ values: [['', 'none']] }]);
});
