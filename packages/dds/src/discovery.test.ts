import { RELIABLE_QOS, SENSOR_QOS } from '@farpoint/ros';
import { describe, expect, it } from 'vitest';
import {
  type OtherEndpoint,
  publisherFaults,
  readOthers,
  subscriptionFaults,
  topicsOf,
  typesOn,
} from './discovery.ts';

const POINTS = 'sensor_msgs/msg/PointCloud2';
const other = (type = POINTS, reliable = true, transientLocal = false): OtherEndpoint => ({
  topic: '/points',
  ...{ type, reliable, transientLocal },
});
const own = (qos = SENSOR_QOS) => ({ topic: '/points', type: POINTS, qos });

describe('discovery data', () => {
  it('is converted to ROS terms, without anything but ROS topics', () => {
    const values = [
      ...['rt/points', 'sensor_msgs::msg::dds_::PointCloud2_', true, false],
      ...['rq/get_mapRequest', 'nav_msgs::srv::dds_::GetMap_Request_', true, false],
      ...['rt/strange', 'Strange', false, true],
    ];
    expect(readOthers(values)).toEqual([
      other(),
      { topic: '/strange', type: 'Strange', reliable: false, transientLocal: true },
    ]);
  });

  it('has the types of a service’s requests', () => {
    const values = [
      ...['rq/aRequest', 'Other', true, false],
      ...['rq/a', 'rq/aRequest', true, false],
      ...['rq/aRequest', 'Third', false, true],
    ];
    expect(typesOn(values, 'rq/aRequest')).toEqual(['Other', 'Third']);
    expect(typesOn(values, 'rq/b')).toEqual([]);
  });

  it('is counted by topic and type', () => {
    expect(topicsOf([other(), other(), other('a/msg/B')], [other()])).toEqual([
      { topic: '/points', type: POINTS, publishers: 2, subscribers: 1 },
      { topic: '/points', type: 'a/msg/B', publishers: 1, subscribers: 0 },
    ]);
  });
});

describe('mismatches', () => {
  it('are a different type under the same name, on either side', () => {
    for (const fault of [
      ...subscriptionFaults(own(), [other('a/msg/B')]),
      ...publisherFaults(own(), [other('a/msg/B')]),
    ]) {
      expect(fault).toMatchObject({ code: 'wrong-type', topic: '/points' });
      expect(fault.message).toContain('a/msg/B');
      expect(fault.message).toContain(POINTS);
    }
    expect(subscriptionFaults(own(), [{ ...other('a/msg/B'), topic: '/others' }])).toEqual([]);
  });

  it.each([
    // asked, offered reliable, offered transient-local, faults
    [SENSOR_QOS, false, false, 0],
    [SENSOR_QOS, true, true, 0],
    [RELIABLE_QOS, true, false, 0],
    [RELIABLE_QOS, false, false, 1],
    [{ ...RELIABLE_QOS, durability: 'transient-local' }, true, true, 0],
    [{ ...RELIABLE_QOS, durability: 'transient-local' }, false, false, 2],
  ] as const)(
    'are a subscription %j to a publisher reliable: %s, latched: %s',
    (asked, reliable, latched, faults) => {
      const found = subscriptionFaults(own(asked), [other(POINTS, reliable, latched)]);
      expect(found.map(({ code }) => code)).toEqual(Array(faults).fill('refused'));
    },
  );

  it('are a subscriber that requests more than we offer', () => {
    expect(publisherFaults(own(SENSOR_QOS), [other(POINTS, true)])).toHaveLength(1);
    expect(publisherFaults(own(RELIABLE_QOS), [other(POINTS, false)])).toEqual([]);
  });
});
