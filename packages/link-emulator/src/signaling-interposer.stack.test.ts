import { type LocalStack, LocalStack as Stack } from '@farpoint/local-stack';
import { idealProfile } from '@farpoint/network-sim';
import { afterAll, beforeAll, expect, onTestFinished, test } from 'vitest';
import { WebSocket } from 'ws';
import { SignalingInterposer } from './signaling-interposer.ts';
import { UdpLink } from './udp-link.ts';

type Json = Record<string, unknown>;

let stack: LocalStack;
beforeAll(async () => {
  stack = await Stack.start({ robots: [] });
}, 60_000);
afterAll(() => stack.stop());

class Socket {
  readonly #socket: WebSocket;
  readonly #inbox: Json[] = [];
  #wake: () => void = () => {};
  readonly closed: Promise<number>;

  constructor(url: string) {
    this.#socket = new WebSocket(url);
    this.#socket.on('message', (data) => {
      this.#inbox.push(JSON.parse(data.toString()) as Json);
      this.#wake();
    });
    this.#socket.on('error', () => {});
    this.closed = new Promise((resolve) => this.#socket.on('close', resolve));
    onTestFinished(() => this.#socket.terminate());
  }

  async send(message: unknown): Promise<void> {
    if (this.#socket.readyState === WebSocket.CONNECTING) {
      await new Promise((resolve) => this.#socket.once('open', resolve));
    }
    this.#socket.send(typeof message === 'string' ? message : JSON.stringify(message));
  }

  /** The next message of a type; skips others. */
  async until(type: string): Promise<Json> {
    for (;;) {
      const message = this.#inbox.shift();
      if (message?.type === type) return message;
      if (message === undefined) {
        await new Promise<void>((resolve) => {
          this.#wake = resolve;
        });
      }
    }
  }
}

async function interpose(peers: 'farpoint' | 'reference-robots' | 'reference-clients', upstreamPort: number) {
  const link = new UdpLink({ up: { profile: idealProfile }, down: { profile: idealProfile }, seed: 1 });
  const faults: string[] = [];
  const interposer = await SignalingInterposer.open({
    link,
    upstream: `ws://127.0.0.1:${upstreamPort}`,
    host: '127.0.0.1',
    port: 0,
    peers,
    events: { onFault: (side, fault) => faults.push(`${side} ${fault}`) },
  });
  onTestFinished(() => link.close());
  onTestFinished(() => interposer.close());
  return { link, faults, url: `ws://127.0.0.1:${interposer.port}` };
}

const candidateOf = (port: number) => `candidate:1 1 udp 2130706431 127.0.0.1 ${port} typ host`;
const candidate = (port: number) => ({ candidate: candidateOf(port), sdpMid: '0', sdpMLineIndex: 0 });

test('with the robot behind it, the real service introduces peers that learn only stand-ins', async () => {
  const { link, faults, url } = await interpose('farpoint', stack.ports.signaling);
  const robot = new Socket(`${url}/robot`);
  await robot.send({ type: 'robot.hello', protocol: 1, id: 'r1', name: 'R', key: 'k1' });
  expect(await robot.until('robot.welcome')).toEqual({ type: 'robot.welcome', id: 'r1', iceServers: [] });
  const operator = new Socket(`${stack.signalingUrl}/operator`);
  await operator.send({ type: 'operator.hello', protocol: 1, name: 'Ada' });
  await operator.send({ type: 'session.open', robotId: 'r1' });
  const { session } = await robot.until('session.request');

  const sdp = `v=0\r\nm=audio 9 UDP/TLS/RTP/SAVPF 96\r\na=${candidateOf(41_001)}\r\n`;
  await robot.send({ type: 'session.offer', session, sdp });
  await robot.send({ type: 'session.candidate', session, candidate: candidate(41_002) });
  const place = (side: 'robot' | 'operator', port: number) => {
    const found = link.standIn(side, { address: '127.0.0.1', port });
    return found === null ? 'none' : candidateOf(found.port);
  };
  const offer = await operator.until('session.offer');
  expect(offer).toEqual({
    type: 'session.offer',
    session,
    sdp: `v=0\r\nm=audio 9 UDP/TLS/RTP/SAVPF 96\r\na=${place('robot', 41_001)}\r\n`,
  });
  expect(await operator.until('session.candidate')).toEqual({
    type: 'session.candidate',
    session,
    candidate: { ...candidate(41_002), candidate: place('robot', 41_002) },
  });

  await operator.send({ type: 'session.answer', session, sdp: 'v=0\r\n' });
  const hidden = candidateOf(41_003).replace('127.0.0.1', 'abc.local');
  await operator.send({
    type: 'session.candidate',
    session,
    candidate: { ...candidate(1), candidate: hidden },
  });
  await operator.send({ type: 'session.candidate', session, candidate: candidate(41_004) });
  expect(await robot.until('session.answer')).toEqual({ type: 'session.answer', session, sdp: 'v=0\r\n' });
  expect(await robot.until('session.candidate')).toMatchObject({
    candidate: { candidate: place('operator', 41_004) },
  });
  expect(faults).toEqual(['operator mdns']);

  // A later offer brings new candidates: an ICE restart.
  await robot.send({ type: 'session.offer', session, sdp: sdp.replace('41001', '41005') });
  expect((await operator.until('session.offer')).sdp).toContain(place('robot', 41_005));

  // An invalid message reaches the service, and the service's answer comes back.
  await robot.send('nonsense');
  expect(await robot.until('error')).toMatchObject({ code: 'malformed' });
});

test('with both peers behind it, candidates are replaced only once', async () => {
  const { link, url } = await interpose('farpoint', stack.ports.signaling);
  const robot = new Socket(`${url}/robot`);
  await robot.send({ type: 'robot.hello', protocol: 1, id: 'r2', name: 'R', key: 'k1' });
  await robot.until('robot.welcome');
  const operator = new Socket(`${url}/operator`);
  await operator.send({ type: 'operator.hello', protocol: 1, name: 'Ada' });
  await operator.send({ type: 'session.open', robotId: 'r2' });
  const { session } = await robot.until('session.request');
  await robot.send({ type: 'session.candidate', session, candidate: candidate(41_010) });
  const led = await operator.until('session.candidate');
  const { port } = link.standIn('robot', { address: '127.0.0.1', port: 41_010 }) ?? { port: 0 };
  expect(led).toMatchObject({ candidate: candidate(port) });
  expect(link.ports).toBe(1);
});

test("the reference system's robots and clients", async () => {
  const { link, url } = await interpose('reference-robots', stack.ports.referenceRobot);
  const robot = new Socket(`${url}/any/path`);
  await robot.send({ type: 'register', name: 'Diane', sdpOffer: `v=0\r\na=${candidateOf(41_020)}\r\n` });
  const { robotId } = await robot.until('registered');
  await robot.send({ type: 'candidate', robotId, candidate: candidateOf(41_021) });
  const client = new Socket(`ws://127.0.0.1:${stack.ports.referenceClient}/`);
  await client.send({ type: 'getRobots' });
  const { robots } = (await client.until('robots')) as { robots: { sdpOffer: string }[] };
  const { port } = link.standIn('robot', { address: '127.0.0.1', port: 41_020 }) ?? { port: 0 };
  expect(robots[0]?.sdpOffer).toBe(`v=0\r\na=${candidateOf(port)}\r\n`);
  await client.send({ type: 'candidate', robotId, candidate: candidateOf(41_022) });
  const led = await robot.until('candidate');
  const { port: operatorPort } = link.standIn('operator', { address: '127.0.0.1', port: 41_022 }) ?? {
    port: 0,
  };
  expect(led).toEqual({ type: 'candidate', candidate: candidateOf(operatorPort) });
});

test('an unreachable service looks unreachable', async () => {
  const { url } = await interpose('farpoint', 9);
  const robot = new Socket(`${url}/robot`);
  expect(await robot.closed).toBe(1006);
});
