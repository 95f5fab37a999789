import { once } from 'node:events';
import { createServer as createHttpServer } from 'node:http';
import { type AddressInfo, createServer, type Server, type Socket } from 'node:net';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { RosFault } from '../fault.ts';
import { callService } from './call-service.ts';
import { SERVICE_SUMS } from './service-types.ts';
import { connectionHeader, framed, readConnectionHeader } from './service-wire.ts';

const MD5 = SERVICE_SUMS['std_srvs/Trigger'];
const text = (value: string) => new TextEncoder().encode(value);
const reply = (success: number, message: string) =>
  Uint8Array.of(1, ...framed(Uint8Array.of(success, ...framed(text(message)))));

/** What a service does once it has the caller's header, and what it does with a request. */
type Behaviour = (
  socket: Socket,
  fields: ReadonlyMap<string, string>,
) => ((request: Uint8Array) => void) | undefined;

const greet = (socket: Socket, md5sum: string = MD5) =>
  socket.write(connectionHeader({ callerid: '/base', md5sum, type: 'std_srvs/Trigger' }));

const behaviours: Record<string, Behaviour> = {
  '/dock': (socket) => {
    greet(socket);
    return () => socket.write(reply(1, 'docked'));
  },
  // One byte at a time, as a slow network may.
  '/slow': (socket) => {
    greet(socket);
    return () => {
      for (const byte of reply(0, 'no charger')) socket.write(Uint8Array.of(byte));
    };
  },
  '/raises': (socket) => {
    greet(socket);
    return () => socket.write(Uint8Array.of(0, ...framed(text('error processing request'))));
  },
  '/other': (socket) => {
    greet(socket, SERVICE_SUMS['std_srvs/Empty']);
    return undefined;
  },
  '/refuses': (socket) => {
    socket.write(connectionHeader({ error: 'md5sums do not match' }));
    return undefined;
  },
  '/hangs': (socket) => {
    greet(socket);
    return () => undefined;
  },
  '/ends': (socket) => {
    greet(socket);
    return () => socket.destroy();
  },
  '/babbles': (socket) => {
    greet(socket);
    return () => socket.write(Uint8Array.of(1, 255, 255, 255, 255));
  },
};

async function listening(server: Server): Promise<number> {
  await once(server.listen(0, '127.0.0.1'), 'listening');
  return (server.address() as AddressInfo).port;
}

describe('a call to a ROS 1 service', () => {
  const asked: [service: string, request: Uint8Array][] = [];
  const service = createServer((socket) => {
    let received = new Uint8Array();
    let onRequest: ((request: Uint8Array) => void) | undefined;
    let isGreeted = false;
    socket.on('error', () => undefined);
    socket.on('data', (chunk) => {
      received = Uint8Array.from([...received, ...chunk]);
      if (!isGreeted) {
        const header = readConnectionHeader(received);
        if (header === null) return;
        isGreeted = true;
        received = received.slice(header.length);
        const name = header.fields.get('service') ?? '';
        onRequest = behaviours[name]?.(socket, header.fields);
        const inner = onRequest;
        onRequest = (request) => {
          asked.push([name, request]);
          inner?.(request);
        };
      }
      if (received.length >= 4) onRequest?.(received);
    });
  });
  let port = 0;
  const master = createHttpServer((request, response) => {
    let body = '';
    request.on('data', (chunk) => {
      body += String(chunk);
    });
    request.on('end', () => {
      const known = Object.keys(behaviours).find((name) => body.includes(`>${name}<`));
      const values =
        known === undefined
          ? ['<int>-1</int>', '<string>no provider</string>', '<int>0</int>']
          : ['<int>1</int>', '<string>found</string>', `<string>rosrpc://127.0.0.1:${port}</string>`];
      const array = values.map((value) => `<value>${value}</value>`).join('');
      response.setHeader('content-type', 'text/xml');
      response.end(
        `<?xml version="1.0"?><methodResponse><params><param><value><array><data>${array}</data></array></value></param></params></methodResponse>`,
      );
    });
  });
  let masterUrl = '';
  beforeAll(async () => {
    port = await listening(service);
    masterUrl = `http://127.0.0.1:${await listening(master)}`;
  });
  afterAll(() => {
    service.close();
    master.close();
  });
  const call = (name: string, within = 5000) =>
    callService(
      { masterUrl, name: 'robot' },
      { service: name, type: 'std_srvs/Trigger', data: false },
      within,
    );

  it('brings the answer, whole or in pieces', async () => {
    expect(await call('/dock')).toEqual({ success: true, message: 'docked' });
    expect(await call('/slow')).toEqual({ success: false, message: 'no charger' });
    expect(asked).toContainEqual(['/dock', Uint8Array.of(0, 0, 0, 0)]);
  });

  it.each<[string, string, RegExp]>([
    ['/nobody', 'unavailable', /no provider/],
    ['/raises', 'refused', /error processing request/],
    ['/refuses', 'refused', /md5sums do not match/],
    ['/other', 'wrong-type', /no std_srvs\/Trigger/],
    ['/ends', 'lost', /ended the connection/],
    ['/babbles', 'too-large', /at most/],
  ])('to %s fails as %s', async (name, code, message) => {
    const fault = await call(name).catch((error: unknown) => error);
    expect(fault).toBeInstanceOf(RosFault);
    expect(fault).toMatchObject({ code, topic: name, message: expect.stringMatching(message) });
  });

  it('is given up after its time', async () => {
    await expect(call('/hangs', 50)).rejects.toMatchObject({ code: 'lost', what: 'no answer within 0.05 s' });
  });

  it('fails without a master', async () => {
    const nobody = callService(
      { masterUrl: 'http://127.0.0.1:1', name: 'robot' },
      { service: '/dock', type: 'std_srvs/Trigger', data: false },
      100,
    );
    await expect(nobody).rejects.toMatchObject({ code: 'unavailable' });
  });
});
