import { mkdirSync, writeFileSync } from 'node:fs';
import { request } from 'node:http';
import { connect } from 'node:net';
import { join } from 'node:path';
import { brotliCompressSync, gzipSync } from 'node:zlib';
import { createMetrics, Health, Secret } from '@farpoint/service';
import { useFolder } from '@farpoint/service/testing/folder';
import { selfSigned } from '@farpoint/service/testing/self-signed';
import { afterEach, describe, expect, test } from 'vitest';
import type { SignalingOptions } from './options.ts';
import type { SignalingRim } from './server.ts';
import { TestService } from './test-sockets.ts';

const folder = useFolder();

let service: TestService;
afterEach(async () => {
  await service?.stop();
});

async function start(options: Partial<SignalingOptions> = {}, rim: SignalingRim = {}): Promise<TestService> {
  service = await TestService.start(options, rim);
  return service;
}

function file(name: string, content: string): string {
  const path = join(folder, name);
  writeFileSync(path, content);
  return path;
}

describe('Farpoint over real sockets', () => {
  test('runs a session from listing to close', async () => {
    await start();
    const operator = await service.operator();
    expect(await operator.next()).toEqual({ type: 'robots', robots: [] });
    const robot = await service.robot('r1');
    expect(await operator.next()).toEqual({
      type: 'robots.changed',
      here: [{ id: 'r1', name: 'Robot r1' }],
      gone: [],
    });
    await service.expectSession(robot, 'r1', operator);
    robot.socket.terminate();
    expect(await operator.next()).toEqual({ type: 'robots.changed', here: [], gone: ['r1'] });
  });

  test('closes a socket that sends nothing', async () => {
    await start({ helloTimeoutMs: 20 });
    const mute = await service.open(service.url('/operator'));
    expect(await mute.next()).toMatchObject({ code: 'hello-first' });
    expect((await mute.closed).code).toBe(1008);
  });

  test('frees the id of a socket that does not answer pings', async () => {
    await start({ heartbeatMs: 100 });
    const operator = await service.operator();
    await operator.next();
    const robot = await service.robot('r1');
    await operator.until('robots.changed');
    // As after a lost link: the connection is open, but nothing is read from it.
    robot.socket.pause();
    expect(await operator.until('robots.changed')).toEqual({
      type: 'robots.changed',
      here: [],
      gone: ['r1'],
    });
  });

  test('disconnects a peer that does not read, and only that one', async () => {
    const metrics = createMetrics();
    await start(
      { maxBacklogBytes: 65_536, messagesPerSecond: 1e6, messageBurst: 1e6, relayBytesPerSecond: 1e9 },
      { metrics },
    );
    const robot = await service.robot('r1');
    const other = await service.operator();
    const stuck = await service.operator();
    stuck.send({ type: 'session.open', robotId: 'r1' });
    const { session } = await stuck.until('session.opened');
    await robot.until('session.request');
    stuck.socket.pause();
    const offer = JSON.stringify({ type: 'session.offer', session, sdp: 'x'.repeat(50_000) });
    const gone = robot.until('session.closed');
    let waiting = true;
    void gone.then(() => {
      waiting = false;
    });
    while (waiting)
      await new Promise<void>((resolve) => robot.socket.send(offer, () => setImmediate(resolve)));
    expect(await gone).toMatchObject({ reason: 'operator-left' });
    expect(await metrics.metrics()).toContain('rejects_total{role="operator",reason="slow-consumer"} 1');
    await service.expectSession(robot, 'r1', other);
  });
});

describe('the reference protocol over real sockets', () => {
  test('robot 0, on any path: register, trickle, answer, re-offer, leave', async () => {
    await start();
    const client = await service.referenceClient();
    client.send({ type: 'getRobots' });
    expect(await client.next()).toEqual({ type: 'robots', robots: [] });
    const robot = await service.referenceRobot();
    expect(await robot.next()).toEqual({ type: 'registered', robotId: 0 });
    expect(await client.next()).toMatchObject({
      type: 'register',
      robot: { id: 0, name: 'Diane', sdpOffer: 'v=0' },
    });
    robot.send({ type: 'candidate', robotId: 0, candidate: 'candidate:1' });
    expect(await client.next()).toEqual({ type: 'candidate', robotId: 0, candidate: 'candidate:1' });
    client.send({ type: 'answer', robotId: 0, sdpAnswer: 'yes' });
    client.send({ type: 'candidate', robotId: 0, candidate: 'candidate:2' });
    expect(await robot.next()).toEqual({ type: 'sdpAnswer', sdpAnswer: 'yes' });
    expect(await robot.next()).toEqual({ type: 'candidate', candidate: 'candidate:2' });
    robot.send({ type: 'offer', robotId: 0, sdpOffer: 'again' });
    expect(await client.next()).toEqual({ type: 'offer', robotId: 0, sdpOffer: 'again' });
    robot.socket.close();
    expect(await client.next()).toEqual({ type: 'deregistered', robotId: 0 });
  });

  test('can be left out', async () => {
    await start({ reference: false });
    expect(service.service.ports).toMatchObject({ referenceRobot: null, referenceClient: null });
  });
});

describe('tokens', () => {
  const robotTokens = file('robots.yaml', 'r1: token-of-r1\n');
  const operatorTokens = file('operators.txt', 'operator-token\n');

  test('are required on every port', async () => {
    await start({ robotTokens, operatorTokens });
    const robot = await service.robot('r1', { token: 'token-of-r1' });
    await service.expectSession(robot, 'r1', await service.operator({ token: 'operator-token' }));
    for (const port of ['referenceRobot', 'referenceClient'] as const) {
      await expect(service.open(service.url('/', port))).rejects.toThrow('401');
      await expect(service.open(service.url('/?token=wrong', port))).rejects.toThrow('401');
    }
    const client = await service.open(service.url('/?token=operator-token', 'referenceClient'));
    const referenceRobot = await service.open(service.url('/x?token=token-of-r1', 'referenceRobot'));
    referenceRobot.send({ type: 'register', name: 'Diane', sdpOffer: 'v=0' });
    await client.until('register');
  });

  test('are not required on the reference ports if those are declared open', async () => {
    await start({ robotTokens, operatorTokens, referenceOpen: true });
    await service.referenceClient();
    expect(await (await service.referenceRobot()).next()).toEqual({ type: 'registered', robotId: 0 });
  });

  test('are read again at reload; a broken file leaves the old ones in force', async () => {
    const path = file('changing.txt', 'first-token');
    await start({ operatorTokens: path });
    file('changing.txt', 'second-token');
    service.service.reload();
    await service.operator({ token: 'second-token' });
    file('changing.txt', '');
    expect(() => service.service.reload()).toThrow('--operator-tokens names a file that is empty: ');
    await service.operator({ token: 'second-token' });
  });
});

/** What the service answers under a name. `fetch` sets its own. */
function ask(port: number, path: string, host: string): Promise<{ status: number; text: string }> {
  return new Promise((resolve, reject) => {
    request({ port, path, host: '127.0.0.1', headers: { host } }, (response) => {
      let text = '';
      response.setEncoding('utf8').on('data', (part: string) => {
        text += part;
      });
      response.on('end', () => resolve({ status: response.statusCode ?? 0, text }));
    })
      .on('error', reject)
      .end();
  });
}

describe('admission', () => {
  test('refuses unknown paths, foreign origins, and too many connections from one address', async () => {
    await start({ allowedOrigins: ['https://teleop.example'], maxConnectionsPerAddress: 2 });
    await expect(service.open(service.url('/'))).rejects.toThrow('404');
    const from = (origin: string) => service.open(service.url('/operator'), { origin });
    await expect(from('https://evil.example')).rejects.toThrow('403');
    const first = await from('https://teleop.example');
    await service.robot('r1');
    await expect(service.open(service.url('/robot'))).rejects.toThrow('429');
    first.socket.close();
    await first.closed;
    await service.operator();
  });

  test('by default, lets in no page of another site, and none of a name that only points here', async () => {
    await start();
    const from = (origin: string, host?: string) =>
      service.open(service.url('/operator'), { origin, headers: host === undefined ? {} : { host } });
    await expect(from('https://evil.example')).rejects.toThrow('403');
    await expect(from('http://evil.example', 'evil.example')).rejects.toThrow('403');
    await expect(
      service.open(service.url('/x', 'referenceClient'), { origin: 'https://evil.example' }),
    ).rejects.toThrow('403');
    await from('http://localhost:517');
    await from(service.http('').replace(/\/$/, ''));
    await service.operator();
  });

  test('open to the network, is no part of a site whose name was let point here', async () => {
    await start({ host: '0.0.0.0', open: true, publicNames: ['teleop.example'] });
    const { signaling: port } = service.service.ports;
    const from = (name: string) =>
      service.open(service.url('/operator'), {
        origin: `http://${name}:${port}`,
        headers: { host: `${name}:${port}` },
      });
    await expect(from('evil.example')).rejects.toThrow('421');
    await from('teleop.example');
    await from('127.0.0.1');
    const page = async (name: string, path = '/') => {
      const answer = await ask(port, path, `${name}:${port}`);
      return [answer.status, answer.text.includes('--public-names')];
    };
    for (const path of ['/', '/healthz', '/metrics'])
      expect(await page('evil.example', path)).toEqual([421, true]);
    expect(await page('teleop.example', '/healthz')).toEqual([200, false]);
    expect(await page('192.0.2.1', '/healthz')).toEqual([200, false]);
    // A robot is no browser, and may know the service by any name.
    await service.open(service.url('/robot'), { headers: { host: 'evil.example' } });
  });

  test('does not start open to the network by mistake', async () => {
    await expect(TestService.start({ host: '0.0.0.0' })).rejects.toThrow(
      /^--host lets everybody in .*--robot-tokens and --operator-tokens, or --open/,
    );
    await start({ host: '0.0.0.0', open: true });
    await service.operator();
  });

  test('refuses too many connections in total', async () => {
    await start({ maxConnections: 1 });
    await service.robot('r1');
    await expect(service.referenceClient()).rejects.toThrow('503');
    expect((await fetch(service.http('/healthz'))).status).toBe(503);
  });

  /** An operator for whom a proxy says this. */
  const via = (forwarded: string) =>
    service.open(service.url('/operator'), { headers: { 'x-forwarded-for': forwarded } });

  test('uses the addresses that the proxy saw', async () => {
    await start({ maxConnectionsPerAddress: 1, trustProxy: ['loopback'], open: true });
    await via('203.0.113.9, 192.0.2.1');
    await expect(via('203.0.113.8, 192.0.2.1')).rejects.toThrow('429');
    await via('192.0.2.2');
    // Some gateways add the port, which is another for each connection.
    await via('203.0.113.10:4711');
    await expect(via('203.0.113.10:4712')).rejects.toThrow('429');
    await via('[2001:db8::1]:443');
    await expect(via('[2001:db8:0:0::2]:444')).rejects.toThrow('429');
  });

  test('takes nobody’s word for an address but a named proxy’s', async () => {
    await start({ maxConnectionsPerAddress: 1, trustProxy: ['192.0.2.1'], open: true });
    await via('203.0.113.9');
    await expect(via('203.0.113.10')).rejects.toThrow('429');
  });

  test('fails on a port in use, and leaves nothing open', async () => {
    await start();
    const { signaling } = service.service.ports;
    await expect(TestService.start({ referenceClientPort: signaling })).rejects.toThrow('EADDRINUSE');
  });
});

describe('HTTP', () => {
  test('reports health and metrics', async () => {
    const metrics = createMetrics();
    const health = new Health();
    await start({ publicMetrics: true }, { metrics, health });
    const robot = await service.robot('r1');
    await service.expectSession(robot, 'r1', await service.operator());
    await service.referenceRobot();
    const response = await fetch(service.http('/healthz'));
    expect([response.status, await response.json()]).toEqual([
      200,
      expect.objectContaining({
        status: 'ok',
        checks: {
          connections: { ok: true, detail: expect.objectContaining({ robots: 1, operator: 1, robot: 1 }) },
        },
      }),
    ]);
    const text = await (await fetch(service.http('/metrics'))).text();
    for (const line of [
      'farpoint_signaling_connections{role="operator"} 1',
      'farpoint_signaling_robots{protocol="farpoint"} 1',
      'farpoint_signaling_sessions 0',
      'farpoint_signaling_sessions_total 1',
      'farpoint_signaling_session_ends_total{reason="closed-by-operator"} 1',
      'farpoint_signaling_relays_total{type="session.offer"} 1',
      'farpoint_signaling_relay_seconds_count 2',
    ]) {
      expect(text).toContain(`${line}\n`);
    }
  });

  test('tells strangers no more than that it is well, also those whose proxy says nothing of them', async () => {
    const get = async (path: string, headers = {}) => fetch(service.http(path), { headers });
    const status = async (headers = {}) => (await get('/metrics', headers)).status;
    await start();
    expect(await status()).toBe(404);
    expect(await status({ 'x-forwarded-for': '127.0.0.1' })).toBe(404);
    expect(await (await get('/healthz')).json()).toEqual({ status: 'ok' });
    await service.stop();
    await start({ metricsToken: new Secret('a-token-of-some-length') });
    expect(await status({ authorization: 'Bearer a-token-of-some-lengtH' })).toBe(404);
    expect(await status()).toBe(404);
    const authorization = 'Bearer a-token-of-some-length';
    expect(await status({ authorization })).toBe(200);
    expect(await (await get('/healthz', { authorization })).json()).toHaveProperty('checks');
    await service.stop();
    await start({ publicMetrics: true });
    expect(await status({ 'x-forwarded-for': '203.0.113.9' })).toBe(200);
  });

  test('serves the web app with its headers, and nothing outside it', async () => {
    const root = join(folder, 'web');
    mkdirSync(join(root, 'assets'), { recursive: true });
    writeFileSync(join(root, 'index.html'), '<title>Farpoint</title>');
    writeFileSync(join(root, 'assets/codec-abc.wasm'), '');
    writeFileSync(join(root, 'assets/page-abc.js'), 'export {};');
    writeFileSync(join(root, 'assets/page-abc.js.br'), brotliCompressSync('export {};'));
    writeFileSync(join(root, 'assets/page-abc.js.gz'), gzipSync('export {};'));
    file('secret.txt', 'secret');
    const named = { connectOrigins: ['wss://janus.example:8989'], mapOrigins: ['https://tiles.example'] };
    await start({ webRoot: root, ...named });
    const page = await fetch(service.http('/'));
    expect(await page.text()).toContain('Farpoint');
    const policy = page.headers.get('content-security-policy')?.split('; ');
    expect(policy).toContain("img-src 'self' data: blob: https://tiles.example");
    // This service, bridges beside the browser, and named servers.
    expect(policy).toContain(
      "connect-src 'self' blob: data: ws://localhost:* ws://127.0.0.1:* wss://janus.example:8989",
    );
    expect(Object.fromEntries(page.headers)).toMatchObject({
      'content-type': 'text/html;charset=utf-8',
      'cache-control': 'no-cache',
      'x-content-type-options': 'nosniff',
      'cross-origin-opener-policy': 'same-origin',
      'content-security-policy': expect.stringContaining("'wasm-unsafe-eval'"),
    });
    const wasm = await fetch(service.http('/assets/codec-abc.wasm'));
    expect(wasm.headers.get('content-type')).toBe('application/wasm');
    expect(wasm.headers.get('cache-control')).toContain('immutable');
    // Compressed, for who takes it, where the build has left it so.
    for (const encoding of ['br', 'gzip', 'identity']) {
      const script = await fetch(service.http('/assets/page-abc.js'), {
        headers: { 'accept-encoding': encoding },
      });
      expect(script.headers.get('content-encoding')).toBe(encoding === 'identity' ? null : encoding);
      expect(script.headers.get('content-type')).toMatch(/^text\/javascript/);
      expect(script.headers.get('vary')).toMatch(/accept-encoding/i);
      expect(await script.text()).toBe('export {};');
    }
    for (const path of ['/nothing', '/..%2fsecret.txt', '/%2e%2e/secret.txt', '/%']) {
      expect((await fetch(service.http(path))).status).toBe(404);
    }
    expect((await fetch(service.http('/healthz'))).status).toBe(200);
  });

  test('gives a clear error for a web root without a page', async () => {
    await expect(TestService.start({ webRoot: folder })).rejects.toThrow(
      /^--web-root names a folder without index.html/,
    );
  });

  test('answers anything but HTTP with 400', async () => {
    await start();
    const socket = connect(service.service.ports.signaling, '127.0.0.1');
    socket.end('\x16\x03\x01 hello\r\n\r\n');
    let answer = '';
    for await (const chunk of socket) answer += String(chunk);
    expect(answer).toMatch(/^HTTP\/1\.1 400 /);
  });
});

test('uses TLS on every port, and a new certificate after a reload', async () => {
  const make = (name: string): { tlsCert: string; tlsKey: string } => {
    const { key: tlsKey, cert: tlsCert } = selfSigned(folder, name);
    return { tlsCert, tlsKey };
  };
  await start(make('first'));
  const insecure = { rejectUnauthorized: false };
  const subject = async (port: 'signaling' | 'referenceRobot' | 'referenceClient'): Promise<string> => {
    const { socket } = await service.open(service.url('/operator', port), insecure);
    const { _socket } = socket as unknown as { _socket: import('node:tls').TLSSocket };
    return String(_socket.getPeerCertificate().subject.CN);
  };
  for (const port of ['signaling', 'referenceRobot', 'referenceClient'] as const) {
    expect(await subject(port)).toBe('first');
  }
  make('second');
  service.service.reload();
  expect(await subject('signaling')).toBe('second');
  const { tlsCert } = make('third');
  await expect(TestService.start({ tlsCert })).rejects.toThrow('--tls-cert needs the other one');
  const noKey = { tlsCert, tlsKey: tlsCert };
  await expect(TestService.start(noKey)).rejects.toThrow('are not a PEM certificate and its key');
});

describe('shutdown', () => {
  test('tells everybody, closes with 1012 or 1001, and accepts no new connections', async () => {
    await start();
    const [robot, operator, client] = [
      await service.robot('r1'),
      await service.operator(),
      await service.referenceClient(),
    ];
    const { signaling } = service.service.ports;
    await service.service.close();
    expect(await robot.until('error')).toMatchObject({ code: 'shutting-down' });
    expect(await operator.until('error')).toMatchObject({ code: 'shutting-down' });
    expect([(await robot.closed).code, (await operator.closed).code, (await client.closed).code]).toEqual([
      1012, 1012, 1001,
    ]);
    await expect(fetch(`http://127.0.0.1:${signaling}/healthz`)).rejects.toThrow();
  });

  test('does not wait beyond the deadline for peers that do not hang up', async () => {
    await start({ shutdownMs: 20 });
    const robot = await service.robot('r1');
    robot.socket.pause();
    await expect(service.service.close()).resolves.toBeUndefined();
  });
});
