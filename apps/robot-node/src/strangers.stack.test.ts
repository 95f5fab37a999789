/** Strangers cannot disturb a session: bytes on loopback against the real robot program while somebody drives. */
import { createSocket, type Socket } from 'node:dgram';
import { once } from 'node:events';
import { isIPv6 } from 'node:net';
import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { createSelfSignedCertificate, Message } from 'werift';
import { SignaledOperator } from './testing/signaled-operator.ts';
import { useRobot } from './testing/use-robot.ts';

const ROBOT = 'sim-1';
const ARGS = ['--rate-control', 'fixed', '--sim-size', '64', '--max-points', '600', '--max-operators', '3'];
/** DTLS 1.2, epoch 0: a warning that closes the session, 15 bytes. */
const PLAIN_ALERT = Buffer.from([21, 0xfe, 0xfd, 0, 0, 0, 0, 0, 0, 0, 9, 0, 2, 1, 0]);

const robot = useRobot(ROBOT, ARGS);
let driver: SignaledOperator;
let stranger: Socket | null = null;
let timer: NodeJS.Timeout;

beforeEach(async () => {
  driver = await robot.connect();
  const lease = await driver.client.takeLease();
  // In circles, so that there is always room.
  const twist = { linear: { x: 0.1, y: 0, z: 0 }, angular: { x: 0, y: 0, z: 0.5 } };
  timer = setInterval(() => driver.client.drive(lease, 0.1, { twist }), 20);
  await driver.client.until(() => driver.client.telemetry?.drive === 'driving');
}, 20_000);
afterEach(() => {
  clearInterval(timer);
  stranger?.close();
  stranger = null;
});

/** The driver still has the same session and is obeyed. */
async function expectDriving(): Promise<void> {
  const { client } = driver;
  const { sequence = 0 } = client.telemetry ?? {};
  const { length } = client.completeFrames;
  await client.until(
    () => (client.telemetry?.sequence ?? 0) > sequence + 5 && client.completeFrames.length > length,
  );
  expect(client.telemetry).toMatchObject({ drive: 'driving' });
  expect(Math.abs(client.telemetry?.twist.angular.z ?? 0)).toBeGreaterThan(0.1);
  expect(client.connection.connectionState).toBe('connected');
}

/** A socket that reaches the robot's address. */
async function openStranger(host: string): Promise<Socket> {
  stranger = createSocket(isIPv6(host) ? 'udp6' : 'udp4').bind(0);
  await once(stranger, 'listening');
  return stranger;
}

async function metric(name: string, labels = ''): Promise<number> {
  const text = await (await fetch(`${robot.stack.robotAdminUrl(ROBOT)}/metrics`)).text();
  const line = text.split('\n').find((row) => row.startsWith(`farpoint_robot_${name}_total${labels} `));
  return line === undefined ? 0 : Number(line.split(' ').at(-1));
}

async function untilMetric(name: string, labels: string, least: number): Promise<void> {
  while ((await metric(name, labels)) < least) await new Promise((resolve) => setTimeout(resolve, 20));
}

const refused = (reason: string) => `{reason="${reason}"}`;

/** A ClientHello that would begin another handshake. */
function clientHello(): Buffer {
  const body = [0xfe, 0xfd, ...new Array(32).fill(7), 0, 0, 0, 2, 0xc0, 0x2b, 1, 0, ...new Array(38).fill(0)];
  const handshake = [1, 0, 0, body.length, 0, 0, 0, 0, 0, 0, 0, body.length, ...body];
  const header = [22, 0xfe, 0xfd, 0, 0, 0, 0, 0, 0, 0, 1, 0, handshake.length];
  return Buffer.from([...header, ...handshake]);
}

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
    const plain = await metric('datagrams_refused', refused('dtls-plaintext'));
    const foreign = await metric('datagrams_refused', refused('unknown-source'));
    for (const datagram of [PLAIN_ALERT, clientHello()]) {
      socket.send(datagram, port, host);
      // As from somebody who forges the operator's address.
      await connection.send(datagram);
    }
    await untilMetric('datagrams_refused', refused('dtls-plaintext'), plain + 2);
    await untilMetric('datagrams_refused', refused('unknown-source'), foreign + 2);
    await expectDriving();
  });

  it('does not answer an unauthenticated connectivity check, and keeps the path', async () => {
    const { connection } = driver.client.connection.iceTransports[0]!;
    const [host, port] = connection.nominated!.remoteAddr;
    const socket = await openStranger(host);
    let answers = 0;
    socket.on('message', () => answers++);
    const before = await metric('datagrams_refused', refused('stun-unauthenticated'));
    const check = new Message(1, 0)
      .setAttribute('USERNAME', `${connection.remoteUsername}:${connection.localUsername}`)
      .setAttribute('PRIORITY', 0x7fffffff)
      .setAttribute('ICE-CONTROLLING', 2n ** 64n - 1n)
      .setAttribute('USE-CANDIDATE', null);
    socket.send(check.bytes, port, host);
    await untilMetric('datagrams_refused', refused('stun-unauthenticated'), before + 1);
    await expectDriving();
    expect(answers).toBe(0);
  });

  it('survives malformed SCTP from one operator without harm to another’s session', async () => {
    const guest = await robot.connect();
    const before = await metric('datagrams_refused', refused('sctp-malformed'));
    const { pid } = robot.stack.robot(ROBOT);
    const transport = guest.client.connection.dtlsTransports[0]!;
    await transport.sendData(Buffer.from([1, 2, 3]));
    await transport.sendData(Buffer.alloc(16));
    await untilMetric('datagrams_refused', refused('sctp-malformed'), before + 2);
    await guest.client.connection.sctpTransport?.sctp.send(9, 99, Buffer.from('of no protocol'));
    await untilMetric('datagrams_refused', refused('message-malformed'), 1);
    await expectDriving();
    expect(robot.stack.robot(ROBOT).pid).toBe(pid);
    const frames = guest.client.completeFrames.length;
    await guest.client.until(() => guest.client.completeFrames.length > frames);
  });
});
