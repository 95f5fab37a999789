/** The thread that hears the guard's topics, in a ROS 2 graph. */
import { BroadcastChannel } from 'node:worker_threads';
import { DdsGraph, isAvailable } from '@farpoint/dds';
import { testDomain } from '@farpoint/dds/testing';
import { type Twist, zeroTwist } from '@farpoint/protocol';
import { LATCHED_QOS } from '@farpoint/ros';
import { messageBytes } from '@farpoint/ros/testing';
import { Footprint } from '@farpoint/safety';
import { silentLogger } from '@farpoint/service';
import { afterEach, describe, expect, it } from 'vitest';
import { monotonicMs } from '../../ground/clock.ts';
import { guardHealth } from './guard-report.ts';
import { GuardTopics } from './guard-topics.ts';
import { GRID_SHAPE, type ObstacleGuardConfiguration } from './guarded-sensors.ts';
import { ObstacleStation } from './obstacle-station.ts';

const SCAN = 'sensor_msgs/msg/LaserScan';
const FLOAT = 'std_msgs/msg/Float32';
const TF = 'tf2_msgs/msg/TFMessage';
const RAYS = 360;
const ending: (() => unknown)[] = [];
afterEach(async () => {
  for (const end of ending.splice(0).reverse()) await end();
});

function scanOf(range: number) {
  const wallMs = performance.timeOrigin + performance.now();
  return {
    header: {
      stamp: { sec: Math.floor(wallMs / 1000), nanosec: Math.floor((wallMs % 1000) * 1e6) },
      frame_id: 'laser',
    },
    ...{ angle_min: -Math.PI, angle_max: Math.PI, angle_increment: (2 * Math.PI) / RAYS },
    ...{ time_increment: 0, scan_time: 0.05, range_min: 0.1, range_max: 12, intensities: [] },
    ranges: new Array<number>(RAYS).fill(range),
  };
}

function laserAt(z: number) {
  return {
    header: { stamp: { sec: 0, nanosec: 0 }, frame_id: 'base_link' },
    child_frame_id: 'laser',
    transform: { translation: { x: 0, y: 0, z }, rotation: { x: 0, y: 0, z: 0, w: 1 } },
  };
}

const THREAD = new URL('../../testing/ending-guard-worker.ts', import.meta.url);
const BAND = { clearanceM: 0.04, heightM: 1.1 };
const CONFIGURATION: ObstacleGuardConfiguration = {
  ...{ mode: 'auto', footprint: Footprint.disc(0.25).corners },
  brakes: { linear: 2, angular: 3 },
  ...{ ...BAND, dropM: 0.15, marginM: 0.1, unseenMps: 0.3, scansShowFloor: true },
};

function open(): ObstacleStation {
  const mount = { x: 0, y: 0, z: 0.3, roll: 0, pitch: 0, yaw: 0 };
  const topics = new GuardTopics(
    {
      graph: { kind: 'ros2', domain: testDomain(), localhostOnly: true },
      scans: [{ topic: '/scan', mount }],
      collision: { topic: '/most', type: 'speed', silentMs: 500, silentMps: 0 },
      frames: { topics: [{ topic: '/tf_static', type: TF, as: 'tf', most: null }], base: null },
      ...{ ...BAND, shape: GRID_SHAPE, odometry: true, reachM: 0.25 },
    },
    silentLogger(),
    THREAD,
  );
  return new ObstacleStation({ configuration: CONFIGURATION, grids: [], captures: [], topics });
}

const ahead: Twist = { ...zeroTwist(), linear: { x: 1, y: 0, z: 0 } };

function bounds(station: ObstacleStation) {
  return station.guards.map((guard) => guard.bound(ahead, monotonicMs()).reason);
}

describe('the guard’s topics', { skip: !isAvailable(), timeout: 30_000 }, () => {
  it('bound the motion by scans and by what another program demands; a thread that ends is replaced', async () => {
    const graph = new DdsGraph({ domain: testDomain(), localhostOnly: true, now: monotonicMs });
    ending.push(() => graph.close());
    const [scans, demands] = [
      graph.advertise({ topic: '/scan', type: SCAN }),
      graph.advertise({ topic: '/most', type: FLOAT }),
    ];
    let range: number | null = 3;
    let most: number | null = 1;
    const station = open();
    ending.push(() => station.close());
    const publishing = setInterval(() => {
      const newest = { pose: { x: 2, y: 0, yaw: 0 }, twist: zeroTwist(), measuredMs: monotonicMs() };
      station.update({ newest, jumps: { count: 0, lastMs: Number.NEGATIVE_INFINITY } }, true);
      if (range !== null) scans.publish(messageBytes(2, SCAN, scanOf(range)));
      if (most !== null) demands.publish(messageBytes(2, FLOAT, { data: most }));
    }, 50);
    ending.push(() => clearInterval(publishing));
    const until = (reasons: unknown[]) =>
      expect.poll(() => bounds(station), { timeout: 10_000 }).toEqual(reasons);

    expect([station.state(monotonicMs()), bounds(station)]).toEqual([
      'blind',
      ['sensor-silent', 'collision-silent'],
    ]);
    await until([null, null]);
    expect(station.state(monotonicMs())).toBe('on');
    const { ok, detail } = guardHealth(station.report(monotonicMs()));
    expect([ok, detail.collision]).toEqual([true, 'bounded']);
    expect(detail.sensors).toMatchObject([{ name: '/scan', says: 'live' }]);
    range = 0.4;
    await until(['obstacle', null]);
    range = 3;
    most = 0.5;
    await until([null, 'collision-topic']);
    most = null;
    await until([null, 'collision-silent']);
    most = 2;
    await until([null, null]);
    range = null;
    await until(['sensor-silent', null]);
    expect(guardHealth(station.report(monotonicMs())).ok).toBe(false);
    range = 3;
    await until([null, null]);

    // The scanner is configured 0.3 m above base_link.
    const frames = graph.advertise({ topic: '/tf_static', type: TF, qos: LATCHED_QOS });
    frames.publish(messageBytes(2, TF, { transforms: [laserAt(0.3)] }));
    await until([null, null]);
    frames.publish(messageBytes(2, TF, { transforms: [laserAt(0.4)] }));
    await until(['sensor-silent', null]);
    frames.publish(messageBytes(2, TF, { transforms: [laserAt(0.3)] }));
    await until([null, null]);

    const wire = new BroadcastChannel('guard-worker');
    ending.push(() => wire.close());
    for (const [times, fault] of ['throw', 'hang'].entries()) {
      wire.postMessage(fault);
      await until(['sensor-silent', 'collision-silent']);
      await until([null, null]);
      expect(station.report(monotonicMs()).restarts).toBe(times + 1);
    }
    demands.close();
    await until([null, 'collision-silent']);
  });
});
