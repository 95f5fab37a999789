/** Tests the graph with a real master and real rospy nodes. */
import { once } from 'node:events';
import { connect } from 'node:net';
import type { Twist } from '@farpoint/protocol';
import { eventually } from '@farpoint/service/testing/eventually';
import { RosFollowerClient, RosMasterClient, RosNode } from '@foxglove/ros1';
import fc from 'fast-check';
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, it } from 'vitest';
import type { RosFault } from '../fault.ts';
import type { RosGraph } from '../graph.ts';
import { colourOf } from '../image.ts';
import { decoderOf } from '../message-decoder.ts';
import { imageSchema, pointCloud2Schema } from '../messages.ts';
import { PointCloud2Decoder } from '../point-cloud2.ts';
import { Ros1Peers } from '../testing/ros1-peers.ts';
import { velocityWriter } from '../velocity.ts';
import { openRos1Graph } from './graph.ts';

const { python, missing } = Ros1Peers.find();
const CLOUD = 'sensor_msgs/msg/PointCloud2';
const TWIST = 'geometry_msgs/msg/Twist';
const ahead: Twist = { linear: { x: 0.5, y: 0, z: 0 }, angular: { x: 0, y: 0, z: -0.25 } };
const now = () => performance.now();

describe.skipIf(python === null)(`ROS 1 graph (${missing ?? 'roscore, rospy'})`, { timeout: 60_000 }, () => {
  let peers: Ros1Peers;
  let graph: RosGraph;
  const faults: RosFault[] = [];
  beforeAll(async () => {
    peers = await Ros1Peers.open(python ?? '');
    await peers.startCore();
  }, 60_000);
  afterAll(() => peers.close(), 30_000);

  async function open(name = 'farpoint_test'): Promise<RosGraph> {
    const opened = await openRos1Graph({ masterUrl: peers.masterUrl, name, hostname: '127.0.0.1' }, now);
    opened.onFault = (fault) => faults.push(fault);
    return opened;
  }
  beforeEach(async () => {
    faults.length = 0;
    graph = await open();
  });
  afterEach(() => graph.close());

  /** Counts messages without decoding them. */
  function counted(topic = '/points', type = CLOUD) {
    const counter = {
      count: 0,
      subscription: graph.subscribe({ topic, type, queue: 1 }, () => counter.count++),
    };
    return counter;
  }

  it('receives 230,400 points at 10 Hz and pictures from a rospy node', async () => {
    const node = await peers.startNode('cloud,image', 'camera');
    let points = 0;
    let pixel = 0;
    const [decodeCloud, decodeImage] = [CLOUD, 'sensor_msgs/msg/Image'].map((type) =>
      decoderOf(1, type, null),
    ) as [(bytes: Uint8Array) => unknown, (bytes: Uint8Array) => unknown];
    const into = new Float32Array(480 * 480 * 4);
    const times: number[] = [];
    graph.subscribe({ topic: '/points', type: CLOUD, queue: 1 }, (bytes, receivedMs) => {
      points = new PointCloud2Decoder().decode(pointCloud2Schema.parse(decodeCloud(bytes)), 'optical', into);
      times.push(receivedMs);
    });
    graph.subscribe({ topic: '/image', type: 'sensor_msgs/msg/Image', queue: 1 }, (bytes) => {
      const colour = new Uint32Array(640 * 480);
      colourOf(imageSchema.parse(decodeImage(bytes)), colour);
      pixel = colour[1000] as number;
    });
    await eventually(() => times.length >= 21 && pixel !== 0);
    expect(points).toBe(230_400);
    expect(into[2]).toBe(2);
    expect(new Uint32Array(into.buffer)[3]).toBe(0xff00_80ff);
    expect(pixel).toBe(0xff0a_141e);
    const seconds = ((times.at(20) ?? 0) - (times[0] ?? 0)) / 1000;
    expect(20 / seconds).toBeGreaterThan(8);
    expect(graph.topics()).toContainEqual({ topic: '/points', type: CLOUD, publishers: 1, subscribers: 1 });
    expect(faults).toEqual([]);
    await node.kill();
  });

  it('rospy receives its Twist and TwistStamped', async () => {
    const node = await peers.startNode('velocity', 'base');
    const send = (topic: string, type: string) => {
      const write = velocityWriter(1, type);
      const publisher = graph.advertise({ topic, type });
      return { publisher, publish: () => publisher.publish(write(ahead, 1_000_000_000n, 'base_link')) };
    };
    const each = [send('/cmd_vel', TWIST), send('/cmd_vel_stamped', 'geometry_msgs/msg/TwistStamped')];
    await eventually(() => each.every(({ publisher }) => publisher.subscribers === 1));
    for (const { publish } of each) publish();
    await eventually(() => node.heard.length === 2);
    for (const { x, turn } of node.heard) expect([x, turn]).toEqual([0.5, -0.25]);
    await node.kill();
  });

  it('reports a killed node as gone, and finds it when it returns', async () => {
    const first = await peers.startNode('cloud', 'camera');
    const counter = counted();
    await eventually(() => counter.count > 2);
    await first.kill();
    await eventually(() => faults.some(({ message }) => message === '/points: its publisher is gone'));
    const before = counter.count;
    const second = await peers.startNode('cloud', 'camera');
    await eventually(() => counter.count > before + 5);
    // Once each: nobody is connected twice.
    expect(counter.subscription.publishers).toBe(1);
    await second.kill();
  });

  it('survives a new master: both directions work again with nodes that know it', async () => {
    const old = await peers.startNode('cloud,velocity', 'camera');
    const counter = counted();
    const publisher = graph.advertise({ topic: '/cmd_vel', type: TWIST });
    await eventually(() => counter.count > 2 && publisher.subscribers === 1);
    await peers.killCore();
    await eventually(() =>
      faults.some(({ code, message }) => code === 'lost' && message.includes('no ROS 1 master')),
    );
    // Nodes are connected to each other, not through the master.
    const before = counter.count;
    await eventually(() => counter.count > before + 3);
    await old.kill();
    await peers.startCore();
    const fresh = await peers.startNode('cloud,velocity', 'camera');
    const since = counter.count;
    await eventually(() => counter.count > since + 5 && publisher.subscribers === 1);
    publisher.publish(velocityWriter(1, TWIST)(ahead, 0n, ''));
    await eventually(() => fresh.heard.length === 1);
    await eventually(() =>
      graph.topics().some(({ topic, subscribers }) => topic === '/points' && subscribers === 1),
    );
    await fresh.kill();
  });

  it('waits for a master that is not running yet', async () => {
    await graph.close();
    await peers.killCore();
    graph = await open();
    expect(faults.map(({ code }) => code)).toEqual(['lost']);
    expect(faults[0]?.message).toContain('start roscore');
    const counter = counted();
    await peers.startCore();
    const node = await peers.startNode('cloud', 'camera');
    await eventually(() => counter.count > 2);
    await node.kill();
  });

  it('reports a topic of another type, and delivers none of its messages', async () => {
    const node = await peers.startNode('cloud', 'camera');
    const counter = counted('/points', 'sensor_msgs/msg/Image');
    await eventually(() => faults.length > 0);
    expect(faults[0]?.topic).toBe('/points');
    expect(['wrong-type', 'refused']).toContain(faults[0]?.code);
    expect(counter.count).toBe(0);
    await node.kill();
  });

  it('reads unknown types by their publisher’s definition', async () => {
    const node = await peers.startNode('own', 'arm');
    let message: unknown = null;
    const type = 'my_robot/msg/Arm';
    const subscription = graph.subscribe({ topic: '/arm', type, queue: 1 }, (bytes) => {
      message ??= decoderOf(1, type, subscription.definition)(bytes);
    });
    await eventually(() => message !== null);
    expect(message).toMatchObject({ joints: Float32Array.of(0.5, 1.5), mode: 'hold' });
    await node.kill();
  });

  it('survives peers that send garbage to its ports', async () => {
    graph.advertise({ topic: '/cmd_vel', type: TWIST });
    await eventually(() => graph.topics().some(({ topic }) => topic === '/cmd_vel'));
    const [, , url] = await new RosMasterClient(peers.masterUrl).lookupNode('/prober', '/farpoint_test');
    const { port, address } = await RosNode.RequestTopic(
      '/prober',
      '/cmd_vel',
      new RosFollowerClient(String(url)),
    );
    const ports = [port, Number(new URL(String(url)).port)];
    const header = Buffer.from('\x12\0\0\0topic=/cmd_vel\0\0\0\0');
    const length = Buffer.alloc(4);
    length.writeUInt32LE(header.length);
    const random = fc.sample(fc.uint8Array({ maxLength: 400 }), { numRuns: 60, seed: 1 });
    const nonsense = [
      ...random,
      ...random.map((bytes) => Buffer.concat([length, header, bytes])),
      Buffer.from('POST / HTTP/1.1\r\ncontent-length: 9\r\n\r\n<no>xml</'),
      Buffer.from([0xff, 0xff, 0xff, 0xff, 1]),
      Buffer.alloc(0),
    ];
    for (const bytes of nonsense) {
      for (const each of ports) {
        const socket = connect(each, address);
        socket.on('error', () => {});
        socket.end(bytes);
        socket.resume();
        await once(socket, 'close');
      }
    }
    const node = await peers.startNode('velocity,cloud', 'camera');
    const counter = counted();
    await eventually(() => counter.count > 2);
    await node.kill();
  });

  it('leaves no registration at the master when it is closed', async () => {
    const other = await open('farpoint_other');
    other.subscribe({ topic: '/points', type: CLOUD, queue: 1 }, () => {});
    other.advertise({ topic: '/left', type: TWIST });
    await eventually(() => graph.topics().some(({ topic }) => topic === '/left'));
    await other.close();
    await eventually(() => !graph.topics().some(({ topic }) => topic === '/left'));
  });

  it('ends when the master ends it because another node with its name has registered', async () => {
    const counter = counted();
    await eventually(() => graph.topics().some(({ topic }) => topic === '/points'));
    const other = await open();
    other.subscribe({ topic: '/points', type: CLOUD, queue: 1 }, () => {});
    await eventually(() =>
      faults.some(({ message }) => message.includes('the master has ended the node /farpoint_test')),
    );
    await other.close();
    expect(counter.subscription.publishers).toBe(0);
  });
});
