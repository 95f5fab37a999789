import { connect } from 'node:net';
import fc from 'fast-check';
import { afterEach, beforeEach, expect, test } from 'vitest';
import { TestService, type TestSocket } from './test-sockets.ts';
import {
  hostileFrames,
  hostileHandshakes,
  hostileTexts,
  hugeTexts,
  protocolMessages,
} from './testing/hostile-messages.ts';

let service: TestService;
let robot: TestSocket;
let operator: TestSocket;
let client: TestSocket;
let referenceRobot: TestSocket;

beforeEach(async () => {
  service = await TestService.start({
    maxFaults: 3,
    maxConnections: 100_000,
    maxConnectionsPerAddress: 100_000,
  });
  robot = await service.robot('bystander');
  operator = await service.operator();
  client = await service.referenceClient();
  referenceRobot = await service.referenceRobot();
  await referenceRobot.until('registered');
  await client.until('register');
});
afterEach(() => service.stop());

/** Well-behaved peers must notice nothing. */
async function expectBystandersWell(): Promise<void> {
  await service.expectSession(robot, 'bystander', operator);
  referenceRobot.send({ type: 'candidate', robotId: 0, candidate: 'candidate:well' });
  expect(await client.until('candidate')).toMatchObject({ robotId: 0, candidate: 'candidate:well' });
  expect((await fetch(service.http('/healthz'))).status).toBe(200);
}

const doors = [
  ['/robot', 'signaling'],
  ['/operator', 'signaling'],
  ['/', 'referenceRobot'],
  ['/', 'referenceClient'],
] as const;

/**
 * Sends each message on sockets of its own, to one endpoint after the other, until the service closes them or all are
 * sent.
 */
async function attack(messages: readonly (string | Uint8Array)[], hello: boolean): Promise<void> {
  for (const [path, port] of doors) {
    const socket = await service.open(service.url(path, port));
    if (hello && path === '/robot')
      socket.send({ type: 'robot.hello', protocol: 1, id: 'evil', name: 'e', key: 'k' });
    if (hello && path === '/operator') socket.send({ type: 'operator.hello', protocol: 1, name: 'e' });
    for (const message of messages) socket.socket.send(message);
    // The ping is processed in order, after everything else: either a pong arrives, or the socket is closed by then.
    const answered = new Promise<void>((resolve) => socket.socket.once('pong', () => resolve()));
    if (socket.socket.readyState === socket.socket.OPEN) socket.socket.ping();
    await Promise.race([answered, socket.closed]);
    socket.socket.terminate();
  }
}

/** A message of the protocol with one value replaced or removed, or one byte of its text changed. */
const mutated = fc.oneof(
  fc
    .tuple(fc.constantFrom(...protocolMessages), fc.nat(), fc.anything({ maxDepth: 2 }))
    .map(([message, at, value]) => {
      const keys = Object.keys(message);
      return JSON.stringify({ ...message, [keys[at % keys.length]!]: value }) as string;
    }),
  fc
    .tuple(fc.constantFrom(...protocolMessages), fc.nat(), fc.integer({ min: 32, max: 126 }))
    .map(([message, at, code]) => {
      const text = JSON.stringify(message);
      const index = at % text.length;
      return text.slice(0, index) + String.fromCharCode(code) + text.slice(index + 1);
    }),
);

test('random bytes and text, and damaged messages of the protocol', async () => {
  const rubbish = fc.oneof(fc.uint8Array({ maxLength: 300 }), fc.string({ maxLength: 300 }));
  for (const [kind, seed, numRuns] of [[rubbish, 11, 40] as const, [mutated, 12, 60] as const])
    await fc.assert(
      fc.asyncProperty(fc.array<string | Uint8Array>(kind, { maxLength: 8 }), fc.boolean(), attack),
      { seed, numRuns },
    );
  await expectBystandersWell();
});

test('inputs that have crashed such services before', async () => {
  await attack(hostileTexts, true);
  for (const text of hugeTexts) await attack([text], true);
  await attack([new Uint8Array(60_000).fill(0xff)], false);
  await expectBystandersWell();
});

test('messages above the limit are refused; far above it, the socket is closed with 1009', async () => {
  const long = await service.operator();
  await long.until('robots');
  long.socket.send('x'.repeat(70_000));
  expect(await long.next()).toMatchObject({ code: 'too-large' });
  long.socket.send('x'.repeat(1_000_000));
  expect((await long.closed).code).toBe(1009);
  await expectBystandersWell();
});

test('text that is not UTF-8 and frames that break RFC 6455 close the socket', async () => {
  for (const { bytes, code } of hostileFrames) {
    const socket = await service.operator();
    const { _socket } = socket.socket as unknown as { _socket: import('node:net').Socket };
    _socket.write(Uint8Array.from(bytes));
    expect((await socket.closed).code).toBe(code);
  }
  await expectBystandersWell();
});

test('an incomplete or wrong handshake harms nobody', async () => {
  for (const request of hostileHandshakes) {
    const socket = connect(service.service.ports.signaling, '127.0.0.1');
    socket.write(request);
    let answer = '';
    for await (const chunk of socket) answer += String(chunk);
    expect(answer).toMatch(/^HTTP\/1\.1 4\d\d /);
  }
  connect(service.service.ports.referenceRobot!, '127.0.0.1').end('GET / HT');
  await expectBystandersWell();
});

test('silent connections of one address leave room for the others', async () => {
  const small = await TestService.start({
    publicMetrics: true,
    maxConnections: 16,
    maxConnectionsPerAddress: 8,
  });
  const { signaling: port } = small.service.ports;
  // More than the port takes in all: 16 and 256 in reserve.
  const silent = Array.from({ length: 400 }, () =>
    connect({ port, host: '127.0.0.1', localAddress: '127.0.0.9' }),
  );
  const closed = silent.map(
    (socket) => new Promise((resolve) => socket.on('error', () => {}).on('close', resolve)),
  );
  // All but 8 and 64 in reserve are closed at once.
  await Promise.all(closed.map((one, n) => (n < 72 ? null : one)));
  const other = await small.robot('other');
  await small.expectSession(other, 'other', await small.operator());
  const metrics = await (await fetch(small.http('/metrics'))).text();
  expect(metrics).toMatch(/rejects_total\{role="operator",reason="too-many-sockets"\} 328/);
  for (const socket of silent) socket.destroy();
  await small.stop();
});

test('a flood of pings whose answers are not read is cut off', async () => {
  const socket = await service.operator();
  for (let i = 0; i < 60; i++) socket.socket.ping();
  await socket.closed;
  await expectBystandersWell();
});
