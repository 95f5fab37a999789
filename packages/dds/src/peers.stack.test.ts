/** Tests the graph against other vendors' DDS: Fast DDS and Python's. */
import { createSocket } from 'node:dgram';
import { readFileSync } from 'node:fs';
import { Random } from '@farpoint/network-sim/random';
import { type RosFault, SENSOR_QOS, VELOCITY_QOS, velocityWriter } from '@farpoint/ros';
import { eventually } from '@farpoint/service/testing/eventually';
import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { isAvailable } from './addon.ts';
import { DdsGraph } from './dds-graph.ts';
import { ADDON_SUITE, cdr, testDomain } from './testing/helpers.ts';
import { CLOUD_QOS, type MarkedCloud, readMarkedCloud } from './testing/marked-cloud.ts';
import { findPeer, PEER_REMEDY, Peer, type PeerKind, type PeerOptions } from './testing/peers.ts';

const POINTS = 'sensor_msgs/msg/PointCloud2';
const TWIST = 'geometry_msgs/msg/Twist';
const STRING = 'std_msgs/msg/String';
const domain = testDomain();
const PROBE = cdr(0xca, 0xfe, 0xba, 0xbe);
const isProbe = (bytes: Uint8Array) => Buffer.compare(bytes, PROBE) === 0;

const writeTwist = velocityWriter(2, TWIST);
function twist(x: number, z: number): Uint8Array {
  const zero = { x: 0, y: 0, z: 0 };
  return writeTwist({ linear: { ...zero, x }, angular: { ...zero, z } }, 0n, '');
}

/** A cloud of 3.7 MB arrives as one burst; with less buffer, packets are lost faster than they are retransmitted. */
const CLOUD_BUFFER_BYTES = 4_000_000;
const BUFFER_NOTE = ' (needs net.core.rmem_max of 4 MB)';

/** The kernel's limit, bytes. */
function receiveBufferMost(): number {
  try {
    return Number(readFileSync('/proc/sys/net/core/rmem_max', 'utf8'));
  } catch {
    // Not Linux: the limit is unknown.
    return Number.POSITIVE_INFINITY;
  }
}

const kinds: PeerKind[] = ['Fast DDS', 'Python'];
// Seconds, on a machine that does other things as well: discovery, a start of Python, clouds of 3.7 MB.
const options = { timeout: 60_000 };

for (const kind of kinds) {
  const command = isAvailable() ? findPeer(kind) : null;
  const note = ADDON_SUITE.skip ? ADDON_SUITE.note : `needs ${PEER_REMEDY[kind]}`;
  describe(`beside ${kind} (${note})`, { skip: command === null, ...options }, () => {
    let graph: DdsGraph;
    let faults: RosFault[];
    const peers: Peer[] = [];
    const open = () => {
      graph = new DdsGraph({ domain, localhostOnly: true, env: {} });
      graph.onFault = (fault) => faults.push(fault);
    };
    const start = async (asked: Omit<PeerOptions, 'domain'>) => {
      const peer = await Peer.start(command as string[], { domain, ...asked });
      peers.push(peer);
      return peer;
    };
    beforeEach(() => {
      faults = [];
      open();
    });
    afterEach(async () => {
      await graph.close();
      for (const peer of peers.splice(0)) await peer.kill();
    });

    function hearClouds(side: number, qos = CLOUD_QOS): (MarkedCloud | null)[] {
      const clouds: (MarkedCloud | null)[] = [];
      graph.subscribe({ topic: '/points', type: POINTS, queue: 5, qos }, (bytes) =>
        clouds.push(readMarkedCloud(bytes, side)),
      );
      return clouds;
    }

    it(`clouds of 230,400 points arrive complete, in order, not torn${BUFFER_NOTE}`, async ({ skip }) => {
      skip(receiveBufferMost() < CLOUD_BUFFER_BYTES);
      const clouds = hearClouds(480);
      await start({ cloud: 'rt/points', side: 480, hz: 10 });
      await eventually(() => clouds.length >= 20);
      const first = clouds[0]?.number as number;
      expect(clouds.map((cloud) => cloud?.number)).toEqual(clouds.map((_, i) => first + i));
      expect(clouds.every((cloud) => cloud !== null && !cloud.torn)).toBe(true);
      expect(faults).toEqual([]);
      expect(graph.topics()).toEqual([{ topic: '/points', type: POINTS, publishers: 1, subscribers: 0 }]);
    });

    it('clouds of a best-effort publisher arrive, too', async () => {
      const clouds = hearClouds(128, SENSOR_QOS);
      await start({ cloud: 'rt/points', side: 128, hz: 20, reliability: 'best-effort' });
      await eventually(() => clouds.length >= 20);
      expect(clouds.every((cloud) => cloud !== null && !cloud.torn)).toBe(true);
    });

    it('a Twist is received and comes back', async () => {
      const publisher = graph.advertise({ topic: '/cmd_vel', type: TWIST, qos: VELOCITY_QOS });
      let back = 0;
      graph.subscribe({ topic: '/echo', type: TWIST, queue: 1, qos: VELOCITY_QOS }, (bytes) => {
        back = new DataView(bytes.buffer, bytes.byteOffset).getFloat64(4, true);
      });
      const peer = await start({ twist: 'rt/cmd_vel', echo: 'rt/echo' });
      // Once it has come back for the first time, all participants know each other.
      await eventually(() => {
        publisher.publish(twist(100, 0));
        return back === 100;
      });
      for (let i = 1; i <= 100; i++) {
        publisher.publish(twist(i / 8, -i / 16));
        await eventually(() => back === i / 8);
      }
      await eventually(() => peer.twists.at(-1)?.x === 100 / 8);
      expect(peer.twists.slice(-100).map(({ x, z }) => [x, z])).toEqual(
        Array.from({ length: 100 }, (_, i) => [(i + 1) / 8, -(i + 1) / 16]),
      );
    });

    it('either side may be killed and come back', async () => {
      const listen = () => {
        const clouds = hearClouds(64);
        const publisher = graph.advertise({ topic: '/cmd_vel', type: TWIST, qos: VELOCITY_QOS });
        return { clouds, publisher };
      };
      const sides = { cloud: 'rt/points', side: 64, hz: 20, twist: 'rt/cmd_vel' };
      let { clouds, publisher } = listen();
      const first = await start(sides);
      const works = async (peer: Peer) => {
        const [had, heard] = [clouds.length, peer.twists.length];
        await eventually(() => {
          publisher.publish(twist(1, 1));
          return clouds.length > had && peer.twists.length > heard;
        });
      };
      await works(first);
      await first.kill();
      const second = await start(sides);
      await works(second);
      await graph.close();
      open();
      ({ clouds, publisher } = listen());
      await works(second);
    });

    if (kind !== 'Fast DDS') return;

    /**
     * Neither side reports when both have discovered each other, so this waits for the first of these messages. Later
     * ones may still be in transit. What arrives before the publisher's first heartbeat is history to CycloneDDS, which
     * a new reader does not get: so it also waits until they are acknowledged.
     */
    async function probe(peer: Peer, probes: unknown[]): Promise<void> {
      await eventually(() => peer.matched);
      while (probes.length === 0) {
        peer.send(PROBE);
        const patience = performance.now() + 200;
        await eventually(() => probes.length > 0 || performance.now() > patience);
      }
      await peer.acknowledged();
    }

    it('reports a topic of another type by name', async () => {
      const clouds = hearClouds(8);
      await start({ cloud: 'rt/points', side: 8, type: 'sensor_msgs::msg::dds_::PointCloud_' });
      await eventually(() => faults.length > 0);
      expect(faults[0]).toMatchObject({ code: 'wrong-type', topic: '/points' });
      expect(faults[0]?.message).toContain('sensor_msgs/msg/PointCloud,');
      expect(clouds).toEqual([]);
    });

    it('messages of random bytes are reported, or delivered unchanged', async () => {
      const random = new Random(20261121, 0);
      const heard: string[] = [];
      const probes: Uint8Array[] = [];
      graph.subscribe(
        { topic: '/raw', type: STRING, queue: 1000, qos: { ...CLOUD_QOS, depth: 1000 } },
        (bytes) => {
          if (isProbe(bytes)) probes.push(bytes);
          else heard.push(Buffer.from(bytes).toString('hex'));
        },
      );
      const peer = await start({ raw: 'rt/raw', rawType: 'std_msgs::msg::dds_::String_' });
      await probe(peer, probes);
      const sent = Array.from({ length: 400 }, (_, i) => {
        // Small ones, and ones that need fragments, in all existing representations. Without a complete header, none is
        // a message: DDS implementations differ in how they treat it and what shares its packet.
        const size = 4 + Math.floor(random.next() * (i % 10 === 0 ? 200_000 : 64));
        const bytes = Uint8Array.from({ length: size }, () => random.next() * 256);
        bytes.set([0, [0, 1, 2, 3, 6, 7, 8, 9, 10, 11][Math.floor(random.next() * 10)] as number]);
        return bytes;
      });
      const sound = sent.filter((bytes) => [0, 1, 6, 7].includes(bytes[1] ?? 0));
      // One by one: a reader may drop a packet as a whole if one of its messages is none.
      let due = 0;
      for (const bytes of sent) {
        peer.send(bytes);
        if (!sound.includes(bytes)) continue;
        due++;
        // On a busy machine, Fast DDS's sending thread may keep a message until another one wakes it.
        for (;;) {
          const patience = performance.now() + 500;
          await eventually(() => heard.length >= due || performance.now() > patience);
          if (heard.length >= due) break;
          peer.send(PROBE);
        }
      }
      // It pads most messages to a multiple of four bytes.
      const cut = heard.map((hex, i) => hex.slice(0, 2 * (sound[i]?.length ?? 0)));
      expect(cut).toEqual(sound.map((bytes) => Buffer.from(bytes).toString('hex')));
      expect(heard.every((hex, i) => hex.length - (cut[i]?.length ?? 0) < 2 * 4)).toBe(true);
      expect(faults.length).toBeGreaterThan(10);
      for (const fault of faults) {
        expect(fault).toMatchObject({ code: 'unsupported', topic: '/raw', offset: 0 });
      }
    });

    it('packets of random bytes do no harm', async () => {
      const clouds = hearClouds(64);
      const random = new Random(7, 0);
      const socket = createSocket('udp4');
      // Where participants of a domain are discovered: PB and DG of DDSI-RTPS.
      const [base, perDomain] = [7400, 250];
      const port = base + perDomain * domain;
      for (let i = 0; i < 3000; i++) {
        const packet = Uint8Array.from(
          { length: 24 + Math.floor(random.next() * 300) },
          () => random.next() * 256,
        );
        // A valid header of RTPS 2.3 and CycloneDDS, then a submessage of an existing kind.
        packet.set([...Buffer.from('RTPS'), 2, 3, 1, 16]);
        packet.set(
          [[0x06, 0x07, 0x08, 0x09, 0x0e, 0x15, 0x16][Math.floor(random.next() * 7)] as number, 1],
          20,
        );
        // Discovery and data ports of the domain's first participants.
        const to = port + 10 + Math.floor(random.next() * 6);
        await new Promise((resolve) => socket.send(packet, to, '127.0.0.1', resolve));
      }
      socket.close();
      await start({ cloud: 'rt/points', side: 64, hz: 20 });
      await eventually(() => clouds.length >= 5);
      expect(clouds.every((cloud) => cloud !== null && !cloud.torn)).toBe(true);
    });
  });
}
