import { describe, expect, it } from 'vitest';
import { mountOf } from '../../motion/obstacles/guarded-sensors.ts';
import { opticalMount } from '../../sense/sources/sensor-mount.ts';
import { robotOf } from './testing/robot-of.ts';

function options(...argv: string[]) {
  return optionsIn('', ...argv);
}

function optionsIn(yaml: string, ...argv: string[]) {
  const { obstacleGuard, sensors } = robotOf(argv, yaml);
  return { ...obstacleGuard, mount: sensors[0] && mountOf(sensors[0].capture.source) };
}

describe('the options of the obstacle guard', () => {
  it('are those of the simulated robot by default', () => {
    const { mode, footprint, marginM, blankIsMissing } = options();
    expect([blankIsMissing, options('--guard-blank-floor', 'unseen').blankIsMissing]).toEqual([true, false]);
    expect([mode, marginM]).toEqual(['auto', 0.15]);
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
    const place = { x: 0.12, y: 0, z: 0.9, roll: 0, pitch: 0.2, yaw: 0 };
    for (const source of ['shm', 'pcd'])
      expect(
        options('--source', source, '--path', 'a.pcd', '--guard-mount', '0.12,0,0.9,0,0.2,0').mount,
      ).toEqual(opticalMount(place));
    expect(options('--source', 'shm').mount).toBeNull();
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

  const ROS = 'robot:\n  sink: { kind: ros2 }\n  topics: [{ topic: /cmd_vel, as: velocity }]\n';
  const scan = (topic: string, x: number, z = 0.3) => ({
    ...{ topic, mount: { x, y: 0, z, roll: 0, pitch: 0, yaw: 0 } },
  });

  it('take laser scans from a flag and from a file', () => {
    expect(options().topics).toBeNull();
    const { topics, scansShowFloor } = optionsIn(
      ROS,
      ...['--guard-scan', '/scan=0.2,0,0.3,0,0,0 /rear=-0.2,0,0.3,0,0,0', '--ros-domain', '7'],
    );
    expect(topics?.scans).toEqual([scan('/scan', 0.2), scan('/rear', -0.2)]);
    expect(topics?.graph).toMatchObject({ kind: 'ros2', domain: 7 });
    expect([topics?.collision, scansShowFloor]).toEqual([null, false]);
    const file = optionsIn(
      `${ROS}  guard: { scans: [{ topic: /scan, mount: "0.2,0,0.3,0,0,0" }], scanFloor: seen }\n`,
    );
    expect([file.topics?.scans, file.scansShowFloor]).toEqual([[scan('/scan', 0.2)], true]);
  });

  it('compare where scanners sit with the frames that the graph tells', () => {
    const topics =
      '[{ topic: /tf_static, as: tf }, { topic: /odom, as: pose }, { topic: /cmd_vel, as: velocity }]';
    const text = `robot:\n  sink: { kind: ros2 }\n  topics: ${topics}\n  ros: { baseFrame: body }\n`;
    const { frames } = optionsIn(text, '--guard-scan', '/scan=0.2,0,0.3,0,0,0').topics ?? {};
    expect(frames?.topics.map(({ topic }) => topic)).toEqual(['/tf_static', '/odom']);
    expect(frames?.base).toBe('body');
  });

  it('take a collision topic, whose silence stops the robot by default', () => {
    expect(optionsIn(ROS, '--guard-collision-topic', '/safety/stop').topics?.collision).toEqual({
      ...{ topic: '/safety/stop', type: 'bool', silentMs: 500, silentMps: 0 },
    });
    const slow = `${ROS}  stops: { silenceMs: 200 }\n  guard: { unseenMps: 0.2, collision: { topic: /most, type: speed, silent: slow } }\n`;
    expect(optionsIn(slow).topics?.collision).toEqual({
      ...{ topic: '/most', type: 'speed', silentMs: 200, silentMps: 0.2 },
    });
  });

  it('laser scans alone are enough for a guard that must be on', () => {
    const argv = ['--source', 'shm', '--obstacle-guard', 'on', '--guard-scan', '/scan=0.2,0,0.3,0,0,0'];
    expect(optionsIn(ROS, ...argv).mode).toBe('on');
  });

  it.each([
    [['--guard-scan', '/scan'], 'must be "x,y,z,roll,pitch,yaw"'],
    [['--guard-scan', 'scan=0,0,0.3,0,0,0'], 'must be a topic’s full name'],
    [['--guard-scan', '/a=0,0,0.3,0,0,0 /a=1,0,0.3,0,0,0'], 'must name each topic once'],
    [['--guard-scan', '/a=0,0,1.3,0,0,0'], 'it would see nothing'],
    [['--guard-scan', '/a=0,0,0.03,0,0,0'], 'it would see nothing'],
    [['--guard-collision-topic', 'stop'], 'must be a topic’s full name'],
  ])('refuse %s in a ROS graph', (argv, why) => {
    expect(() => optionsIn(ROS, ...argv)).toThrow(why);
  });

  it('refuse topics without a ROS graph', () => {
    expect(() => options('--guard-scan', '/scan=0,0,0.3,0,0,0')).toThrow('needs a ROS graph');
    expect(() => options('--guard-collision-topic', '/stop')).toThrow('needs a ROS graph');
  });
});
