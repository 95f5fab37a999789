/** The doctor's probes, against real servers. */
import { createHmac } from 'node:crypto';
import { createSocket, type Socket } from 'node:dgram';
import { readFileSync, writeFileSync } from 'node:fs';
import { createServer as createHttpsServer } from 'node:https';
import { type AddressInfo, createServer } from 'node:net';
import { join } from 'node:path';
import { freePorts, hasTurnServer, LocalStack, TURN_REMEDY, TurnServer } from '@farpoint/local-stack';
import { Secret } from '@farpoint/service';
import { testFolder, useFolder } from '@farpoint/service/testing/folder';
import { selfSigned } from '@farpoint/service/testing/self-signed';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { WebSocketServer } from 'ws';
import { checkTimeOfDay } from './check-clock.ts';
import { judgeIce } from './check-ice.ts';
import { judgeSignaling } from './check-signaling.ts';
import { iceTargets, probeIce } from './ice-probe.ts';
import { findRunningRobot, judgeRunning } from './running-robot.ts';
import { askTime, probeSignaling } from './signaling-probe.ts';

const now = () => performance.now();
const SOON_MS = 300;
const LONG_MS = 20_000;

describe('a real signaling service', () => {
  const folder = useFolder();
  let stack: LocalStack;
  beforeAll(async () => {
    const tokens = join(folder, 'tokens.yaml');
    writeFileSync(tokens, 'rover-1: the-token\nrobot-2: other\n');
    stack = await LocalStack.start({
      signalingArgs: ['--robot-tokens', tokens, '--ice-servers', '[{"urls":"stun:127.0.0.1:9"}]'],
      robots: [{ id: 'robot-2', name: 'Two', args: ['--sim-size', '16', '--token', 'other'] }],
    });
  }, 60_000);
  afterAll(async () => {
    await stack?.stop();
  });

  const probe = (id: string, token: string | null) =>
    probeSignaling(
      {
        url: stack.signalingUrl,
        id,
        name: 'Rover',
        token: token === null ? null : new Secret(token),
        ca: null,
      },
      LONG_MS,
      now,
    );

  it.each([['wrong'], [null]])('refuses the token %s', async (token) => {
    const answer = await probe('rover-1', token);
    expect(answer).toMatchObject({ outcome: 'refused', code: 'unauthorized' });
    const [result] = judgeSignaling(stack.signalingUrl, 'rover-1', answer, false, Date.now());
    expect(result).toMatchObject({
      verdict: 'fail',
      remedy: expect.stringContaining('FARPOINT_ROBOT_TOKEN') as string,
    });
  });

  it('keeps a robot that is registered, which is fine if it is this one', async () => {
    const answer = await probe('robot-2', 'other');
    expect(answer).toMatchObject({ outcome: 'refused', code: 'robot-id-taken' });
    expect(judgeSignaling('ws://x', 'robot-2', answer, false, Date.now())[0]?.verdict).toBe('fail');
    const { hostname, port } = new URL(stack.robotAdminUrl('robot-2'));
    const running = await findRunningRobot(hostname, Number(port), LONG_MS);
    expect(running).toMatchObject({ state: 'runs', operators: 0, healthy: true });
    expect(judgeRunning(running, hostname, Number(port))).toMatchObject([{ verdict: 'ok' }]);
    expect(judgeSignaling('ws://x', 'robot-2', answer, true, Date.now())[0]?.verdict).toBe('ok');
    const health = (await (await fetch(`${stack.robotAdminUrl('robot-2')}/healthz`)).json()) as {
      checks: { signaling: { detail: unknown } };
    };
    expect(health.checks.signaling.detail).toEqual({ registered: true });
  });

  it('is reported as unreachable when it is killed', async () => {
    const [port] = await freePorts(1);
    const url = `ws://127.0.0.1:${port}`;
    const answer = await probeSignaling({ url, id: 'r', name: 'R', token: null, ca: null }, LONG_MS, now);
    expect(answer).toMatchObject({ outcome: 'unreachable', code: 'ECONNREFUSED' });
    expect(judgeSignaling(url, 'r', answer, false, Date.now())[0]?.remedy).toContain('nothing listens there');
  });
});

describe('something else at the address of signaling', () => {
  const target = (port: number, protocol = 'ws', ca: string | null = null) => ({
    ...{ url: `${protocol}://localhost:${port}`, id: 'r', name: 'R', token: null, ca },
  });
  const closers: (() => void)[] = [];
  afterAll(() => {
    for (const close of closers) close();
  });

  it('does not block the doctor if it accepts connections and says nothing', async () => {
    const server = createServer(() => undefined).listen(0, 'localhost');
    closers.push(() => server.close());
    await new Promise((resolve) => server.once('listening', resolve));
    const { port } = server.address() as AddressInfo;
    // Without a limit of time, there would be no answer.
    expect(['silent', 'unreachable']).toContain((await probeSignaling(target(port), SOON_MS, now)).outcome);
    expect(await askTime(target(port), SOON_MS, Date.now)).toBeNull();
    expect((await findRunningRobot('127.0.0.1', port, SOON_MS)).state).not.toBe('runs');
  });

  it.each([
    ['says nothing once a WebSocket is up', () => undefined, 'silent'],
    ['speaks another protocol', (send: (text: string) => void) => send('{"hello":1}'), 'unreadable'],
  ])('that %s', async (_, greet, outcome) => {
    const server = new WebSocketServer({ port: 0, host: '127.0.0.1' });
    closers.push(() => server.close());
    server.on('connection', (socket) => greet((text) => socket.send(text)));
    await new Promise((resolve) => server.once('listening', resolve));
    const { port } = server.address() as AddressInfo;
    const answer = await probeSignaling({ ...target(port), url: `ws://127.0.0.1:${port}` }, SOON_MS, now);
    expect(answer.outcome).toBe(outcome);
    expect(judgeSignaling('ws://x', 'r', answer, false, Date.now())[0]?.verdict).toBe('fail');
  });

  it('is named if its certificate is not trusted, and accepted with tlsCa', async () => {
    const folder = testFolder();
    const { key, cert } = selfSigned(folder, 'localhost');
    const server = createHttpsServer({ key: readFileSync(key), cert: readFileSync(cert) }, (_, response) =>
      response.writeHead(404).end(),
    ).listen(0, 'localhost');
    closers.push(() => server.close());
    await new Promise((resolve) => server.once('listening', resolve));
    const { port } = server.address() as AddressInfo;
    const refused = await probeSignaling(target(port, 'wss'), LONG_MS, now);
    expect(judgeSignaling('wss://x', 'r', refused, false, Date.now())[0]?.remedy).toContain(
      'signaling.tlsCa',
    );
    const ca = readFileSync(cert, 'utf8');
    const other = await probeSignaling(target(port, 'wss', ca), LONG_MS, now);
    expect(judgeSignaling('wss://x', 'r', other, false, Date.now())[0]?.remedy).toContain(
      'something else answers',
    );
    expect(checkTimeOfDay(await askTime(target(port, 'wss', ca), LONG_MS, Date.now))[0]?.verdict).toBe('ok');
    const sockets = new WebSocketServer({ server });
    sockets.on('connection', (socket) =>
      socket.send(JSON.stringify({ type: 'robot.welcome', id: 'r', iceServers: [] })),
    );
    const welcome = await probeSignaling(target(port, 'wss', ca), LONG_MS, now);
    const later = (days: number) => Date.now() + days * 86_400_000;
    expect(judgeSignaling('wss://x', 'r', welcome, false, Date.now())).toMatchObject([
      { verdict: 'ok' },
      { verdict: 'warn', detail: 'its certificate expires in 1 days' },
    ]);
    expect(judgeSignaling('wss://x', 'r', welcome, false, later(-20))).toMatchObject([{ verdict: 'ok' }]);
    sockets.close();
    const plain = await probeSignaling(target(port, 'ws'), LONG_MS, now);
    expect(judgeSignaling('ws://x', 'r', plain, false, Date.now())[0]?.verdict).toBe('fail');
  });
});

describe.skipIf(!hasTurnServer())(`a real coturn (where missing: ${TURN_REMEDY})`, () => {
  let turn: TurnServer;
  let blackHole: Socket;
  beforeAll(async () => {
    const [port] = await freePorts(1);
    turn = new TurnServer(port as number);
    await turn.start();
    blackHole = createSocket('udp4').bind(0, '127.0.0.1');
    await new Promise((resolve) => blackHole.once('listening', resolve));
  }, 60_000);
  afterAll(async () => {
    await turn?.stop();
    blackHole?.close();
  });

  const credentials = () => {
    const username = `${Math.floor(Date.now() / 1000) + 600}:rover-1`;
    return { username, credential: createHmac('sha1', turn.secret).update(username).digest('base64') };
  };

  it('allocates an address, answers a binding request, refuses wrong credentials, and is reported when it is gone', async () => {
    const stun = `stun:${turn.address}:${turn.port}`;
    const silent = `turn:127.0.0.1:${blackHole.address().port}?transport=udp`;
    const targets = iceTargets([
      { urls: [stun, turn.url], ...credentials() },
      { urls: turn.url, username: credentials().username, credential: 'wrong' },
      { urls: silent, ...credentials() },
      { urls: `turn:${turn.address}:${turn.port}?transport=tcp`, ...credentials() },
    ]);
    const probed = await Promise.all(
      targets.map(async (target) => ({
        target,
        answer: await probeIce(
          target,
          target.url === silent || target.credential === 'wrong' ? SOON_MS : LONG_MS,
          now,
        ),
      })),
    );
    expect(probed.map(({ answer }) => answer)).toMatchObject([
      { outcome: 'answered', mapped: expect.stringContaining(turn.address) as string, relayed: null },
      { outcome: 'answered', relayed: expect.stringContaining(`${turn.address}:`) as string },
      { outcome: 'refused', status: 401 },
      { outcome: 'silent' },
      { outcome: 'refused', status: null },
    ]);
    const results = judgeIce(probed, 'relay');
    expect(results.map(({ verdict }) => verdict)).toEqual(['ok', 'ok', 'fail', 'fail', 'fail', 'warn', 'ok']);
    expect(results[2]?.remedy).toContain('turnSecret');
    await turn.stop();
    const gone = { target: targets[1]!, answer: await probeIce(targets[1]!, SOON_MS, now) };
    expect(judgeIce([gone], 'relay').map(({ verdict }) => verdict)).toEqual(['fail', 'fail']);
  }, 60_000);
});

it('rejects an invalid server address', async () => {
  const [target] = iceTargets([{ urls: 'stun:' }]);
  const answer = await probeIce(target!, SOON_MS, now);
  expect(judgeIce([{ target: target!, answer }], 'all')[0]?.verdict).toBe('fail');
});
