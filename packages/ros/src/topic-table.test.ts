import { describe, expect, it } from 'vitest';
import { qosOf, ros1TypeOf, topicTableSchema } from './topic-table.ts';

/** `path: message` of each issue. */
function faults(table: unknown): string[] {
  const { error } = topicTableSchema.safeParse(table);
  return error?.issues.map(({ path, message }) => `${path.join('.')}: ${message}`) ?? [];
}

describe('topic table', () => {
  it('knows type and rate of each role, and accepts names of both ROS versions', () => {
    const table = topicTableSchema.parse([
      { topic: '/camera/points', as: 'cloud' },
      { topic: '/bms', type: 'std_msgs/Float32', as: 'text', most: 0.5, label: 'Cells' },
      { topic: '/cmd_vel', type: 'geometry_msgs/TwistStamped', as: 'velocity' },
    ]);
    expect(table).toEqual([
      { topic: '/camera/points', type: 'sensor_msgs/msg/PointCloud2', as: 'cloud', most: null },
      { topic: '/bms', type: 'std_msgs/msg/Float32', as: 'text', most: 0.5, label: 'Cells' },
      { topic: '/cmd_vel', type: 'geometry_msgs/msg/TwistStamped', as: 'velocity', most: null },
    ]);
    expect(table.map(({ type }) => ros1TypeOf(type))).toContain('std_msgs/Float32');
  });

  it('recognises raw and compressed pictures by their names', () => {
    const table = topicTableSchema.parse([
      { topic: '/front/image_raw', as: 'picture', label: 'Front' },
      { topic: '/rear/image_raw/compressed', as: 'picture', most: 2 },
      { topic: '/odd', type: 'sensor_msgs/CompressedImage', as: 'picture' },
    ]);
    expect(table.map(({ type }) => type)).toEqual([
      'sensor_msgs/msg/Image',
      'sensor_msgs/msg/CompressedImage',
      'sensor_msgs/msg/CompressedImage',
    ]);
    const many = Array.from({ length: 9 }, (_, i) => ({ topic: `/camera_${i}`, as: 'picture' }));
    expect(faults(many)).toEqual(['8.as: there can be at most 8 of picture']);
  });

  it('hears a map that was published once, and paths as sensors', () => {
    const [path, map] = topicTableSchema.parse([
      { topic: '/plan', as: 'path' },
      { topic: '/map', as: 'map' },
    ]);
    expect(path).toEqual({ topic: '/plan', type: 'nav_msgs/msg/Path', as: 'path', most: 5 });
    expect(qosOf(path!).reliability).toBe('best-effort');
    expect(qosOf(map!)).toEqual({ reliability: 'reliable', durability: 'transient-local', depth: 1 });
  });

  it('hears a description that was published once, and joints from any number of topics', () => {
    const [model, joints] = topicTableSchema.parse([
      { topic: '/robot_description', as: 'model' },
      { topic: '/joint_states', as: 'joints' },
      { topic: '/arm/joint_states', as: 'joints' },
    ]);
    expect(model).toMatchObject({ type: 'std_msgs/msg/String', most: 1 });
    expect(qosOf(model!)).toEqual({ reliability: 'reliable', durability: 'transient-local', depth: 1 });
    expect(joints).toMatchObject({ type: 'sensor_msgs/msg/JointState', most: 20 });
  });

  const as = (role: string, topic: string, more = {}) => ({ topic, as: role, ...more });
  it.each([
    [
      [as('picture', '/d/compressedDepth')],
      '0.topic: cannot be shown as compressedDepth: name the topic of the raw depth image',
    ],
    [{}, ': must be a list of topics'],
    [['/points'], '0: must be a mapping with topic and as'],
    [[as('cloud', '/a', { rate: 3 })], '0: has unknown keys: rate'],
    [[{ topic: '/a' }], /^0.as: must be one of cloud, depth/],
    [[as('cloud', 'points')], /^0.topic: must be a complete topic name/],
    [[as('cloud', '/camera/*')], /^0.topic: must be a complete topic name/],
    [[as('text', '/a')], '0.type: is needed for as: text'],
    [
      [as('cloud', '/a', { type: 'sensor_msgs/LaserScan' })],
      '0.type: must be sensor_msgs/msg/PointCloud2 for cloud',
    ],
    [[as('fix', '/a', { most: 1e9 })], '0.most: must be at most 1000 messages a second'],
    [
      [as('cloud', '/a', { qos: { reliability: 'maybe' } })],
      '0.qos.reliability: must be reliable or best-effort',
    ],
    [[as('cloud', '/a'), as('cloud', '/b')], '1.as: there can be only one cloud'],
    [[as('fix', '/a'), as('fix', '/a')], '1.topic: /a is listed twice'],
    [[as('map', '/map'), as('map', '/costmap')], '1.as: there can be only one map'],
    [[as('depth', '/d')], '0.as: depth needs an entry cameraInfo'],
    [[as('colour', '/c')], '0.as: colour needs an entry depth'],
  ])('refuses %j, naming the key', (table, fault) => {
    const [first] = faults(table);
    if (typeof fault === 'string') expect(first).toBe(fault);
    else expect(first).toMatch(fault);
  });
});
