import { once } from 'node:events';
import type { AddressInfo } from 'node:net';
import { freePorts } from '@farpoint/local-stack';
import {
  decodeJson,
  type RobotToService,
  robotToServiceCodec,
  type ServiceToRobot,
} from '@farpoint/protocol';
import { createLogger, Secret, silentLogger } from '@farpoint/service';
import { eventually } from '@farpoint/service/testing/eventually';
import { describe, expect, it, onTestFinished } from 'vitest';
import { type WebSocket, WebSocketServer } from 'ws';
import { SignalingClient } from './signaling-client.ts';

/** @param port that of a service before; a new one, that stays this test's, if absent */
async function service(port?: number) {
  const [own = 0] = port === undefined ? await freePorts(1) : [port];
  const server = new WebSocketServer({ port: own, host: '127.0.0.1' });
  await once(server, 'listening');
  const stop = async () => {
    for (const socket of server.clients) socket.terminate();
    await new Promise((resolve) => server.close(resolve));
  };
  onTestFinished(stop);
  /** The next robot that connects, with its first message. */
  const nextRobot = async (): Promise<{ socket: WebSocket; path: string; hello: RobotToService }> => {
    const [socket, request] = (await once(server, 'connection')) as [WebSocket, { url: string }];
    const [data] = (await once(socket, 'message')) as [Buffer];
    return { socket, path: request.url, hello: decodeJson(robotToServiceCodec, data.toString()) };
  };
  return { port: (server.address() as AddressInfo).port, nextRobot, stop };
}

function client(port: number, token: string | null = null, log = silentLogger(), base = '') {
  const url = `ws://127.0.0.1:${port}${base}`;
  const options = { url, id: 'r1', name: 'Robot', key: new Secret('k1'), ca: null };
  const shown = token === null ? null : new Secret(token);
  const made = new SignalingClient({ ...options, token: shown }, log);
  onTestFinished(() => made.close());
  return made;
}

const welcome = JSON.stringify({ type: 'robot.welcome', id: 'r1', iceServers: [] } satisfies ServiceToRobot);

describe('SignalingClient', () => {
  it('introduces itself below a path, and is registered once welcomed', async () => {
    const { port, nextRobot } = await service();
    const robot = client(port, 'secret', silentLogger(), '/base/');
    const messages: ServiceToRobot[] = [];
    const welcomed = new Promise<void>((resolve) => {
      robot.onMessage = (message) => {
        messages.push(message);
        resolve();
      };
    });
    const called = nextRobot();
    robot.start();
    const { socket, path, hello } = await called;
    expect(path).toBe('/base/robot');
    expect(hello).toEqual({
      type: 'robot.hello',
      protocol: 1,
      id: 'r1',
      name: 'Robot',
      key: 'k1',
      token: 'secret',
    });
    expect(robot.send({ type: 'session.close', session: 's' })).toBe(false);
    socket.send(welcome);
    await welcomed;
    expect(robot.registered).toBe(true);
    const said = once(socket, 'message');
    expect(robot.send({ type: 'session.close', session: 's' })).toBe(true);
    expect(JSON.parse(String((await said)[0]))).toEqual({ type: 'session.close', session: 's' });
  });

  it('reports once that the service is missing, connects when it is there, and reports once more when it is gone again', async () => {
    const first = await service();
    const warnings: string[] = [];
    const stream = { write: (line: string) => void warnings.push(line) };
    const log = createLogger({ name: 'robot', level: 'warn', format: 'json', stream });
    const robot = client(first.port, null, log);
    await first.stop();
    robot.start();
    await eventually(() => robot.disconnects >= 3);
    expect(warnings.length).toBe(1);
    const second = await service(first.port);
    const { socket, hello } = await second.nextRobot();
    expect(hello).toMatchObject({ type: 'robot.hello', key: 'k1' });
    const welcomed = new Promise<void>((resolve) => (robot.onMessage = () => resolve()));
    socket.send(welcome);
    await welcomed;
    const before = robot.disconnects;
    await second.stop();
    await eventually(() => robot.disconnects >= before + 2);
    expect(warnings.length).toBe(2);
  });

  it('checks a doubtful connection, and replaces one that does not answer within 2 s', async () => {
    const deaf = new WebSocketServer({ port: 0, host: '127.0.0.1', autoPong: false });
    await once(deaf, 'listening');
    onTestFinished(() => {
      for (const socket of deaf.clients) socket.terminate();
      deaf.close();
    });
    const robot = client((deaf.address() as AddressInfo).port);
    const called = once(deaf, 'connection');
    robot.start();
    const [socket] = (await called) as [WebSocket];
    await once(socket, 'ping');
    socket.pong();
    let asked = false;
    socket.once('ping', () => {
      asked = true;
    });
    const hasAsked = () => {
      robot.check();
      return asked;
    };
    await eventually(hasAsked);
    // This connection gets no answer.
    const [again] = (await once(deaf, 'connection')) as [WebSocket];
    expect(again).not.toBe(socket);
    expect(robot.disconnects).toBe(1);
  });

  it('limits its checks, because the service would disconnect it otherwise', async () => {
    const { port, nextRobot } = await service();
    const robot = client(port);
    const called = nextRobot();
    robot.start();
    const { socket } = await called;
    let pings = 0;
    socket.on('ping', () => pings++);
    socket.send(welcome);
    const start = performance.now();
    for (let i = 0; i < 300; i++) {
      robot.check();
      // A round trip: the ping of this turn, if there was one, has arrived.
      const back = once(socket, 'pong');
      socket.ping();
      await back;
    }
    expect(pings).toBeLessThanOrEqual(2 + (performance.now() - start) / 500);
  });

  it('tells no more of its status to a service that does not know it', async () => {
    const { port, nextRobot } = await service();
    const robot = client(port);
    const heard: string[] = [];
    const called = nextRobot();
    robot.start();
    const { socket } = await called;
    expect(robot.takesStatus).toBe(false);
    const next = () =>
      new Promise<void>((resolve) => {
        robot.onMessage = ({ type }) => {
          heard.push(type);
          resolve();
        };
      });
    const refusal = JSON.stringify({
      type: 'error',
      code: 'malformed',
      message: '',
    } satisfies ServiceToRobot);
    const welcomed = next();
    socket.send(welcome);
    await welcomed;
    // What it has refused was something else.
    const other = next();
    socket.send(refusal);
    await other;
    expect(robot.takesStatus).toBe(true);
    const status = {
      state: 'free',
      sinceMs: 0,
      operators: 0,
      watchers: 0,
      maxOperators: 4,
      alarms: 0,
    } as const;
    expect(robot.send({ type: 'robot.status', status })).toBe(true);
    const refused = next();
    socket.send(refusal);
    await refused;
    expect(robot.takesStatus).toBe(false);
    expect([robot.registrations, heard]).toEqual([1, ['robot.welcome', 'error', 'error']]);
  });

  it('counts unreadable messages and goes on', async () => {
    const { port, nextRobot } = await service();
    const robot = client(port);
    const welcomed = new Promise<void>((resolve) => {
      robot.onMessage = () => resolve();
    });
    const called = nextRobot();
    robot.start();
    const { socket } = await called;
    for (const bad of ['', 'null', '{"type":"session.offer"}', '[1]']) socket.send(bad);
    socket.send(Buffer.of(0xff, 0xfe));
    socket.send(welcome);
    await welcomed;
    expect(robot.malformed).toBe(5);
    expect(robot.registered).toBe(true);
  });
});
