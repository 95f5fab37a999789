import { createSocket, type RemoteInfo, type Socket } from 'node:dgram';
import { once } from 'node:events';
import { constantCapacity, idealProfile, type LinkBin } from '@farpoint/network-sim';
import { expect, onTestFinished, test } from 'vitest';
import type { Endpoint } from './candidate.ts';
import { type Direction, UdpLink, type UdpLinkOptions } from './udp-link.ts';

/** A datagram socket whose packets can be awaited. */
class Peer {
  readonly received: { text: string; from: Endpoint }[] = [];
  readonly #socket: Socket;
  #wake: () => void = () => {};

  private constructor(socket: Socket) {
    this.#socket = socket;
    socket.on('message', (data: Buffer, { address, port }: RemoteInfo) => {
      this.received.push({ text: data.toString(), from: { address, port } });
      this.#wake();
    });
  }

  static async open(): Promise<Peer> {
    const socket = createSocket({ type: 'udp4', recvBufferSize: 1 << 20 });
    socket.bind(0, '127.0.0.1');
    await once(socket, 'listening');
    onTestFinished(() => void socket.close());
    return new Peer(socket);
  }

  get endpoint(): Endpoint {
    const { address, port } = this.#socket.address();
    return { address, port };
  }

  send(text: string, to: Endpoint): void {
    this.#socket.send(text, to.port, to.address);
  }

  async until(count: number): Promise<void> {
    while (this.received.length < count) {
      await new Promise<void>((resolve) => {
        this.#wake = resolve;
      });
    }
  }
}

function open(options: Partial<UdpLinkOptions> = {}): UdpLink {
  const link = new UdpLink({
    up: { profile: idealProfile },
    down: { profile: idealProfile },
    seed: 1,
    ...options,
  });
  onTestFinished(() => link.close());
  return link;
}

test('two peers that know only stand-ins hear each other, in order, from the stand-ins they know', async () => {
  const bins: { direction: Direction; bin: LinkBin }[] = [];
  const profile = { ...idealProfile, capacity: constantCapacity(20), delayMs: 5 };
  const link = open({
    up: { profile },
    down: { profile },
    onBin: (direction, bin) => bins.push({ direction, bin }),
  });
  const [robot, operator] = [await Peer.open(), await Peer.open()];
  const robotPlace = await link.standInFor('robot', robot.endpoint);
  const operatorPlace = await link.standInFor('operator', operator.endpoint);
  expect(robotPlace).not.toEqual(robot.endpoint);

  const COUNT = 300;
  for (let i = 0; i < COUNT; i++) {
    robot.send(`up ${i}`, operatorPlace);
    operator.send(`down ${i}`, robotPlace);
  }
  await Promise.all([robot.until(COUNT), operator.until(COUNT)]);
  expect(operator.received).toEqual(
    Array.from({ length: COUNT }, (_, i) => ({ text: `up ${i}`, from: robotPlace })),
  );
  expect(robot.received).toEqual(
    Array.from({ length: COUNT }, (_, i) => ({ text: `down ${i}`, from: operatorPlace })),
  );
  expect(link.packets).toBe(2 * COUNT);
  expect(link.ports).toBe(2);
  // Never early.
  expect(link.lateness.count).toBe(2 * COUNT);
});

test('a peer that signaling did not name gets a stand-in when it sends, and is answered through it', async () => {
  const link = open();
  const [robot, stranger] = [await Peer.open(), await Peer.open()];
  const robotPlace = await link.standInFor('robot', robot.endpoint);
  stranger.send('hello', robotPlace);
  await robot.until(1);
  const from = robot.received[0]!.from;
  expect(from).not.toEqual(stranger.endpoint);
  expect(link.standIn('operator', stranger.endpoint)).toEqual(from);
  robot.send('welcome', from);
  await stranger.until(1);
  expect(stranger.received).toEqual([{ text: 'welcome', from: robotPlace }]);
});

test('packets that the model drops do not arrive, packets that it duplicates arrive twice', async () => {
  const link = open({
    up: { profile: { ...idealProfile, loss: 1 } },
    down: { profile: { ...idealProfile, duplicate: 1 } },
  });
  const [robot, operator] = [await Peer.open(), await Peer.open()];
  const robotPlace = await link.standInFor('robot', robot.endpoint);
  const operatorPlace = await link.standInFor('operator', operator.endpoint);
  robot.send('lost', operatorPlace);
  operator.send('twice', robotPlace);
  await robot.until(2);
  expect(robot.received.map(({ text }) => text)).toEqual(['twice', 'twice']);
  expect(operator.received).toEqual([]);
});

test('a new profile that ends an outage releases what waits', async () => {
  const dead = { ...idealProfile, capacity: constantCapacity(0) };
  const link = open({ up: { profile: dead } });
  const [robot, operator] = [await Peer.open(), await Peer.open()];
  const robotPlace = await link.standInFor('robot', robot.endpoint);
  const operatorPlace = await link.standInFor('operator', operator.endpoint);
  robot.send('held', operatorPlace);
  // The other direction shows that the first packet was accepted.
  robot.send('held too', operatorPlace);
  operator.send('through', robotPlace);
  await robot.until(1);
  expect(operator.received).toEqual([]);
  link.models.up.setProfile(idealProfile, 0);
  link.advance();
  await operator.until(2);
  expect(operator.received.map(({ text }) => text)).toEqual(['held', 'held too']);
});

test('each endpoint has one stand-in, a stand-in is its own stand-in, and their number is limited', async () => {
  const link = open({ maxPorts: 3 });
  const first = { address: '127.0.0.1', port: 40_001 };
  const place = await link.standInFor('robot', first);
  expect(await link.standInFor('robot', first)).toEqual(place);
  expect(await link.standInFor('operator', place)).toEqual(place);
  expect(link.isStandIn(place)).toBe(true);
  for (let port = 40_002; port < 40_010; port++) await link.standInFor('robot', { ...first, port });
  expect(link.ports).toBe(3);
  expect(link.standIn('robot', first)).toBeNull();
});

test('an endpoint of the other address family gets a stand-in of its own family', async () => {
  const link = open();
  const place = await link.standInFor('operator', { address: '2001:db8::7', port: 500 });
  expect(place.address).toBe('::1');
  expect((await link.standInFor('operator', { address: '198.51.100.7', port: 500 })).address).toBe(
    '127.0.0.1',
  );
});
