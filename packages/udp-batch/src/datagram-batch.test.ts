import type { Socket } from 'node:dgram';
import { describe, expect, it } from 'vitest';
import { type Addon, MOST_DATAGRAMS } from './addon.ts';
import { DatagramBatch } from './datagram-batch.ts';

const FULL = 0x1_0000;
const SEGMENTS = 0x2_0000;
const REFUSED = 0x3_0000;

/** The name by which Node keeps a socket's state. */
const STATE: unique symbol = Symbol('state symbol');

/** A socket as Node makes them, which records what is sent through it. */
class FakeSocket {
  readonly [STATE]: { handle: object | null } = { handle: { fd: 7 } };
  readonly sent: string[] = [];
  /** Called when Node has sent a datagram. */
  readonly waiting: ((error: Error | null) => void)[] = [];
  throws = false;

  address() {
    return { address: '127.0.0.1', family: 'IPv4', port: 4000 };
  }

  send(parts: Uint8Array[], port: number, address: string, callback: (error: Error | null) => void) {
    if (this.throws) throw new Error('not running');
    this.sent.push(`${address}:${port} ${Buffer.concat(parts).toString()}`);
    this.waiting.push(callback);
  }

  done(error: Error | null = null) {
    for (const callback of this.waiting.splice(0)) callback(error);
  }
}

/** An addon that takes what it is told to, and everything after that. */
class FakeAddon implements Addon {
  readonly calls: { at: string; texts: string[]; segments: boolean }[] = [];
  readonly results: number[] = [];
  /** The local port of descriptor 7. */
  readonly ports = [4000];

  udpPort(fd: number) {
    return fd === 7 ? (this.ports[0] as number) : 0;
  }

  knowsSegments() {
    return true;
  }

  send(
    fd: number,
    address: string,
    port: number,
    bytes: Uint8Array,
    lengths: Uint32Array,
    count: number,
    segments: boolean,
  ) {
    expect(fd).toBe(7);
    let at = 0;
    const texts = Array.from(lengths.subarray(0, count), (length) => {
      at += length;
      return Buffer.from(bytes.subarray(at - length, at)).toString();
    });
    this.calls.push({ at: `${address}:${port}`, texts, segments });
    return this.results.shift() ?? count;
  }
}

function stage({ plain = false } = {}) {
  const [socket, addon] = [new FakeSocket(), new FakeAddon()];
  const counters = { batched: 0, single: 0, failed: 0 };
  const batch = new DatagramBatch(socket as unknown as Socket, plain ? null : addon, counters);
  const send = (text: string, port = 5000, address = '10.0.0.1') =>
    batch.send([Buffer.from(text.slice(0, 1)), Buffer.from(text.slice(1))], port, address);
  return { socket, addon, counters, batch, send };
}

describe('DatagramBatch', () => {
  it('sends the datagrams of one turn together at its end, and those of the next by themselves', async () => {
    const { socket, addon, counters, send } = stage();
    for (const text of ['one', 'two', 'three']) send(text);
    expect(addon.calls).toEqual([]);
    await Promise.resolve();
    send('four');
    await Promise.resolve();
    expect(addon.calls).toEqual([
      { at: '10.0.0.1:5000', texts: ['one', 'two', 'three'], segments: true },
      { at: '10.0.0.1:5000', texts: ['four'], segments: true },
    ]);
    expect(socket.sent).toEqual([]);
    expect(counters).toEqual({ batched: 4, single: 0, failed: 0 });
  });

  it('copies what it is given', async () => {
    const { addon, batch } = stage();
    const part = Buffer.from('before');
    batch.send([part], 5000, '10.0.0.1');
    part.fill('x');
    await Promise.resolve();
    expect(addon.calls[0]?.texts).toEqual(['before']);
  });

  it('begins another batch for another destination, when there are enough, and when there is no more room', () => {
    const { addon, batch, send } = stage();
    send('a');
    send('b', 5001);
    send('c', 5001, '::1');
    batch.flush();
    expect(addon.calls.map(({ at, texts }) => [at, ...texts])).toEqual([
      ['10.0.0.1:5000', 'a'],
      ['10.0.0.1:5001', 'b'],
      ['::1:5001', 'c'],
    ]);
    for (let i = 0; i <= MOST_DATAGRAMS; i++) send('d');
    expect(addon.calls.at(-1)?.texts).toHaveLength(MOST_DATAGRAMS);
    batch.flush();
    expect(addon.calls.at(-1)?.texts).toHaveLength(1);
    for (let i = 0; i < 2; i++) send('e'.repeat(60_000));
    expect(addon.calls.at(-1)?.texts[0]).toHaveLength(60_000);
    batch.flush();
    expect(addon.calls).toHaveLength(7);
  });

  it('hands a datagram beyond all bounds to the socket, after those before it', () => {
    const { socket, addon, batch, send } = stage();
    send('small');
    send('x'.repeat(200_000));
    expect(addon.calls.map(({ texts }) => texts)).toEqual([['small']]);
    expect(socket.sent).toHaveLength(1);
    batch.flush();
    expect(addon.calls).toHaveLength(1);
  });

  it('hands what the kernel does not take to the socket, in order and as copies', async () => {
    const { socket, addon, counters, send } = stage();
    addon.results.push(1 + FULL);
    const sent: Uint8Array[] = [];
    const keep = socket.send.bind(socket);
    socket.send = (parts, ...rest) => {
      sent.push(...parts);
      keep(parts, ...rest);
    };
    for (const text of ['one', 'two', 'three']) send(text);
    await Promise.resolve();
    expect(socket.sent).toEqual(['10.0.0.1:5000 two', '10.0.0.1:5000 three']);
    expect(counters).toEqual({ batched: 1, single: 2, failed: 0 });
    socket.done();
    for (let i = 0; i < 3; i++) send('other');
    await Promise.resolve();
    expect(sent.map((bytes) => Buffer.from(bytes).toString())).toEqual(['two', 'three']);
  });

  it('does not overtake what waits in the socket', async () => {
    const { socket, addon, send } = stage();
    addon.results.push(FULL);
    for (const text of ['one', 'two']) {
      send(text);
      await Promise.resolve();
    }
    expect(addon.calls).toHaveLength(1);
    expect(socket.sent).toEqual(['10.0.0.1:5000 one', '10.0.0.1:5000 two']);
    socket.done();
    send('three');
    await Promise.resolve();
    expect(addon.calls.at(-1)?.texts).toEqual(['three']);
  });

  it('goes on without segments, for good, where the path takes none', async () => {
    const { socket, addon, counters, send } = stage();
    addon.results.push(1 + SEGMENTS);
    for (const text of ['one', 'two', 'three']) send(text);
    await Promise.resolve();
    send('four');
    await Promise.resolve();
    expect(addon.calls.map(({ texts, segments }) => [segments, ...texts])).toEqual([
      [true, 'one', 'two', 'three'],
      [false, 'two', 'three'],
      [false, 'four'],
    ]);
    expect(socket.sent).toEqual([]);
    expect(counters.batched).toBe(4);
  });

  it('counts what cannot be sent at all, and throws nothing', async () => {
    const { socket, addon, counters, send } = stage();
    addon.results.push(REFUSED, REFUSED);
    send('refused');
    await Promise.resolve();
    socket.done(new Error('EPERM'));
    expect(counters).toEqual({ batched: 0, single: 1, failed: 1 });
    socket.throws = true;
    send('closed');
    await Promise.resolve();
    expect(counters).toEqual({ batched: 0, single: 1, failed: 2 });
  });

  it.each<[string, (socket: FakeSocket, addon: FakeAddon) => void]>([
    ['has no handle any more', (socket) => setHandle(socket, null)],
    ['has a closed handle', (socket) => setHandle(socket, { fd: -9 })],
    ['has a descriptor of another kind', (socket) => setHandle(socket, { fd: 8 })],
    ['has no number', (socket) => setHandle(socket, {})],
    ['is not bound', (socket) => setAddress(socket, () => expect.fail())],
    ['is another', (_, addon) => addon.ports.fill(4001)],
  ])('leaves everything to a socket that %s', async (_, change) => {
    const { socket, addon, send } = stage();
    change(socket, addon);
    send('one');
    await Promise.resolve();
    expect(addon.calls).toEqual([]);
    expect(socket.sent).toEqual(['10.0.0.1:5000 one']);
  });

  it('leaves everything to the socket at once where there is no addon', () => {
    const { socket, addon, counters, send } = stage({ plain: true });
    send('one');
    send('two');
    expect(addon.calls).toEqual([]);
    expect(socket.sent).toEqual(['10.0.0.1:5000 one', '10.0.0.1:5000 two']);
    expect(counters).toEqual({ batched: 0, single: 2, failed: 0 });
  });
});

function setHandle(socket: FakeSocket, handle: object | null): void {
  socket[STATE].handle = handle;
}

function setAddress(socket: FakeSocket, address: FakeSocket['address']): void {
  socket.address = address;
}
