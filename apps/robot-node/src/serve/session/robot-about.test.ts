import { expect, test } from 'vitest';
import { type AboutOptions, robotAbout } from './robot-about.ts';

function configured(kinds: readonly string[], sink: string, base: object | null): AboutOptions {
  const sensors = kinds.map((kind) => ({ capture: { source: { kind } } }));
  return { sensors, sink: { kind: sink }, base } as unknown as AboutOptions;
}

test('a simulated robot drives its own base; what it shows is simulated', () => {
  expect(robotAbout(configured(['sim', 'sim-lidar'], 'base', {}), true)).toEqual({
    type: 'about',
    drives: true,
    shows: 'simulation',
    recorded: true,
  });
});

test('a robot that plays files has nothing to drive, unless velocities go elsewhere', () => {
  for (const kind of ['pcd', 'rgbd', 'recording'])
    expect(robotAbout(configured([kind], 'base', null), false)).toMatchObject({
      drives: false,
      shows: 'files',
      recorded: false,
    });
  expect(robotAbout(configured(['recording'], 'ros', null), false)).toMatchObject({ drives: true });
});

test('one played sensor makes a robot a played one', () => {
  expect(robotAbout(configured(['ros', 'recording'], 'ros', null), false).shows).toBe('files');
  expect(robotAbout(configured(['ros', 'shm'], 'shm', null), false).shows).toBe('sensors');
});
