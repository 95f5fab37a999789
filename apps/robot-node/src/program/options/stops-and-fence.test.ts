import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { useFolder } from '@farpoint/service/testing/folder';
import { describe, expect, test } from 'vitest';
import { robotOf } from './testing/robot-of.ts';

const folder = useFolder();

describe('stops at the robot', () => {
  test('are none by default', () => {
    expect(robotOf([]).stops).toEqual({ key: false });
  });

  test('are a line, a file in shared memory, a key, and a topic of the robot’s graph', () => {
    const args = '--stop-gpio gpiochip1:17:active-low --stop-shm stop --shm-folder /x --stop-key'.split(' ');
    expect(robotOf(args).stops).toEqual({
      gpio: { chip: '/dev/gpiochip1', line: 17, activeLow: true },
      shm: { path: '/x/stop', owner: undefined, silentMs: 500 },
      key: true,
    });
    const { stops } = robotOf(
      [],
      `robot:
  sink: { kind: ros2 }
  topics: [{ topic: /cmd_vel, as: velocity }]
  stops: { topic: /safety/stop, silenceMs: 300 }`,
    );
    expect(stops.topic).toMatchObject({ graph: { kind: 'ros2' }, topic: '/safety/stop', silentMs: 300 });
  });

  test.each([
    [['--stop-topic', '/stop'], /needs a ROS graph/],
    [['--stop-topic', 'stop'], /must be a topic’s full name/],
    [['--stop-gpio', 'gpiochip0'], /must be CHIP:LINE/],
    [['--stop-gpio', '/etc/passwd:1'], /must be CHIP:LINE/],
    [['--stop-shm', '../stop'], /must be a file’s name without a folder/],
    [['--stop-silence-ms', '50'], /100/],
  ])('%j: %s', (args, message) => {
    expect(() => robotOf(args)).toThrow(message);
  });
});

describe('a fence', () => {
  const square = [
    [11, 48],
    [11.001, 48],
    [11.001, 48.001],
    [11, 48],
  ];
  const features = [
    {
      ...{ type: 'Feature', properties: { kind: 'allowed' } },
      geometry: { type: 'Polygon', coordinates: [square] },
    },
  ];
  const path = join(folder, 'yard.geojson');
  writeFileSync(path, JSON.stringify({ type: 'FeatureCollection', features }));
  const broken = join(folder, 'broken.geojson');
  writeFileSync(broken, '{}');

  test('is none by default; a radius is enough', () => {
    expect(robotOf([]).fence).toBeUndefined();
    expect(
      robotOf(['--fence-radius-m', '5', '--deceleration-mps2', '3', '--footprint', '0.4']).fence,
    ).toMatchObject({
      ...{ fence: { radiusM: 5, allowed: [] }, fix: null, errorM: 0.1 },
      limits: { brakeMps2: 1.5, reactionMs: 200, radiusM: expect.closeTo(0.65, 2) },
    });
  });

  test('on the earth is placed by the origin, the simulator’s or its own', () => {
    const corner = (args: string[]) => {
      const [area] = robotOf(['--fence', path, ...args]).fence?.fence.allowed ?? [];
      return area?.shape === 'polygon' ? area.rings[0]?.[0] : undefined;
    };
    expect(corner(['--fence-origin', '48,11'])).toEqual([0, 0]);
    expect(corner(['--fence-origin', '47.999,11,90'])).toEqual([expect.closeTo(111.2, 1), expect.closeTo(0)]);
    expect(corner(['--sim-origin', '47.999,11'])).toEqual([0, expect.closeTo(111.2, 1)]);
    const byFix = robotOf(['--fence', path, '--fence-position', 'fix', '--sim-origin', '48,11']).fence;
    expect(byFix?.fix?.topic).toBe('/fix');
  });

  test.each([
    [['--fence', path], /needs the place of the world’s origin/],
    [['--fence', broken], /broken.geojson: type: must be FeatureCollection/],
    [['--fence', join(folder, 'none')], /cannot be read/],
    [['--fence-radius-m', '5', '--fence-origin', '48'], /must be latitude and longitude/],
    [['--fence', path, '--fence-position', 'fix'], /needs a topic with `as: fix`/],
    [['--fence-radius-m', '5', '--fence-position', 'fix'], /needs --fence-origin/],
    [['--fence-radius-m', '5', '--source', 'rgbd', '--path', 'x'], /needs odometry/],
  ])('%j: %s', (args, message) => {
    expect(() => robotOf(args)).toThrow(message);
  });
});
