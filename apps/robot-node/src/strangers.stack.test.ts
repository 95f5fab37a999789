/** Strangers cannot disturb a session: bytes on loopback against the real robot program while somebody drives. */
import { createSocket, type Socket } from 'node:dgram';
import { on, once } from 'node:events';
import { isIPv6 } from 'node:net';
import { PROTOCOL_VERSION } from '@farpoint/protocol';
import { eventually } from '@farpoint/service/testing/eventually';
import { clientHello, closeAlert } from '@farpoint/webrtc/testing';
import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { createSelfSignedCertificate } from 'werift';
import { WebSocket } from 'ws';
import { metricOf } from './testing/metric-of.ts';
import { SignaledOperator } from './testing/signaled-operator.ts';
import { steadyHand } from './testing/steady-hand.ts';
import { useRobot } from './testing/use-robot.ts';

const ROBOT = 'sim-1';
const ARGS = ['--rate-control', 'fixed', '--sim-size', '64', '--max-points', '600', '--max-operators', '3'];

const robot = useRobot(ROBOT, ARGS);
let driver: SignaledOperator;
let stranger: Socket | null = null;
let letGo: () => void;

beforeEach(async () => {
  driver = await robot.connect();
  const lease = await driver.client.takeLease();
  // In circles, so that there is always room.
  const twist = { linear: { x: 0.1, y: 0, z: 0 }, angular: { x: 0, y: 0, z: 0.5 } };
  letGo = steadyHand(driver.client, lease, twist);
  await driver.client.until(() => driver.client.telemetry?.drive === 'driving');
}, 20_000);
afterEach(() => {
  letGo();
  stranger?.close();
  stranger = null;
});

/** The driver still has the same session and is obeyed. */
async function expectDriving(): Promise<void> {
  const { client } = driver;
  const { sequence = 0 } = client.telemetry ?? {};
  const { length } = client.completeFrames;
  await client.until(
    () =>
      (client.telemetry?.sequence ?? 0) > sequence + 5 &&
      client.completeFrames.length > length &&
      // On a busy machine, its commands may just have come late.
      client.telemetry?.drive === 'driving' &&
      Math.abs(client.telemetry.twist.angular.z) > 0.1,
  );
  expect(client.connection.connectionState).toBe('connected');
}

/** A socket that reaches the robot's address. */
async function openStranger(host: string): Promise<Socket> {
  stranger = createSocket(isIPv6(host) ? 'udp6' : 'udp4').bind(0);
  await once(stranger, 'listening');
  return stranger;
}

const metric = (name: string, labels: string) =>
  metricOf(robot.stack.robotAdminUrl(ROBOT), `farpoint_robot_${name}_total${labels}`);

async function untilMetric(name: string, labels: string, least: number): Promise<void> {
  await eventually(async () => (await metric(name, labels)) >= least);
}

const refused = (reason: string) => `{reason="${reason}"}`;
const refusedDatagram = (reason: string) => `{what="datagram",reason="${reason}"}`;

describe('strangers', { timeout: 30_000 }, () => {
  it('refuses a peer without its certificate’s key, and accepts the same peer with it', async () => {
    const signatureHash = { hash: 4, signature: 3 } as const;
    const [own, other] = await Promise.all([0, 0].map(() => createSelfSignedCertificate(signatureHash)));
    const keys = { certPem: own?.certPem ?? '', keyPem: other?.keyPem ?? '', signatureHash };
    const before = await metric('sessions_ended', refused('unproven-peer'));
    const impostor = await SignaledOperator.open(robot.stack.signalingUrl, ROBOT, { keys });
    robot.keep(impostor);
    await impostor.until((message) => message.type === 'session.closed');
    expect(await metric('sessions_ended', refused('unproven-peer'))).toBe(before + 1);
    expect(impostor.client.session).toEqual([]);
    expect(impostor.client.packets).toBe(0);

    const honest = await SignaledOperator.open(robot.stack.signalingUrl, ROBOT, {
      keys: { ...keys, keyPem: own?.keyPem ?? '' },
    });
    robot.keep(honest);
    await honest.client.ready();
    await honest.client.until(() => honest.client.completeFrames.length > 0);
    await expectDriving();
  });

  it('ignores plaintext alerts and hellos during a session, wherever they come from', async () => {
    const { connection } = driver.client.connection.iceTransports[0]!;
    const [host, port] = connection.nominated!.remoteAddr;
    const socket = await openStranger(host);
    const plain = await metric('refused', refusedDatagram('dtls-plaintext'));
    const foreign = await metric('refused', refusedDatagram('unknown-source'));
    for (const datagram of [closeAlert, clientHello()]) {
      socket.send(datagram, port, host);
      // As from somebody who forges the operator's address.
      await connection.send(datagram);
    }
    await untilMetric('refused', refusedDatagram('dtls-plaintext'), plain + 2);
    await untilMetric('refused', refusedDatagram('unknown-source'), foreign + 2);
    await expectDriving();
  });

  it('ends the session of an operator that sends 4 MB in one message, and only that one', async () => {
    const guest = await robot.connect();
    const { sctp } = guest.client.connection.sctpTransport!;
    const before = await metric('refused', refusedDatagram('message-too-large'));
    void sctp.send(guest.client.control.id, 53, Buffer.alloc(4 << 20));
    await guest.until((message) => message.type === 'session.closed');
    expect(await metric('refused', refusedDatagram('message-too-large'))).toBe(before + 1);
    await expectDriving();
  });

  it('admits an operator although unanswered requests have taken all places', async () => {
    // Three places, one of them the driver's. The operator of the test before may still be leaving.
    const operators = () => metricOf(robot.stack.robotAdminUrl(ROBOT), 'farpoint_robot_operators');
    await eventually(async () => (await operators()) <= 1);
    const idle = await Promise.all([0, 1].map(() => robot.stack.signalingUrl).map(openAndNeverAnswer));
    const ended = await metric('sessions_ended', refused('not-connected'));
    const asks = async (): Promise<SignaledOperator | null> => {
      const asker = robot.keep(await SignaledOperator.open(robot.stack.signalingUrl, ROBOT));
      await asker.until(({ type }) => type === 'session.closed' || type === 'session.offer');
      if (asker.heard.some(({ type }) => type === 'session.offer')) return asker;
      await asker.close();
      return null;
    };
    // It asks again in the page's rhythm, until one of the others has had its second: a fast machine would otherwise use
    // up all sockets of its address.
    const guest = await eventually(asks);
    await guest.client.ready();
    expect(await metric('sessions_ended', refused('not-connected'))).toBeGreaterThan(ended);
    await expectDriving();
    for (const socket of idle) socket.close();
  });
});

/** An operator that requests a session and does nothing more. Resolves once the robot has made its offer. */
async function openAndNeverAnswer(url: string): Promise<WebSocket> {
  const socket = new WebSocket(new URL('/operator', url));
  await once(socket, 'open');
  socket.send(JSON.stringify({ type: 'operator.hello', protocol: PROTOCOL_VERSION, name: 'nobody' }));
  socket.send(JSON.stringify({ type: 'session.open', robotId: ROBOT }));
  for await (const [data] of on(socket, 'message')) {
    if (JSON.parse(String(data)).type === 'session.offer') break;
  }
  return socket;
}
