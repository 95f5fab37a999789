/** The robot program as an operator of the reference system sees it: processes, sockets, WebRTC. */
import { checkOffer, ReferenceOperator, RtpStreamRules, SocketPeer } from '@farpoint/conformance';
import { LocalStack } from '@farpoint/local-stack';
import { CLOUD_FORMATS, type LeaseState, type Twist, zeroTwist } from '@farpoint/protocol';
import { afterAll, beforeAll, describe, expect, it, onTestFinished } from 'vitest';
import { SignaledOperator } from '../../testing/signaled-operator.ts';

const ROBOT = 'sim-1';
const NAME = 'Simulated robot';
/** A loaded machine makes gaps, after which the reference system's operators do not know that they must let go. */
const ARGS = ['--sim-size', '64', '--max-points', '650', '--after-gap', 'resume'];
/** Where a machine stalls, rate control would send fewer points for a while. */
const FIXED = ['--rate-control', 'fixed'];

/** Of a packet of the cloud. */
const PACKET_BYTES = 1200;
const REPORTED_BITS_PER_S = 400_000;

let stack: LocalStack;

beforeAll(async () => {
  stack = await LocalStack.start({
    robots: [{ id: ROBOT, name: NAME, args: [...ARGS, ...FIXED], reference: true }],
  });
}, 60_000);
afterAll(() => stack.stop(), 30_000);

function clientUrl(): string {
  return `ws://127.0.0.1:${stack.ports.referenceClient}/`;
}

async function referenceOperator(): Promise<ReferenceOperator> {
  const operator = await ReferenceOperator.connect(clientUrl(), NAME);
  onTestFinished(() => operator.close());
  return operator;
}

async function farpointOperator(): Promise<SignaledOperator> {
  const operator = await SignaledOperator.connect(stack.signalingUrl, ROBOT);
  onTestFinished(() => operator.close());
  await operator.client.until(() => operator.client.telemetry !== null);
  return operator;
}

function forward(metresPerSecond: number): Twist {
  const twist = zeroTwist();
  twist.linear.x = metresPerSecond;
  return twist;
}

/** Waits until the robot tells this operator that `holder` drives. */
async function untilHolder({ client }: SignaledOperator, holder: LeaseState['holder']): Promise<void> {
  await client.until(() => client.session.findLast((message) => message.type === 'lease')?.holder === holder);
}

/** Sends the same twist at 50 Hz until the returned function is called. */
function repeat(operator: ReferenceOperator, twist: Twist): () => void {
  const timer = setInterval(() => operator.command(twist), 20);
  return () => clearInterval(timer);
}

describe('reference profile of the robot process', { timeout: 60_000 }, () => {
  it('offers and sends exactly what the reference system does, from "start" to "stop"', async () => {
    const operator = await referenceOperator();
    expect(checkOffer(operator.offer)).toEqual([]);
    expect(operator.robotChannels).toEqual([{ label: 'controltrack', ordered: true, reliable: true }]);
    const rules = new RtpStreamRules();
    const points: number[] = [];
    operator.onPacket = (packet) => {
      rules.add(packet);
      points.push(new DataView(packet.buffer).getUint32(24, true) / 8);
    };
    operator.say('start');
    await operator.packets.next(() => rules.frames >= 20);
    expect(rules.findings).toEqual([]);
    // 650 were requested: rounded to a multiple of 150.
    expect(new Set(points)).toEqual(new Set([600]));
    operator.say(new TextEncoder().encode('stop'));
    // The last frame of the old stream and the first of the new one. Nothing came in between, and frame numbers
    // continue.
    operator.say('start');
    const { frames } = rules;
    await operator.packets.next(() => rules.frames >= frames + 5);
    expect(rules.findings).toEqual([]);
  });

  it('serves both kinds of operators at once, and sends points64 even while the other reads a coded format', async () => {
    const [own, reference] = [await farpointOperator(), await referenceOperator()];
    reference.say('start');
    const rules = new RtpStreamRules();
    reference.onPacket = (packet) => rules.add(packet);
    const before = own.client.completeFrames.length;
    await reference.packets.next(() => rules.frames >= 10);
    await own.client.until(() => own.client.completeFrames.length >= before + 10);
    expect(own.client.malformedPackets).toBe(0);
    own.client.sendSession({ type: 'cloudFormats', formats: [...CLOUD_FORMATS] });
    await own.client.message('cloudStream');
    const [{ packets }, { frames }] = [own.client, rules];
    await reference.packets.next(() => rules.frames >= frames + 10);
    await own.client.until(() => own.client.packets > packets);
    expect(rules.findings).toEqual([]);
  });

  it('obeys one operator at a time, within the robot’s own limits, and stops without commands', async () => {
    const [own, reference] = [await farpointOperator(), await referenceOperator()];
    const { client } = own;
    const start = client.telemetry!.pose.position.x;
    const stop = repeat(reference, forward(0.3));
    // Motion needs a picture: nobody drives by a stream that is not sent.
    await client.until(() => client.telemetry?.motion?.reasons[0] === 'view-unknown');
    expect(client.telemetry?.twist.linear.x).toBe(0);
    reference.say('start');
    await client.until(() => (client.telemetry?.pose.position.x ?? 0) > start + 0.1);
    expect(client.telemetry?.drive).toBe('driving');
    // An operator that asks while another drives is refused.
    await untilHolder(own, 'other');
    stop();
    await client.until(() => client.telemetry?.drive === 'watchdog');
    await client.until(() => client.telemetry?.twist.linear.x === 0);
    // Released by itself, so that others can drive.
    await untilHolder(own, 'nobody');
    await client.takeLease();
    const still = repeat(reference, forward(0.3));
    const stamp = client.telemetry!.sequence;
    await client.until(() => client.telemetry!.sequence > stamp + 5);
    expect(client.telemetry?.twist.linear.x).toBe(0);
    still();
    client.sendSession({ type: 'leaseRelease' });
    await untilHolder(own, 'nobody');
    // A command beyond the limit is refused, not clamped.
    const fast = repeat(reference, forward(5));
    const later = client.telemetry!.sequence;
    await client.until(() => client.telemetry!.sequence > later + 5);
    expect(client.telemetry?.twist.linear.x).toBe(0);
    fast();
  });

  it('comes down to the rate that the operator reports (exactly how far: pacer.test.ts, reported-limit.test.ts)', async () => {
    const operator = await referenceOperator();
    operator.say('start');
    /** Bits a second of the next packets. */
    const rateOver = async (packets: number): Promise<number> => {
      const stamps: number[] = [];
      await operator.packets.next((packet) => stamps.push(timestampOf(packet)) > packets);
      const seconds = (((stamps.at(-1) ?? 0) - (stamps[0] ?? 0)) >>> 0) / 90_000;
      return (packets * PACKET_BYTES * 8) / seconds;
    };
    await operator.packets.next();
    for (let i = 0; i < 16; i++) operator.report(REPORTED_BITS_PER_S);
    // What is in flight comes first. The robot's 600 points 60 times a second are five times as much.
    while ((await rateOver(20)) > 1.1 * REPORTED_BITS_PER_S);
  });

  it('ignores invalid answers, and makes a new offer', async () => {
    const first = await referenceOperator();
    await first.close();
    const line = await SocketPeer.open(clientUrl());
    onTestFinished(() => line.close());
    const { robot } = await line.message<{ robot: { id: number } }>({ type: 'register' });
    const noTransport = first.offer.replaceAll('a=ice-pwd', 'a=x');
    for (const sdpAnswer of ['', 'v=0\r\nm=nonsense', noTransport]) {
      line.send({ type: 'candidate', robotId: robot.id, candidate: 'candidate:nonsense' });
      line.send({ type: 'answer', robotId: robot.id, sdpAnswer });
    }
    const again = await referenceOperator();
    // They match no offer, so the offer stands unchanged.
    expect(again.robotId).toBe(robot.id);
    again.say('start');
    const rules = new RtpStreamRules();
    again.onPacket = (packet) => rules.add(packet);
    await again.packets.next(() => rules.frames >= 3);
    // Frames count from 0 on each connection.
    expect(rules.findings).toEqual([]);
  });

  it('keeps streaming while signaling is down, and registers again afterwards', async () => {
    const operator = await referenceOperator();
    operator.say('start');
    await operator.packets.next();
    await stack.signaling.kill();
    let count = 0;
    await operator.packets.next(() => ++count > 50);
    await stack.startSignaling();
    const again = await referenceOperator();
    again.say('start');
    await again.packets.next();
    expect(again.robotId).not.toBe('');
  });

  it('is not offered unless configured', async () => {
    await stack.startRobot({ id: 'sim-2', name: 'Other', args: ARGS });
    onTestFinished(async () => void (await stack.robot('sim-2').stop()));
    // By the time that Farpoint's own operators have a session, it would have been.
    const own = await SignaledOperator.connect(stack.signalingUrl, 'sim-2');
    onTestFinished(() => own.close());
    const line = await SocketPeer.open(clientUrl());
    onTestFinished(() => line.close());
    line.send({ type: 'getRobots' });
    const { robots } = await line.message<{ robots: { name: string }[] }>({ type: 'robots' });
    expect(robots.map(({ name }) => name)).toEqual([NAME]);
  });
});

function timestampOf(packet: Uint8Array): number {
  return new DataView(packet.buffer, packet.byteOffset).getUint32(4);
}
