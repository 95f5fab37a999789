/** The server on real sockets: the official client, and clients that behave badly. */
import { once } from 'node:events';
import { connect } from 'node:net';
import { FoxgloveClient } from '@foxglove/ws-protocol';
import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { WebSocket } from 'ws';
import { LiveListener } from './live-listener.ts';
import { LiveServer } from './live-server.ts';

const CHANNEL = { topic: '/telemetry', messageEncoding: 'json', schema: null };
const PROTOCOLS = ['foxglove.websocket.v1', 'foxglove.sdk.v1'];

describe('LiveListener', () => {
  let server: LiveServer;
  let listener: LiveListener;
  let sockets: WebSocket[];
  let onInterest: () => void;

  beforeEach(async () => {
    sockets = [];
    onInterest = () => undefined;
    server = new LiveServer(
      { name: 'robot', sessionId: '1' },
      { onInterest: () => onInterest(), onKeyNeeded: () => undefined },
    );
    server.addChannel(CHANNEL);
    const options = { host: '127.0.0.1', port: 0, allowedOrigins: [], ownNames: [], mostClients: 3 };
    listener = await LiveListener.open(options, server);
  });

  afterEach(async () => {
    for (const socket of sockets) socket.terminate();
    await listener.close();
  });

  function open(protocols = PROTOCOLS, origin?: string): WebSocket {
    const socket = new WebSocket(
      `ws://127.0.0.1:${listener.port}`,
      protocols,
      origin === undefined ? {} : { origin },
    );
    socket.on('error', () => undefined);
    sockets.push(socket);
    return socket;
  }

  async function refusal(socket: WebSocket): Promise<number | undefined> {
    const [, response] = (await once(socket, 'unexpected-response')) as [unknown, { statusCode?: number }];
    return response.statusCode;
  }

  const interested = () =>
    new Promise<void>((resolve) => {
      onInterest = resolve;
    });

  it.each([[PROTOCOLS], [['foxglove.websocket.v1']], [['foxglove.sdk.v1']]])(
    'the official client gets channels and messages over %s',
    async (protocols) => {
      const socket = open(protocols);
      const client = new FoxgloveClient({ ws: socket as never });
      const errors: unknown[] = [];
      client.on('error', (error) => errors.push(error));
      const info = new Promise((resolve) => client.on('serverInfo', resolve));
      const channels = new Promise<{ id: number; topic: string }[]>((resolve) =>
        client.on('advertise', resolve),
      );
      expect(await info).toMatchObject({ name: 'robot', capabilities: [] });
      const [channel] = await channels;
      expect(channel).toMatchObject({ topic: '/telemetry', encoding: 'json' });
      const wanted = interested();
      const id = client.subscribe(channel?.id ?? 0);
      await wanted;
      const messages = new Promise<unknown[]>((resolve) => {
        const got: unknown[] = [];
        client.on('message', ({ subscriptionId, timestamp, data }) => {
          const bytes = new Uint8Array(data.buffer, data.byteOffset, data.byteLength);
          got.push([subscriptionId, timestamp, bytes.length, bytes[0]]);
          if (got.length === 2) resolve(got);
        });
      });
      server.publish({ channel: 1, ns: 12n, bytes: new Uint8Array(100).fill(1), link: 'alone' });
      // Large enough to be sent in fragments.
      server.publish({ channel: 1, ns: 13n, bytes: new Uint8Array(300_000).fill(2), link: 'alone' });
      expect(await messages).toEqual([
        [id, 12n, 100, 1],
        [id, 13n, 300_000, 2],
      ]);
      const left = interested();
      client.unsubscribe(id);
      await left;
      expect(server.wants(1)).toBe(false);
      expect(errors).toEqual([]);
      client.close();
    },
  );

  it('refuses pages of other origins, other protocols, and more viewers than allowed', async () => {
    expect(await refusal(open(PROTOCOLS, 'https://evil.example'))).toBe(403);
    expect(await refusal(open(['chat']))).toBe(400);
    expect(await refusal(open([]))).toBe(400);
    const welcome = [
      open(PROTOCOLS, 'http://localhost:300'),
      open(PROTOCOLS, 'https://app.foxglove.dev'),
      open(),
    ];
    await Promise.all(welcome.map((socket) => once(socket, 'message')));
    expect(await refusal(open())).toBe(503);
    expect(listener.refused).toEqual({ origin: 1, protocol: 2, 'too-many': 1 });
    const closed = once(welcome[0]!, 'close');
    welcome[0]!.terminate();
    await closed;
    const again = async () => {
      const socket = open();
      return Promise.race([once(socket, 'message').then(() => true), refusal(socket).then(() => false)]);
    };
    while (!(await again()));
  });

  it('ends a connection with a huge message, and serves the others', async () => {
    const [rude, polite] = [open(), open()];
    await Promise.all([once(rude, 'message'), once(polite, 'message')]);
    rude.on('error', () => undefined);
    rude.send('x'.repeat(100_000));
    const [code] = (await once(rude, 'close')) as [number];
    expect(code).toBe(1009);
    const wanted = interested();
    polite.send('{"op":"subscribe","subscriptions":[{"id":1,"channelId":1}]}');
    await wanted;
    expect(server.counts.clients).toBe(1);
  });

  it('survives what is no WebSocket, and answers plain HTTP with a sentence', async () => {
    const raw = connect(listener.port, '127.0.0.1');
    raw.on('error', () => undefined);
    raw.write(Uint8Array.from({ length: 4000 }, (_, i) => (i * 7919) & 0xff));
    raw.resume();
    await once(raw, 'close');
    const response = await fetch(`http://127.0.0.1:${listener.port}/`);
    expect(response.status).toBe(426);
    expect(await response.text()).toContain('Foxglove');
    const broken = open();
    await once(broken, 'message');
    broken.on('error', () => undefined);
    // Frames without a mask are a protocol error.
    (broken as unknown as { _socket: { write: (bytes: Uint8Array) => void } })._socket.write(
      Uint8Array.of(0x81, 0x02, 0x7b, 0x7d),
    );
    await once(broken, 'close');
    await once(open(), 'message');
  });

  it('says that the port is taken', async () => {
    const { port } = listener;
    const second = LiveListener.open(
      { host: '127.0.0.1', port, allowedOrigins: [], ownNames: [], mostClients: 1 },
      server,
    );
    await expect(second).rejects.toMatchObject({ code: 'EADDRINUSE' });
  });
});
