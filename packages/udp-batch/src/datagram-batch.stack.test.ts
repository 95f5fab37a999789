/** The addon and the batch on real sockets, and at a stand-in for a kernel that takes less. */
import { spawn } from 'node:child_process';
import { createSocket, type Socket } from 'node:dgram';
import { once } from 'node:events';
import { closeSync, openSync } from 'node:fs';
import { type AddressInfo, createServer } from 'node:net';
import { join } from 'node:path';
import { text } from 'node:stream/consumers';
import { afterAll, describe, expect, it, onTestFinished } from 'vitest';
import { type Addon, loadAddon, readSending } from './addon.ts';
import { DatagramBatch } from './datagram-batch.ts';
import { SocketDescriptor } from './socket-descriptor.ts';
import { FakeSendmmsg } from './testing/fake-sendmmsg.ts';
import { Received } from './testing/received.ts';

const addon = loadAddon();
const fake = addon === null ? null : FakeSendmmsg.build();
afterAll(() => fake?.close());

async function receiver(address: '127.0.0.1' | '::1' = '127.0.0.1'): Promise<Received> {
  const received = await Received.at(address);
  onTestFinished(() => void received.socket.close());
  return received;
}

async function sender(type: 'udp4' | 'udp6' = 'udp4', by: Addon | null = addon) {
  const socket = createSocket(type).bind(0);
  await once(socket, 'listening');
  let open = true;
  socket.once('close', () => {
    open = false;
  });
  onTestFinished(() => void (open && socket.close()));
  const counters = { batched: 0, single: 0, failed: 0 };
  return { socket, counters, batch: new DatagramBatch(socket, by, counters) };
}

function descriptorOf(socket: Socket): number {
  return new SocketDescriptor(socket, addon as Addon).get() as number;
}

describe.skipIf(addon === null)('a batch on a real socket (needs the addon, pnpm build:native)', () => {
  it.each([
    ['127.0.0.1', 'udp4', '127.0.0.1'],
    ['::1', 'udp6', '::1'],
    ['::1 by its interface', 'udp6', '::1%lo'],
    ['127.0.0.1 from a socket for both', 'udp6', '::ffff:127.0.0.1'],
  ] as const)('reaches %s whole, in order, whatever the lengths', async (_, type, address) => {
    const received = await receiver(address.includes('127') ? '127.0.0.1' : '::1');
    const { batch, counters } = await sender(type);
    const lengths = [1252, 1252, 1252, 300, 1252, 1252, 0, 0, 1, 2, 2, 1400, 9000, 9000, 40_000, 1252, 1252];
    for (let i = 0; i < lengths.length; i++) {
      const datagram = Buffer.alloc(lengths[i] as number, i);
      batch.send([datagram.subarray(0, 1), datagram.subarray(1)], received.port, address);
    }
    const datagrams = await received.until(lengths.length);
    expect(datagrams.map(({ length }) => length)).toEqual(lengths);
    expect(datagrams.every((bytes, i) => bytes.every((byte) => byte === i))).toBe(true);
    expect(counters).toEqual({ batched: lengths.length, single: 0, failed: 0 });
  });

  it('loses only the datagram that no system sends', async () => {
    const received = await receiver();
    const { batch, counters } = await sender();
    for (const length of [10, 70_000, 20]) batch.send([Buffer.alloc(length)], received.port, '127.0.0.1');
    const datagrams = await received.until(2);
    expect(datagrams.map(({ length }) => length).toSorted()).toEqual([10, 20]);
    expect(counters).toEqual({ batched: 1, single: 2, failed: 1 });
  });

  it('counts what is sent on a closed socket, and sends it through no other that has its number', async () => {
    const received = await receiver();
    const { batch, counters, socket } = await sender();
    batch.send([Buffer.from('before')], received.port, '127.0.0.1');
    await received.until(1);
    const fd = descriptorOf(socket);
    batch.send([Buffer.from('pending')], received.port, '127.0.0.1');
    socket.close();
    const other = await sender();
    expect(new SocketDescriptor(socket, addon as Addon).get()).toBeNull();
    batch.flush();
    batch.send([Buffer.from('after')], received.port, '127.0.0.1');
    batch.flush();
    expect(counters).toEqual({ batched: 1, single: 0, failed: 2 });
    other.batch.send([Buffer.from(`last, by ${fd}`)], received.port, '127.0.0.1');
    const datagrams = await received.until(2);
    expect(datagrams.map(String)).toEqual(['before', `last, by ${fd}`]);
  });

  it('throws nothing for what is no address or port', async () => {
    const { batch, counters } = await sender();
    for (const [address, port] of [
      ['nowhere.invalid.', 0],
      ['1.2.3.4.5', 70_000],
      ['x'.repeat(300), -1],
      ['127.0.0.1', Number.NaN],
    ] as const) {
      batch.send([Buffer.from('lost')], port, address);
      batch.flush();
    }
    expect(counters).toEqual({ batched: 0, single: 0, failed: 4 });
  });

  it('sends the same without the addon', async () => {
    const received = await receiver();
    const { batch, counters } = await sender('udp4', null);
    for (const word of ['one', 'two']) batch.send([Buffer.from(word)], received.port, '127.0.0.1');
    expect((await received.until(2)).map(String)).toEqual(['one', 'two']);
    expect(counters).toEqual({ batched: 0, single: 2, failed: 0 });
  });
});

describe.skipIf(addon === null)('the addon (needs pnpm build:native)', () => {
  it('knows a UDP socket from any other descriptor', async () => {
    const { socket } = await sender();
    const fd = descriptorOf(socket);
    expect(addon?.udpPort(fd)).toBe(socket.address().port);
    const file = openSync('/dev/null', 'r');
    const server = createServer().listen(0, '127.0.0.1');
    onTestFinished(() => {
      closeSync(file);
      server.close();
    });
    await once(server, 'listening');
    expect((server.address() as AddressInfo).port).toBeGreaterThan(0);
    const { fd: listening } = (server as unknown as { _handle: { fd: number } })._handle;
    expect([file, listening, 1_000_000].map((each) => addon?.udpPort(each))).toEqual([0, 0, 0]);
    expect(addon?.knowsSegments(file)).toBe(false);
  });

  it('says that nothing was sent to what is no address, no port, and by what is no socket', async () => {
    const { socket } = await sender();
    const fd = descriptorOf(socket);
    const send = (by: number, address: string, port: number) =>
      readSending((addon as Addon).send(by, address, port, new Uint8Array(4), Uint32Array.of(4), 1, false));
    const refused = { sent: 0, stop: 'refused' };
    expect(send(fd, 'localhost', 5000)).toEqual(refused);
    expect(send(fd, '::1%no-such-interface', 5000)).toEqual(refused);
    expect(send(fd, '127.0.0.1', 0)).toEqual(refused);
    expect(send(fd, '127.0.0.1', 70_000)).toEqual(refused);
    expect(send(1_000_000, '127.0.0.1', 5000)).toEqual(refused);
  });

  it('refuses wrong types and lengths with a typed error', async () => {
    const right = [0, '127.0.0.1', 5000, new Uint8Array(8), Uint32Array.of(4, 4), 2, true];
    const call = (at: number, value: unknown) => {
      const wrong = (right as unknown[]).with(at, value);
      return () => (addon as unknown as { send(...given: unknown[]): number }).send(...wrong);
    };
    const wrongs: [at: number, value: unknown][] = [
      ...[-1, 1.5, Number.NaN, 2 ** 31, '1', null].map((value): [number, unknown] => [0, value]),
      ...[1, null, 'x'.repeat(80), 'a\0b'].map((value): [number, unknown] => [1, value]),
      ...['5000', -1, 1e10].map((value): [number, unknown] => [2, value]),
      ...[[1, 2], new Uint16Array(8), new DataView(new ArrayBuffer(8)), 'bytes'].map(
        (value): [number, unknown] => [3, value],
      ),
      ...[[4, 4], new Float32Array(2), Uint32Array.of(4, 5), Uint32Array.of(9, 0), Uint32Array.of(4)].map(
        (value): [number, unknown] => [4, value],
      ),
      [4, Uint32Array.of(2 ** 32 - 1, 8)],
      ...[3, 65, -1, '2'].map((value): [number, unknown] => [5, value]),
      ...[1, undefined].map((value): [number, unknown] => [6, value]),
    ];
    for (const [at, value] of wrongs) {
      expect(call(at, value), `${at}: ${String(value)}`).toThrow(
        expect.objectContaining({ name: 'TypeError', code: 'RANGE' }),
      );
    }
    for (const name of ['udpPort', 'knowsSegments', 'send'] as const) {
      const bare = (addon as unknown as Record<string, () => unknown>)[name] as () => unknown;
      expect(bare).toThrow(expect.objectContaining({ name: 'TypeError', code: 'RANGE' }));
    }
  });
});

describe.skipIf(fake === null)('a kernel that takes less than it is given (needs a C compiler)', () => {
  /** Sends ten datagrams of 100 bytes in one turn. */
  async function run(script: string) {
    const received = await receiver();
    const child = spawn(
      process.execPath,
      [join(import.meta.dirname, 'testing', 'send-numbered.ts'), String(received.port), '10', '100'],
      { env: { ...process.env, ...fake?.env(script) }, stdio: ['ignore', 'pipe', 'inherit'] },
    );
    const counters = JSON.parse(await text(child.stdout)) as object;
    const datagrams = await received.until(11);
    expect(datagrams.map((bytes) => (bytes.length === 100 ? bytes[99] : String(bytes)))).toEqual([
      ...Array(10).keys(),
      'end',
    ]);
    return { counters, calls: fake?.calls };
  }

  it('gets ten datagrams by one call, and with segments as one message', async () => {
    const { counters, calls } = await run('');
    expect(counters).toEqual({ batched: 10, single: 0, failed: 0 });
    expect(calls).toEqual([[100]]);
  });

  it.each(['EAGAIN', 'ENOBUFS'])('is full (%s): Node sends the rest later, in order', async (error) => {
    const { counters, calls } = await run(`EIO 4 ${error}`);
    expect(counters).toEqual({ batched: 4, single: 6, failed: 0 });
    expect(calls).toEqual([[100], Array(10).fill(0), Array(6).fill(0)]);
  });

  it('takes no segmented messages: they leave one by one, by one call', async () => {
    const { counters, calls } = await run('EIO');
    expect(counters).toEqual({ batched: 10, single: 0, failed: 0 });
    expect(calls).toEqual([[100], Array(10).fill(0)]);
  });

  it('is interrupted, or takes them in pieces: the addon goes on', async () => {
    const { counters, calls } = await run('EINTR EIO 3 EINTR 2');
    expect(counters).toEqual({ batched: 10, single: 0, failed: 0 });
    expect(calls?.map(({ length }) => length)).toEqual([1, 1, 10, 7, 7, 5]);
  });

  it('refuses a datagram: Node tries it and the rest', async () => {
    const { counters } = await run('EIO 4 EPERM');
    expect(counters).toEqual({ batched: 4, single: 6, failed: 0 });
  });
});
