import { resolveOptions } from '@farpoint/service';
import { describe, expect, it } from 'vitest';
import { toRobotOptions } from './robot-options.ts';
import { robotProgram } from './robot-program.ts';

function options(...argv: string[]) {
  const resolved = resolveOptions(robotProgram, { argv, env: {}, readFile: () => '' });
  if (resolved.action !== 'run') throw new Error(resolved.action);
  return toRobotOptions(resolved.values, resolved.where).obstacleGuard;
}

describe('the options of the obstacle guard', () => {
  it('are those of the simulated robot by default', () => {
    const { mode, footprint, mount, marginM } = options();
    expect([mode, mount, marginM]).toEqual(['auto', null, 0.15]);
    expect(footprint.length).toBe(24);
  });

  it('take a radius or a polygon, and where the sensor sits', () => {
    const shape = '0.4,0.3 -0.2,0.3 -0.2,-0.3 0.4,-0.3';
    expect(options('--footprint', shape).footprint).toEqual([
      { x: 0.4, y: 0.3 },
      { x: -0.2, y: 0.3 },
      { x: -0.2, y: -0.3 },
      { x: 0.4, y: -0.3 },
    ]);
    expect(Math.hypot(...Object.values(options('--footprint', '0.4').footprint[0]!))).toBeCloseTo(0.4, 1);
    expect(options('--guard-mount', '0.12,0,0.9,0,0.2,0').mount).toEqual({
      ...{ x: 0.12, y: 0, z: 0.9, roll: 0, pitch: 0.2, yaw: 0 },
    });
  });

  it.each([
    [['--footprint', '7'], 'must be a radius'],
    [['--footprint', '0,0 1,0'], 'must be a radius'],
    [['--footprint', '1,1 2,1 2,2 1,2'], 'must lie around base_link'],
    [['--footprint', '1,1 -1,1 0,0 -1,-1 1,-1'], 'is not convex'],
    [['--guard-mount', '0.1,0,0.9'], 'must be "x,y,z,roll,pitch,yaw"'],
    [['--guard-mount', '0.1,0,0.9,0,90,0'], 'up to 10 m and π rad'],
    [['--guard-height-m', '0.1', '--guard-clearance-m', '0.2'], 'must be above guard.clearanceM'],
    [['--source', 'shm', '--obstacle-guard', 'on'], 'must know where the sensor sits'],
  ])('refuse %s', (argv, why) => {
    expect(() => options(...argv)).toThrow(why);
  });
});
