import { compose, type Pose } from '@farpoint/protocol';
import { describe, expect, test } from 'vitest';
import { type StampTimes, WorldState } from './world-state.ts';

const ODOM = { name: '/odom', type: 'nav_msgs/msg/Odometry' };
const POSE = { name: '/pose', type: 'geometry_msgs/msg/PoseStamped' };
const TF = { name: '/tf', type: 'tf2_msgs/msg/TFMessage' };
const STATIC = { name: '/tf_static', type: 'tf2_msgs/msg/TFMessage' };
const NO_TURN = { x: 0, y: 0, z: 0, w: 1 };
const OPTICAL = { x: -0.5, y: 0.5, z: -0.5, w: 0.5 };

const header = (ms: number, frame_id: string) => ({
  stamp: { sec: Math.floor(ms / 1000), nanosec: (ms % 1000) * 1e6 },
  frame_id,
});
const odometry = (ms: number, x: number, { parent = 'odom', child = 'base_link' } = {}) => ({
  header: header(ms, parent),
  child_frame_id: child,
  pose: { pose: { position: { x, y: 0, z: 0 }, orientation: NO_TURN } },
  twist: { twist: { linear: { x: 0.5, y: 0, z: 0 }, angular: { x: 0, y: 0, z: 0 } } },
});
/** At 2 m, at 1000 ms. */
const posed = (frame: string) => ({
  header: header(1000, frame),
  pose: { position: { x: 2, y: 0, z: 0 }, orientation: NO_TURN },
});
const transform = (ms: number, parent: string, child: string, x: number, rotation = NO_TURN) => ({
  header: header(ms, parent),
  child_frame_id: child,
  transform: { translation: { x, y: 0, z: 0 }, rotation },
});
const tf = (...transforms: ReturnType<typeof transform>[]) => ({ transforms });

describe('pose, velocity and time', () => {
  test('come from one message', () => {
    const world = new WorldState();
    expect(world.base).toMatchObject({ pose: { position: { x: 0 } }, twist: null, timeMs: null });
    world.take(ODOM, odometry(1000, 1));
    expect(world.base).toMatchObject({
      pose: { position: { x: 1 } },
      twist: { linear: { x: 0.5 } },
      timeMs: 1000,
    });
  });

  test('of tf that stops are not renewed by the wheels, nor by another joint', () => {
    const world = new WorldState();
    world.take(ODOM, odometry(1000, 1));
    world.take(TF, tf(transform(1000, 'odom', 'base_link', 1.1)));
    for (let ms = 1100; ms <= 5000; ms += 100) {
      world.take(ODOM, odometry(ms, ms / 1000));
      world.take(TF, tf(transform(ms, 'base_link', 'arm', 0.2)));
    }
    expect(world.base).toMatchObject({ pose: { position: { x: 1.1 } }, twist: null, timeMs: 1000 });
  });

  test('of a pose alone have no velocity, which is not zero', () => {
    const world = new WorldState();
    world.take(POSE, posed('map'));
    expect(world.base).toMatchObject({ pose: { position: { x: 2 } }, twist: null, timeMs: 1000 });
  });
});

test('a velocity that is none does not cost the pose, nor a pose that is none what came before', () => {
  const world = new WorldState();
  const message = odometry(1000, 1);
  message.twist.twist.linear.y = Number.NaN;
  expect(world.take(ODOM, message)).toBeNull();
  expect(world.base).toMatchObject({ pose: { position: { x: 1 } }, twist: null, timeMs: 1000 });
  expect(world.take(ODOM, odometry(1100, Number.NaN))).toBe('the transform of base_link is none');
  expect(world.base).toMatchObject({ pose: { position: { x: 1 } }, timeMs: 1000 });
});

describe('a transform of tf that is left out leaves odometry’s', () => {
  const none = { x: 0, y: 0, z: 0, w: 0 };
  test.each<[string, ReturnType<typeof transform>, string]>([
    ['whose position is none', transform(1100, 'odom', 'base_link', Number.NaN), 'is none'],
    ['whose rotation is none', transform(1100, 'odom', 'base_link', 9, none), 'is none'],
    [
      'whose rotation is no number',
      transform(1100, 'odom', 'base_link', 9, { ...none, w: Number.NaN }),
      'is none',
    ],
    ['that makes a loop', transform(1100, 'lidar', 'base_link', 9), 'cannot be above itself'],
    ['whose stamp is refused', transform(9999, 'odom', 'base_link', 9), 'ahead'],
  ])('%s', (_, invalid, why) => {
    const times: StampTimes = { of: (__, ns) => (ns > 9_000_000_000n ? 'ahead' : Number(ns) / 1e6) };
    const world = new WorldState(times);
    world.take(STATIC, tf(transform(0, 'base_link', 'lidar', 0.2)));
    world.take(ODOM, odometry(1000, 1));
    expect(world.take(TF, tf(invalid))).toContain(why);
    expect(world.base).toMatchObject({ pose: { position: { x: 1 } }, timeMs: 1000 });
    // Nor has tf taken over what odometry says.
    world.take(ODOM, odometry(1200, 2));
    expect(world.base).toMatchObject({ pose: { position: { x: 2 } }, timeMs: 1200 });
    world.take(TF, tf(transform(1300, 'odom', 'base_link', 3)));
    world.take(ODOM, odometry(1400, 4));
    expect(world.base).toMatchObject({ pose: { position: { x: 3 } }, timeMs: 1300 });
  });
});

test('a battery that tells its charge in percent is read as percent, and that is said once', () => {
  const world = new WorldState();
  const battery = { name: '/battery', type: 'sensor_msgs/msg/BatteryState' };
  const charge = (percentage: number) => world.take(battery, { voltage: 24.5, percentage });
  expect(charge(85)).toMatch('the battery tells its charge from 0 to 100');
  expect([world.battery, charge(80)]).toEqual([{ voltage: 24.5, percentage: 0.85 }, null]);
});

describe('odometry whose frames', () => {
  test('are empty is that of base_link in odom', () => {
    const world = new WorldState();
    expect(world.take(ODOM, odometry(1000, 1, { parent: '', child: '' }))).toBeNull();
    world.take(ODOM, odometry(1100, 2, { parent: '', child: '' }));
    expect(world.base).toMatchObject({ pose: { position: { x: 2 } }, timeMs: 1100 });
  });

  test('are the same says nothing', () => {
    const world = new WorldState();
    expect(world.take(ODOM, odometry(1000, 1, { child: 'odom' }))).toMatch(
      'its child_frame_id is its frame_id',
    );
    expect(world.base.timeMs).toBeNull();
    expect(world.take(POSE, posed('base_link'))).toMatch('its frame_id is base_link');
  });
});

test('what of a message cannot be taken is left out, and the rest is taken', () => {
  const world = new WorldState();
  const none = { x: 0, y: 0, z: 0, w: 0 };
  const why = world.take(
    TF,
    tf(transform(1000, 'wrist', 'grip', 1, none), transform(1000, 'odom', 'base_link', 3)),
  );
  expect(why).toBe('the transform of grip is none');
  expect(world.base).toMatchObject({ pose: { position: { x: 3 } }, timeMs: 1000 });
  expect(world.take(TF, tf(transform(1100, 'base_link', 'odom', 0)))).toMatch('odom cannot be above itself');
});

test('refused stamps change nothing, and localisation may be ahead', () => {
  const asked: [string, boolean][] = [];
  const times: StampTimes = {
    of: (source, ns, mayBeAhead) => {
      asked.push([source, mayBeAhead]);
      return ns > 2_000_000_000n ? 'its stamps are ahead' : Number(ns) / 1e6;
    },
  };
  const world = new WorldState(times);
  world.take(ODOM, odometry(1000, 1));
  expect(world.take(ODOM, odometry(86_400_000, 9))).toBe('its stamps are ahead');
  world.take(ODOM, odometry(1100, 2));
  expect(world.base).toMatchObject({ pose: { position: { x: 2 } }, timeMs: 1100 });
  expect(world.take(TF, tf(transform(9000, 'base_link', 'arm', 1)))).toBe(
    'the transform of arm: its stamps are ahead',
  );
  world.take(TF, tf(transform(1000, 'map', 'odom', 1)));
  world.take(STATIC, tf(transform(9000, 'base_link', 'lidar', 1)));
  expect(asked.slice(-2)).toEqual([
    ['tf arm', false],
    ['tf odom', true],
  ]);
});

describe('a sensor', () => {
  const mount: Pose = { position: { x: 0.3, y: 0, z: 0.5 }, orientation: OPTICAL };
  const moved = () => {
    const world = new WorldState();
    world.take(ODOM, odometry(1000, 7));
    return world;
  };

  test('is placed by tf, which also says its mount', () => {
    const world = moved();
    world.take(STATIC, tf(transform(0, 'base_link', 'lidar', 0.2)));
    const { cameraPose, base, mount: told } = world.place('lidar', 1000, 'body', mount);
    expect([cameraPose.position.x, base?.position.x, told?.position.x]).toEqual([
      7.2,
      7,
      expect.closeTo(0.2),
    ]);
    expect(told?.orientation).toEqual(OPTICAL);
  });

  test('that tf does not know is where it is configured', () => {
    const { cameraPose, base, mount: told } = moved().place('lidar', 1000, 'body', mount);
    expect(cameraPose).toEqual(compose(base as Pose, mount));
    expect([base?.position.x, told]).toEqual([7, null]);
  });

  test('whose tree is another than the robot’s is not placed by it', () => {
    const world = moved();
    world.take(STATIC, tf(transform(0, 'elsewhere', 'lidar', 100)));
    const { cameraPose, base, mount: told } = world.place('lidar', 1000, 'body', mount);
    expect([cameraPose.position.x, base?.position.x, told]).toEqual([7.3, 7, null]);
  });

  test('of a robot that nobody places has no base, but its mount', () => {
    const world = new WorldState();
    world.take(STATIC, tf(transform(0, 'base_link', 'lidar', 0.2)));
    const { cameraPose, base, mount: told } = world.place('lidar', 1000, 'body', null);
    expect([cameraPose.position.x, base, told?.position.x]).toEqual([0.2, null, 0.2]);
  });

  test('is not placed by poses that are too old for its cloud, or too young', () => {
    const world = moved();
    const placed = [600, 800, 1250, 1350].map((ms) => world.place('lidar', ms, 'body', mount).base !== null);
    expect(placed).toEqual([false, true, true, false]);
  });
});

describe('the base’s frame', () => {
  const x = (world: WorldState) => world.base.pose.position.x;
  /** Another robot's tf, with the usual name. */
  const another = tf(transform(1000, 'other_odom', 'base_link', 99));

  test.each(['robot1/base_link', 'body', '/robot1/base_link'])(
    'is the one that odometry positions: %s',
    (child) => {
      const world = new WorldState();
      world.take(TF, another);
      world.take(ODOM, odometry(1000, 1, { parent: 'robot1/odom', child }));
      expect(world.base).toMatchObject({ pose: { position: { x: 1 } }, timeMs: 1000 });
      world.take(TF, tf(transform(1100, 'other_odom', 'base_link', 98)));
      world.take(ODOM, odometry(1100, 2, { parent: 'robot1/odom', child }));
      expect(world.base).toMatchObject({ pose: { position: { x: 2 } }, timeMs: 1100 });
    },
  );

  test.each(['base_link', 'base_footprint'])(
    'is %s where that is in the tree of what odometry positions',
    (name) => {
      const world = new WorldState();
      world.take(STATIC, tf(transform(0, 'tracker', name, -0.3)));
      world.take(ODOM, odometry(1000, 1, { child: 'tracker' }));
      expect(x(world)).toBeCloseTo(0.7);
    },
  );

  test('is the usual one without odometry', () => {
    const world = new WorldState();
    world.take(TF, tf(transform(1000, 'odom', 'base_footprint', 3)));
    expect(x(world)).toBe(3);
    world.take(TF, tf(transform(1000, 'base_footprint', 'base_link', 1)));
    expect(x(world)).toBe(4);
  });

  test('places a sensor on it', () => {
    const world = new WorldState();
    world.take(TF, another);
    world.take(STATIC, tf(transform(0, 'robot1/base_link', 'robot1/lidar', 0.2)));
    world.take(ODOM, odometry(1000, 7, { parent: 'robot1/odom', child: 'robot1/base_link' }));
    const { cameraPose, base, mount } = world.place('robot1/lidar', 1000, 'body');
    expect([cameraPose.position.x, base?.position.x, mount?.position.x]).toEqual([
      7.2,
      7,
      expect.closeTo(0.2),
    ]);
  });

  test('is the configured one, whatever else there is', () => {
    for (const name of ['robot1/body', '/robot1/body']) {
      const world = new WorldState(undefined, name);
      world.take(ODOM, odometry(1000, 1));
      expect(world.base.timeMs).toBeNull();
      expect(world.place('lidar', 1000, 'body').base).toBeNull();
      world.take(TF, tf(transform(1000, 'odom', 'robot1/body', 5)));
      expect(world.base).toMatchObject({ pose: { position: { x: 5 } }, timeMs: 1000 });
      world.take(STATIC, tf(transform(0, 'robot1/body', 'lidar', 0.5)));
      expect(world.place('lidar', 1000, 'body').mount?.position.x).toBeCloseTo(0.5);
    }
  });

  test('is the configured one where a message does not name it', () => {
    const world = new WorldState(undefined, 'body');
    world.take(ODOM, odometry(1000, 1, { parent: '', child: '' }));
    expect(x(world)).toBe(1);
    const told = new WorldState(undefined, 'body');
    told.take(POSE, posed('map'));
    expect(x(told)).toBe(2);
  });
});
