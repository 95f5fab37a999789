import { beforeEach, describe, expect, it } from 'vitest';
import type { LiveSocket } from './live-client.ts';
import { LiveServer } from './live-server.ts';

const CLOUD = {
  topic: '/points',
  messageEncoding: 'cdr',
  schema: { name: 'sensor_msgs/msg/PointCloud2', encoding: 'ros2msg', text: 'uint8[] data' },
};
const TELEMETRY = { topic: '/telemetry', messageEncoding: 'json', schema: null };

/** A viewer's connection; `release` lets what was sent leave. */
class FakeSocket implements LiveSocket {
  readonly texts: Record<string, unknown>[] = [];
  readonly sent: Uint8Array[] = [];
  closed: string | null = null;
  readonly #done: (() => void)[] = [];

  sendText(text: string): void {
    this.texts.push(JSON.parse(text) as Record<string, unknown>);
  }

  send(parts: readonly Uint8Array[], done: () => void): void {
    this.sent.push(Buffer.concat(parts));
    this.#done.push(done);
  }

  close(_code: number, reason: string): void {
    this.closed = reason;
  }

  release(): void {
    for (const done of this.#done.splice(0)) done();
  }
}

describe('LiveServer', () => {
  let server: LiveServer;
  let interests: number;
  let keys: number[];
  const subscribe = (...pairs: [id: number, channelId: number][]) =>
    JSON.stringify({ op: 'subscribe', subscriptions: pairs.map(([id, channelId]) => ({ id, channelId })) });
  const publish = (channel: number, ns: bigint, bytes: number, link: 'alone' | 'key' | 'follows' = 'alone') =>
    server.publish({ channel, ns, bytes: new Uint8Array(bytes).fill(7), link });

  beforeEach(() => {
    interests = 0;
    keys = [];
    server = new LiveServer(
      { name: 'robot', sessionId: '1' },
      { onInterest: () => interests++, onKeyNeeded: (channel) => keys.push(channel) },
    );
    server.addChannel(CLOUD);
  });

  it('introduces itself and its channels, also later ones, and offers no capability', () => {
    const socket = new FakeSocket();
    server.accept(socket);
    server.addChannel(TELEMETRY);
    expect(socket.texts).toEqual([
      { op: 'serverInfo', name: 'robot', capabilities: [], sessionId: '1' },
      {
        op: 'advertise',
        channels: [
          {
            ...{ id: 1, topic: '/points', encoding: 'cdr', schemaName: 'sensor_msgs/msg/PointCloud2' },
            ...{ schema: 'uint8[] data', schemaEncoding: 'ros2msg' },
          },
        ],
      },
      {
        op: 'advertise',
        channels: [{ id: 2, topic: '/telemetry', encoding: 'json', schemaName: '', schema: '' }],
      },
    ]);
  });

  it('says what is wanted: nothing need be made for channels without subscribers', () => {
    const [a, b] = [server.accept(new FakeSocket()), server.accept(new FakeSocket())];
    expect(server.wants(1)).toBe(false);
    a.receive(subscribe([5, 1]), 0);
    b.receive(subscribe([0, 1]), 0);
    expect(server.wants(1)).toBe(true);
    a.receive('{"op":"unsubscribe","subscriptionIds":[5]}', 0);
    expect(interests).toBe(1);
    server.remove(b);
    expect(server.wants(1)).toBe(false);
    expect(interests).toBe(2);
  });

  it('sends messages with the subscription’s id and the time', () => {
    const socket = new FakeSocket();
    server.accept(socket).receive(subscribe([258, 1]), 0);
    publish(1, 1_700_000_000_000_000_001n, 2);
    const [sent] = socket.sent as [Buffer];
    expect([...sent.subarray(0, 5)]).toEqual([1, 2, 1, 0, 0]);
    expect(sent.readBigUInt64LE(5)).toBe(1_700_000_000_000_000_001n);
    expect([...sent.subarray(13)]).toEqual([7, 7]);
    expect(server.counts).toMatchObject({ clients: 1, subscriptions: 1, messages: 1, bytes: 2, dropped: 0 });
  });

  it('a slow client loses old messages, and delays nobody', () => {
    const [slow, fast] = [new FakeSocket(), new FakeSocket()];
    server.accept(slow).receive(subscribe([0, 1]), 0);
    server.accept(fast).receive(subscribe([0, 1]), 0);
    const megabyte = 1024 * 1024;
    for (let k = 0; k < 100; k++) {
      publish(1, BigInt(k), megabyte);
      fast.release();
    }
    expect(fast.sent).toHaveLength(100);
    expect(slow.sent).toHaveLength(1);
    expect(server.counts.dropped).toBe(100 - 1 - 32);
    for (let k = 0; k < 100; k++) slow.release();
    // What waited is sent in order, up to the newest.
    const times = slow.sent.map((each) => Buffer.from(each).readBigUInt64LE(5));
    expect(times).toEqual([0n, ...Array.from({ length: 32 }, (_, i) => BigInt(68 + i))]);
  });

  it('begins a video with a key frame and asks for it', () => {
    const socket = new FakeSocket();
    server.accept(socket).receive(subscribe([0, 1]), 0);
    publish(1, 1n, 10, 'follows');
    expect(keys).toEqual([1]);
    publish(1, 2n, 10, 'key');
    publish(1, 3n, 10, 'follows');
    expect(socket.sent).toHaveLength(2);
  });

  it('refuses what it does not offer, says so, and counts it', () => {
    const socket = new FakeSocket();
    const client = server.accept(socket);
    client.receive(new Uint8Array(100), 0);
    client.receive('{"op":"advertise","channels":[]}', 0);
    client.receive(subscribe([0, 99]), 0);
    client.receive(subscribe([0, 1], [0, 1]), 0);
    expect(socket.texts.slice(2).map(({ op, level }) => [op, level])).toEqual(Array(4).fill(['status', 1]));
    expect(server.counts.refused).toEqual({
      ...{ binary: 1, 'not-offered': 1, 'no-channel': 1, 'subscribed-already': 1 },
    });
    expect(server.wants(1)).toBe(true);
  });

  it('closes a client that keeps sending what is not obeyed', () => {
    const socket = new FakeSocket();
    const client = server.accept(socket);
    for (let i = 0; i < 100; i++) client.receive('garbage', i * 1000);
    expect(socket.closed).toBe('too many messages that are not obeyed');
    expect(server.counts.refused['not-json']).toBe(33);
  });

  it('closes a client that sends too many messages', () => {
    const socket = new FakeSocket();
    const client = server.accept(socket);
    for (let i = 0; i < 300; i++) client.receive('{"op":"unsubscribe","subscriptionIds":[]}', 0);
    expect(socket.closed).toBe('too many messages');
    expect(server.counts.refused).toEqual({ 'too-many': 1 });
  });

  it('keeps the counts of clients that are gone', () => {
    const socket = new FakeSocket();
    const client = server.accept(socket);
    client.receive(subscribe([0, 1]), 0);
    publish(1, 0n, 5);
    server.remove(client);
    server.remove(client);
    publish(1, 1n, 5);
    expect(server.counts).toMatchObject({ clients: 0, subscriptions: 0, messages: 1, bytes: 5 });
  });
});
