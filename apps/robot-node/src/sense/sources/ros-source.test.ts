import type { CaptureRoom, SourceFrame } from '@farpoint/cloud-source';
import { topicTableSchema } from '@farpoint/ros';
import { MemoryGraph } from '@farpoint/ros/testing';
import { describe, expect, it } from 'vitest';
import { RosSource } from './ros-source.ts';

const CLOUD = 'sensor_msgs/msg/PointCloud2';
const IMAGE = 'sensor_msgs/msg/Image';
const INFO = 'sensor_msgs/msg/CameraInfo';
const ODOMETRY = 'nav_msgs/msg/Odometry';
const OPTICAL = 'camera_optical_frame';
const WALL_S = 1_700_000_000;
const wishes = { bitsPerSecond: 0, latencyTest: false };

const headerAt = (ms: number, frame_id = OPTICAL) => {
  const second = Math.floor(ms / 1000);
  const ns = (ms - second * 1000) * 1e6;
  return { stamp: { sec: WALL_S + second, nanosec: ns, nsec: ns }, frame_id, seq: 0 };
};

/** A cloud of x, y, z: a line for a LiDAR, the grid at a depth of 2 m for a camera. */
function cloudOf(ms: number, width: number, height: number, frame = OPTICAL, point = at(2)) {
  const data = new Float32Array(width * height * 3);
  for (let i = 0; i < width * height; i++) data.set(point(i % width, Math.floor(i / width)), i * 3);
  return {
    header: headerAt(ms, frame),
    ...{ width, height, point_step: 12, row_step: width * 12, is_bigendian: false, is_dense: true },
    fields: ['x', 'y', 'z'].map((name, i) => ({ name, offset: i * 4, datatype: 7, count: 1 })),
    data: new Uint8Array(data.buffer),
  };
}
/** The pixel's point at a depth, for the camera below. */
function at(z: number) {
  return (u: number, v: number) => [((u - 4) / 10) * z, ((v - 3) / 10) * z, z];
}
const info = (ms: number, width = 8, height = 6) => ({
  header: headerAt(ms),
  ...{ width, height, distortion_model: '', binning_x: 0, binning_y: 0 },
  ...{ d: [], k: [10, 0, 4, 0, 10, 3, 0, 0, 1], r: new Array(9).fill(0), p: new Array(12).fill(0) },
  ...{ D: [], K: [10, 0, 4, 0, 10, 3, 0, 0, 1], R: new Array(9).fill(0), P: new Array(12).fill(0) },
  roi: { x_offset: 0, y_offset: 0, height: 0, width: 0, do_rectify: false },
});
function imageOf(ms: number, encoding: string, bytes: number, width = 8, height = 6) {
  const data = new Uint8Array(width * height * bytes).fill(4);
  return { header: headerAt(ms), ...{ width, height, encoding, is_bigendian: 0, step: width * bytes, data } };
}
const odometry = (ms: number, x: number) => ({
  header: headerAt(ms, 'odom'),
  child_frame_id: 'base_link',
  pose: {
    pose: { position: { x, y: 0, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } },
    covariance: new Array(36).fill(0),
  },
  twist: {
    twist: { linear: { x: 0.25, y: 0, z: 0 }, angular: { x: 0, y: 0, z: 0 } },
    covariance: new Array(36).fill(0),
  },
});

async function setUp(
  table: unknown,
  first: (graph: MemoryGraph) => void,
  { version = 2, waitMs = 1000, ...more }: { version?: 1 | 2; waitMs?: number; baseFrame?: string } = {},
) {
  let nowMs = 5000;
  const graph = new MemoryGraph(version, () => nowMs);
  const clock = {
    now: () => nowMs,
    wallNs: () => BigInt(WALL_S) * 1_000_000_000n + BigInt(nowMs - 5000) * 1_000_000n,
  };
  const opening = RosSource.open(
    graph,
    { topics: topicTableSchema.parse(table), axes: 'auto', waitMs, ...more },
    clock,
  );
  first(graph);
  const source = await opening;
  const faults: string[] = [];
  const readings: unknown[] = [];
  let ready = 0;
  source.onFault = ({ message }) => faults.push(message);
  source.onReading = (reading) => readings.push(reading);
  source.onReady = () => ready++;
  const { capacity, camera } = source.description;
  const pixels = camera === null ? 0 : capacity;
  const room: CaptureRoom = {
    points: new Float32Array(capacity * 4),
    depth: new Float32Array(pixels),
    colour: new Uint32Array(pixels),
  };
  return {
    ...{ graph, source, faults, readings, room },
    ready: () => ready,
    capture: (): SourceFrame | null => source.capture(nowMs, wishes, room),
    pass: (ms: number) => {
      nowMs += ms;
    },
  };
}

describe('RosSource', () => {
  it.each([1, 2] as const)(
    'gives a LiDAR’s clouds from ROS %i as points, placed by odometry',
    async (version) => {
      const table = [
        { topic: '/points', as: 'cloud' },
        { topic: '/odom', as: 'pose' },
      ];
      const forward = () => [1, 2, 3];
      const first = (graph: MemoryGraph) => graph.say('/points', CLOUD, cloudOf(0, 3, 1, 'lidar', forward));
      const { graph, source, capture, pass, ready, faults } = await setUp(table, first, { version });
      expect(source.description).toMatchObject({
        height: 1,
        camera: null,
        depthMeasure: 'range',
      });
      expect(source.description.kind).toBe(`ros${version} (/points, body frame)`);
      graph.say('/odom', ODOMETRY, odometry(0, 7));
      pass(40);
      const frame = capture();
      expect(frame).toMatchObject({ form: 'points', count: 3, capturedAtMs: 5000 });
      // Body axes (x forward) become optical axes (z forward), 1 m above a body placed by odometry.
      expect(frame?.form === 'points' && [...frame.points.subarray(0, 3)]).toEqual([-2, -3, 1]);
      expect(frame?.cameraPose.position).toEqual({ x: 7, y: 0, z: 1 });
      expect(source.state).toMatchObject({ pose: { position: { x: 7 } }, twist: { linear: { x: 0.25 } } });
      expect(capture()).toBeNull();
      graph.say('/points', CLOUD, cloudOf(100, 4, 1, 'lidar', forward));
      expect(ready()).toBe(1);
      expect(capture()).toMatchObject({ count: 4 });
      expect(faults).toEqual([]);
    },
  );

  it('takes the base’s frame that is configured', async () => {
    const table = [
      { topic: '/points', as: 'cloud' },
      { topic: '/odom', as: 'pose' },
      { topic: '/tf_static', as: 'tf' },
    ];
    const first = (graph: MemoryGraph) =>
      graph.say(
        '/points',
        CLOUD,
        cloudOf(0, 3, 1, 'lidar', () => [1, 2, 3]),
      );
    const { graph, source } = await setUp(table, first, { baseFrame: 'body' });
    graph.say('/odom', ODOMETRY, odometry(0, 7));
    expect(source.state.measuredMs).toBeNull();
    const translation = { x: 0.5, y: 0, z: 0 };
    const rotation = { x: 0, y: 0, z: 0, w: 1 };
    graph.say('/tf_static', 'tf2_msgs/msg/TFMessage', {
      transforms: [
        { header: headerAt(0, 'base_link'), child_frame_id: 'body', transform: { translation, rotation } },
      ],
    });
    expect(source.state).toMatchObject({ pose: { position: { x: 7.5 } }, measuredMs: 5000 });
  });

  it('subscribes only to what the table names', async () => {
    const table = [
      { topic: '/points', as: 'cloud', most: 10 },
      { topic: '/tf_static', as: 'tf' },
      { topic: '/cmd_vel', as: 'velocity' },
    ];
    const { graph } = await setUp(table, (g) => g.say('/points', CLOUD, cloudOf(0, 3, 1)));
    graph.others.push({ topic: '/secret', type: CLOUD, publishers: 1, subscribers: 0 });
    expect(graph.subscribed.map(({ topic }) => topic).sort()).toEqual(['/points', '/tf_static']);
    expect(graph.subscribed.find(({ topic }) => topic === '/tf_static')?.qos?.durability).toBe(
      'transient-local',
    );
    expect(graph.advertised).toEqual([]);
  });

  it('gives a depth camera’s cloud as images if its camera is named', async () => {
    const table = [
      { topic: '/points', as: 'cloud' },
      { topic: '/info', as: 'cameraInfo' },
    ];
    const { source, capture } = await setUp(table, (g) => {
      // No cloud is taken before the camera is known.
      g.say('/points', CLOUD, cloudOf(0, 8, 6));
      g.say('/info', INFO, info(0));
      g.say('/points', CLOUD, cloudOf(30, 8, 6));
    });
    expect(source.description).toMatchObject({
      width: 8,
      height: 6,
      camera: { fx: 10, fy: 10, cx: 4, cy: 3 },
    });
    const frame = capture();
    expect(frame?.form === 'images' && [...frame.depth]).toEqual(Array(48).fill(2));
  });

  it('gives points, and says why, if the grid is not that camera’s', async () => {
    const table = [
      { topic: '/points', as: 'cloud' },
      { topic: '/info', as: 'cameraInfo' },
    ];
    const { source, capture } = await setUp(table, (g) => {
      g.say('/info', INFO, info(0));
      g.say(
        '/points',
        CLOUD,
        cloudOf(0, 8, 6, OPTICAL, (u, v) => [u, v, 1]),
      );
    });
    expect(source.description.camera).toBeNull();
    expect(capture()).toMatchObject({ form: 'points', count: 48 });
  });

  it('pairs depth and colour images of the same instant', async () => {
    const table = [
      { topic: '/depth', as: 'depth' },
      { topic: '/colour', as: 'colour' },
      { topic: '/info', as: 'cameraInfo' },
    ];
    const { graph, source, capture, faults, ready } = await setUp(table, (g) => {
      g.say('/info', INFO, info(0));
      g.say('/depth', IMAGE, imageOf(0, '16UC1', 2));
      g.say('/colour', IMAGE, imageOf(0, 'rgb8', 3));
    });
    expect(source.description).toMatchObject({ width: 8, height: 6, capacity: 48 });
    const frame = capture();
    expect(frame).toMatchObject({ form: 'images', capturedAtMs: 5000 });
    expect(frame?.form === 'images' && frame.depth[0]).toBeCloseTo(1.028);
    expect(frame?.form === 'images' && frame.colour[0]).toBe(0xff04_0404);
    graph.say('/colour', IMAGE, imageOf(33, 'rgb8', 3));
    expect(ready()).toBe(0);
    graph.say('/depth', IMAGE, imageOf(33, '16UC1', 2, 4, 3));
    expect(ready()).toBe(1);
    expect(capture()).toBeNull();
    expect(faults).toEqual([
      '/depth: 4 × 3 pixels, the camera has 8 × 6; use the images that are registered to that camera',
    ]);
  });

  it('goes on after malformed messages, naming topic and byte', async () => {
    const table = [{ topic: '/points', as: 'cloud' }];
    const { graph, capture, faults } = await setUp(table, (g) => g.say('/points', CLOUD, cloudOf(0, 3, 1)));
    capture();
    graph.sayBytes('/points', Uint8Array.of(0, 1, 0, 0, 1, 2, 3));
    const cut = cloudOf(0, 3, 1);
    graph.say('/points', CLOUD, { ...cut, data: cut.data.subarray(0, 20) });
    expect(capture()).toBeNull();
    expect(faults).toHaveLength(2);
    expect(faults[0]).toMatch(/^\/points: /);
    expect(faults[1]).toBe('/points: byte 20: the data ends, 36 bytes expected');
    graph.say('/points', CLOUD, cloudOf(30, 3, 1));
    expect(capture()).toMatchObject({ count: 3 });
  });

  it('reports readings at the rate that the table allows', async () => {
    const table = [
      { topic: '/points', as: 'cloud' },
      { topic: '/temperature', as: 'text', type: 'std_msgs/Float32', most: 2, label: 'Temperature' },
      { topic: '/diagnostics', as: 'diagnostics', most: 2 },
    ];
    const { graph, readings, pass } = await setUp(table, (g) => g.say('/points', CLOUD, cloudOf(0, 3, 1)));
    for (let i = 0; i < 20; i++) {
      graph.say('/temperature', 'std_msgs/msg/Float32', { data: i });
      pass(100);
    }
    expect(readings).toEqual(
      [0, 4, 9, 14, 19].map((i) => ({
        topic: '/temperature',
        label: 'Temperature',
        level: 'ok',
        values: [['', `${i}`]],
      })),
    );
    // Each node sends its own part; the parts are merged.
    const diagnostics = (level: number, name: string) => ({
      header: headerAt(0),
      status: [{ level, name, message: 'm', hardware_id: '', values: [] }],
    });
    graph.say('/diagnostics', 'diagnostic_msgs/msg/DiagnosticArray', diagnostics(0, 'a'));
    graph.say('/diagnostics', 'diagnostic_msgs/msg/DiagnosticArray', diagnostics(1, 'b'));
    pass(1000);
    graph.say('/diagnostics', 'diagnostic_msgs/msg/DiagnosticArray', diagnostics(0, 'c'));
    expect(readings.at(-1)).toMatchObject({
      level: 'warn',
      values: [
        ['b', 'm'],
        ['', '2 of 3 OK'],
      ],
    });
  });

  it.each([1, 2] as const)(
    'tells a description of ROS %i that came before anybody listened, and its joints',
    async (version) => {
      const table = [
        { topic: '/points', as: 'cloud' },
        { topic: '/robot_description', as: 'model' },
        { topic: '/joint_states', as: 'joints' },
      ];
      const states = (name: string[], position: number[]) => ({
        ...{ header: headerAt(0, ''), name, velocity: [], effort: [] },
        position: Float64Array.from(position),
      });
      const JOINTS = 'sensor_msgs/msg/JointState';
      const { graph, source, readings, faults, pass } = await setUp(
        table,
        (g) => {
          g.say('/robot_description', 'std_msgs/msg/String', {
            data: '<robot name="r"><link name="a"/></robot>',
          });
          g.say('/points', CLOUD, cloudOf(0, 3, 1));
        },
        { version },
      );
      source.start();
      expect(readings).toMatchObject([{ topic: '/robot_description', model: { kind: 'model' } }]);
      graph.say('/joint_states', JOINTS, states(['a'], [1]));
      graph.say('/joint_states', JOINTS, states(['b'], [2]));
      pass(50);
      graph.say('/joint_states', JOINTS, states(['a'], [3]));
      expect(readings.slice(1)).toMatchObject([
        { joints: [['a', 1]] },
        {
          joints: [
            ['a', 3],
            ['b', 2],
          ],
        },
      ]);
      expect(faults).toEqual([]);
      source.close();
    },
  );

  describe.each([1, 2] as const)('a navigator of ROS %i', (version) => {
    const table = [
      { topic: '/points', as: 'cloud' },
      { topic: '/odom', as: 'pose' },
      { topic: '/tf', as: 'tf' },
      { topic: '/plan', as: 'path' },
      { topic: '/map', as: 'map' },
    ];
    const at = (x: number, y: number) => ({
      ...{ position: { x, y, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } },
    });
    const grid = (ms: number) => ({
      header: headerAt(ms, 'map'),
      info: { map_load_time: headerAt(0).stamp, resolution: 0.5, width: 2, height: 1, origin: at(-1, -2) },
      data: [0, 100],
    });
    const plan = (ms: number, frame: string) => ({
      header: headerAt(ms, frame),
      poses: [at(0, 0), at(2, 0)].map((pose) => ({ header: headerAt(0, ''), pose })),
    });
    /** Where odometry began on the map. */
    const tf = (ms: number, x: number) => ({
      transforms: [
        {
          ...{ header: headerAt(ms, 'map'), child_frame_id: 'odom' },
          transform: { translation: { x, y: 0, z: 0 }, rotation: { x: 0, y: 0, z: 0, w: 1 } },
        },
      ],
    });
    const TF = 'tf2_msgs/msg/TFMessage';
    const PATH = 'nav_msgs/msg/Path';
    const GRID = 'nav_msgs/msg/OccupancyGrid';

    it('is told in the robot’s world: also a map that came once, before anybody listened and before its frame', async () => {
      const { graph, source, readings, faults, pass } = await setUp(
        table,
        (g) => {
          g.say('/map', GRID, grid(0));
          g.say('/points', CLOUD, cloudOf(0, 3, 1));
        },
        { version },
      );
      source.start();
      expect(readings).toMatchObject([
        { topic: '/map', navigation: { kind: 'refused', reason: 'unknown-frame' } },
      ]);
      graph.say('/odom', ODOMETRY, odometry(0, 1));
      graph.say('/plan', PATH, plan(0, 'odom'));
      expect(readings.at(-1)).toMatchObject({
        navigation: {
          kind: 'path',
          points: [
            [0, 0],
            [2, 0],
          ],
        },
      });
      pass(1000);
      graph.say('/tf', TF, tf(1000, 3));
      expect(readings.at(-1)).toMatchObject({
        ...{ topic: '/map', level: 'ok', values: [['', '1.0 × 0.5 m, cells of 0.5 m']] },
        navigation: {
          kind: 'map',
          map: { width: 2, height: 1, cellM: 0.5, origin: { x: -1, y: -2, yaw: 0 } },
        },
      });
      // From now on, the map's frame is the world's.
      graph.say('/plan', PATH, plan(1000, 'odom'));
      expect(readings.at(-1)).toMatchObject({
        navigation: {
          kind: 'path',
          points: [
            [3, 0],
            [5, 0],
          ],
        },
      });
      expect(source.state.pose.position.x).toBe(4);
      pass(1000);
      graph.say('/plan', PATH, plan(2000, 'elsewhere'));
      expect(readings.at(-1)).toMatchObject({ level: 'warn', navigation: { kind: 'refused', of: 'path' } });
      expect(faults).toEqual([]);
      pass(1000);
      graph.say('/map', GRID, { ...grid(3000), data: [0] });
      expect(faults[0]).toMatch(/^\/map: /);
    });
  });

  describe('a cloud’s stamp', async () => {
    const table = [{ topic: '/points', as: 'cloud' }];
    const begun = async () => {
      const set = await setUp(table, (g) => g.say('/points', CLOUD, cloudOf(0, 3, 1)));
      set.capture();
      const comes = (header: ReturnType<typeof headerAt>) => {
        set.graph.say('/points', CLOUD, { ...cloudOf(0, 3, 1), header });
        return set.capture()?.capturedAtMs ?? null;
      };
      return { ...set, comes };
    };

    it('of another clock is learnt first, then what is later than the earliest is late', async () => {
      const { comes, pass, faults } = await begun();
      const years = -1_600_000_000_000;
      // Until then nobody knows how old it is.
      for (let t = 0; t < 1000; t += 100, pass(100)) expect(comes(headerAt(t + years))).toBe(4000 + t);
      expect(faults).toEqual(['/points: its stamps are of another clock, which is not known yet']);
      expect(comes(headerAt(1000 + years))).toBe(6000);
      pass(600);
      expect(comes(headerAt(1100 + years))).toBe(6100);
    });

    it('that is old is old, and said to be', async () => {
      const { comes, pass, faults } = await begun();
      pass(10_000);
      let nowMs = 10_000;
      for (const lateMs of [450, 700, 900, 2000, 5000, 60_000]) {
        pass(100_000);
        nowMs += 100_000;
        expect(comes(headerAt(nowMs - lateMs))).toBeCloseTo(5000 + nowMs - lateMs, 2);
        expect(faults.length > 0).toBe(lateMs > 1000);
      }
      expect(faults[0]).toMatch('/points: its messages are more than a second old when they come');
    });
  });

  it.each([
    [[], /^no topic is named for clouds/],
    [
      [{ topic: '/points', publishers: 1, type: 'sensor_msgs/msg/LaserScan' }],
      '/points: it has sensor_msgs/msg/LaserScan, not sensor_msgs/msg/PointCloud2',
    ],
    [
      [{ topic: '/cloud', publishers: 1, type: CLOUD }],
      '/points: nobody publishes it (within 0 s); with sensor_msgs/msg/PointCloud2 there is /cloud',
    ],
    [
      [{ topic: '/points', publishers: 1, type: CLOUD }],
      '/points: no message within 0 s, although it is published',
    ],
  ])('says what did not come, and why (%#)', async (others, message) => {
    const topics = message instanceof RegExp ? [] : [{ topic: '/points', as: 'cloud' }];
    const graph = new MemoryGraph(2, () => 0);
    graph.others = others.map((each) => ({ subscribers: 0, ...each }));
    const options = { topics: topicTableSchema.parse(topics), axes: 'auto' as const, waitMs: 0 };
    const opening = RosSource.open(graph, options, { now: () => 0, wallNs: () => 0n });
    await expect(opening).rejects.toThrow(message);
    expect(graph.closed).toBe(true);
  });

  describe.each([1, 2] as const)('pictures of ROS %i', (version) => {
    const table = [
      { topic: '/points', as: 'cloud' },
      { topic: '/front/image_raw', as: 'picture', label: 'Front' },
      { topic: '/rear/compressed', as: 'picture', most: 3 },
    ];
    const first = (graph: MemoryGraph) => graph.say('/points', CLOUD, cloudOf(0, 3, 1));
    const jpeg = Uint8Array.from([0xff, 0xd8, 0xff, 0xc0, 0, 11, 8, 0, 48, 0, 64, 1, 1, 0x11, 0]);
    const compressed = (ms: number, format = 'jpeg') => ({ header: headerAt(ms), format, data: jpeg });
    const COMPRESSED = 'sensor_msgs/msg/CompressedImage';

    it('are subscribed to while somebody watches, and given to whoever wants them', async () => {
      const { source, graph, faults, pass } = await setUp(table, first, { version });
      expect(source.description.cameras).toEqual([
        { name: 'Front', most: null },
        { name: '/rear/compressed', most: 3 },
      ]);
      const taken: unknown[] = [];
      const wanted: [number, number][] = [];
      source.usePictures({
        wants: (camera, nowMs) => wanted.push([camera, nowMs]) !== 2,
        offer: ({ data, ...picture }) => taken.push({ ...picture, bytes: data.length }),
      });
      graph.say('/front/image_raw', IMAGE, imageOf(0, 'rgb8', 3));
      expect(graph.subscribed.map(({ topic }) => topic)).toEqual(['/points']);
      source.watchPictures([5, 5]);
      pass(50);
      graph.say('/front/image_raw', IMAGE, imageOf(20, 'rgb8', 3));
      graph.say('/front/image_raw', IMAGE, imageOf(50, 'rgb8', 3));
      graph.say('/rear/compressed', COMPRESSED, compressed(10));
      expect(taken).toEqual([
        {
          ...{ camera: 0, capturedAtMs: 5020, bytes: 144 },
          facts: { kind: 'raw', width: 8, height: 6, step: 24, encoding: 'rgb8', bigEndian: false },
        },
        {
          ...{ camera: 1, capturedAtMs: 5010, bytes: 15 },
          facts: { kind: 'file', format: 'jpeg', width: 64, height: 48 },
        },
      ]);
      expect(wanted).toEqual([0, 0, 1].map((camera) => [camera, 5050]));
      source.watchPictures([5, 0]);
      graph.say('/rear/compressed', COMPRESSED, compressed(20));
      expect(taken).toHaveLength(2);
      expect(faults).toEqual([]);
    });

    it('that cannot be read are reported as faults with their topic', async () => {
      const { source, graph, faults } = await setUp(table, first, { version });
      const taken: unknown[] = [];
      source.usePictures({ wants: () => true, offer: (picture) => taken.push(picture) });
      source.watchPictures([5, 5]);
      graph.say('/rear/compressed', COMPRESSED, compressed(0, '16UC1; compressedDepth'));
      graph.sayBytes('/front/image_raw', Uint8Array.from([0, 1, 0, 0, 1, 2, 3]));
      expect(taken).toEqual([]);
      expect(faults[0]).toMatch(
        /^\/rear\/compressed: a picture as compressedDepth; name the topic of the raw/,
      );
      expect(faults[1]).toMatch(/^\/front\/image_raw/);
    });
  });
});
