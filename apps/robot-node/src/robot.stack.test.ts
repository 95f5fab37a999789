/** The real robot program with the real signaling service: processes, sockets, WebRTC. */

import { once } from 'node:events';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { soleFingerprint, verifyIdentity } from '@farpoint/grants';
import { readPictureFile } from '@farpoint/protocol';
import { afterAll, afterEach, describe, expect, it } from 'vitest';
import { WebSocket } from 'ws';
import { RobotKey } from './access/robot-key-file.ts';
import { SignaledOperator } from './testing/signaled-operator.ts';
import { useRobot } from './testing/use-robot.ts';

const ROBOT = 'sim-1';
const folder = mkdtempSync(join(tmpdir(), 'farpoint-robot-'));
afterAll(() => rmSync(folder, { recursive: true }));
const keyFile = join(folder, 'key.json');
/** At a fixed rate: a busy machine delays packets like a bad link, which then carries no pictures. */
const ARGS = [
  '--rate-control',
  'fixed',
  '--sim-size',
  '64',
  '--pictures-of-cloud',
  '--max-points',
  '600',
  '--silence-s',
  '1',
  '--max-operators',
  '2',
  '--robot-key',
  keyFile,
];

// Hooks run in reverse order: this one after the operators of the test have closed.
afterEach(() => until(async () => (await metric('operators')) === 0));
const robot = useRobot(ROBOT, ARGS);
const connect = () => robot.connect();

async function metric(name: string, labels = ''): Promise<number> {
  const text = await (await fetch(`${robot.stack.robotAdminUrl(ROBOT)}/metrics`)).text();
  const line = text.split('\n').find((row) => row.startsWith(`farpoint_robot_${name}${labels} `));
  return line === undefined ? 0 : Number(line.split(' ').at(-1));
}

async function until(is: () => Promise<boolean>): Promise<void> {
  while (!(await is())) await new Promise((resolve) => setTimeout(resolve, 20));
}

/** Sends commands at 50 Hz, as a page does, until `is` holds. */
async function driveUntil(operator: SignaledOperator, lease: string, linear: number, is: () => boolean) {
  const timer = setInterval(() => operator.client.drive(lease, linear), 20);
  await operator.client.until(is);
  clearInterval(timer);
}

/** The thumbprint of the key that the robot has proved in this session. */
async function provenKey({ heard, session }: SignaledOperator): Promise<string> {
  const offer = heard.find((message) => message.type === 'session.offer');
  const { sdp = '', identity = '' } = offer ?? {};
  const robotFingerprint = soleFingerprint(sdp) ?? '';
  return await verifyIdentity(identity, { robot: ROBOT, session, robotFingerprint });
}

/** A robot that was killed starts latched. */
async function releaseEstop({ client }: SignaledOperator): Promise<void> {
  await client.takeLease();
  client.releaseEstop();
  await client.message('estop', (message) => !message.latched);
}

/** Somebody who speaks the operators' protocol by hand. */
class Stranger {
  readonly #socket: WebSocket;
  readonly #told: Record<string, unknown>[] = [];

  private constructor(socket: WebSocket) {
    this.#socket = socket;
    socket.on('message', (data: Buffer) => this.#told.push(JSON.parse(data.toString())));
  }

  static async connect(): Promise<Stranger> {
    const socket = new WebSocket(new URL('/operator', robot.stack.signalingUrl));
    const stranger = new Stranger(socket);
    await once(socket, 'open');
    stranger.say({ type: 'operator.hello', protocol: 1, name: 'stranger' });
    return stranger;
  }

  say(message: object): void {
    this.#socket.send(JSON.stringify(message));
  }

  /** The next message of this type since the last that was asked for. */
  async told(type: string): Promise<Record<string, unknown>> {
    for (;;) {
      const at = this.#told.findIndex((message) => message.type === type);
      if (at >= 0) return this.#told.splice(0, at + 1).at(-1) ?? {};
      await once(this.#socket, 'message');
    }
  }

  close(): void {
    this.#socket.terminate();
  }
}

describe('robot process', { timeout: 30_000 }, () => {
  it('streams whole frames to an operator', async () => {
    const { client } = await connect();
    await client.until(() => client.completeFrames.length >= 10);
    expect(client.malformedPackets).toBe(0);
    expect(client.completeFrames.every((frame) => frame.points === 600 && frame.packets === 4)).toBe(true);
    const welcome = await client.message('welcome');
    expect(welcome).toMatchObject({
      robotId: ROBOT,
      name: 'Simulated robot',
      stream: { width: 64, height: 64 },
    });
    await client.until(() => (client.telemetry?.stream.pointsPerFrame ?? 0) > 0);
    expect(client.telemetry).toMatchObject({ drive: 'idle', operators: 1 });
  });

  it('sends its camera’s pictures only to operators that request them', async () => {
    const [{ client }, { client: other }] = [await connect(), await connect()];
    expect((await client.message('cameras')).cameras).toEqual([{ name: 'Camera' }]);
    client.sendSession({ type: 'pictures', cameras: [0] });
    await client.until(() => (client.pictures.get(0)?.pictureId ?? 0) >= 1);
    const picture = client.pictures.get(0)!;
    expect(picture).toMatchObject({ format: 'jpeg', width: 64, height: 64 });
    expect(readPictureFile(picture.bytes)).toEqual({ format: 'jpeg', width: 64, height: 64 });
    expect(other.pictures.size).toBe(0);
    expect(await metric('pictures_made_total')).toBeGreaterThanOrEqual(2);
    // Those that were not sent were superseded by newer ones.
    expect(await metric('pictures_sent')).toBeGreaterThanOrEqual(1);
    client.sendSession({ type: 'pictures', cameras: [] });
    const made = () => metric('pictures_made_total');
    // Pictures in progress are finished; then no more are made.
    await until(async () => {
      const before = await made();
      const { framesPerSecond } = client.telemetry?.stream ?? { framesPerSecond: 0 };
      const { size } = client.frames;
      await client.until(() => client.frames.size > size + framesPerSecond / 2);
      return (await made()) === before;
    });
  });

  it('drives under a lease, and stands still once the commands end', async () => {
    const operator = await connect();
    const { client } = operator;
    const lease = await client.takeLease();
    await client.until(() => client.telemetry !== null);
    const start = client.telemetry!.pose.position.x;
    await driveUntil(operator, lease, 0.3, () => (client.telemetry?.pose.position.x ?? 0) > start + 0.1);
    expect(client.telemetry?.drive).toBe('driving');
    await client.until(() => client.telemetry?.drive === 'watchdog');
    await client.until(() => client.telemetry?.twist.linear.x === 0);
  });

  it('answers a latency test with a green frame', async () => {
    const { client } = await connect();
    const lease = await client.takeLease();
    client.drive(lease, 0, { latencyTest: 41 });
    const answer = await client.message('latencyFrame');
    expect(answer).toMatchObject({ id: 41 });
    expect(answer.captureMs).toBeGreaterThanOrEqual(answer.commandMs);
    await client.until(() => client.frames.get(answer.frameNumber)?.complete === true);
    expect(client.frames.get(answer.frameNumber)?.latencyTest).toBe(true);
    await client.until(() => client.frames.has(answer.frameNumber + 2));
    const green = [...client.frames.values()].filter((frame) => frame.latencyTest);
    expect(green.map((frame) => frame.frameNumber)).toEqual([answer.frameNumber]);
  });

  it('refuses bad commands with the reason', async () => {
    const { client } = await connect();
    client.drive('no-lease', 0.3);
    await client.message('rejected', (message) => message.reason === 'not-lease-holder');
    client.control.send('{"type":"command"}');
    await client.message('rejected', (message) => message.reason === 'malformed');
    const lease = await client.takeLease();
    // Before the hand has let go once, it is asked to do that.
    const driving = setInterval(() => client.drive(lease, 50), 20);
    await client.message('rejected', (message) => message.reason === 'out-of-range');
    clearInterval(driving);
    expect(client.telemetry?.twist.linear.x ?? 0).toBe(0);
    expect(await metric('commands_rejected_total', '{reason="malformed"}')).toBeGreaterThanOrEqual(1);
  });

  it('lets a second operator watch the same frames, but not a third', async () => {
    const [driver, watcher] = [await connect(), await connect()];
    await driver.client.takeLease();
    await watcher.client.message('lease', (message) => message.holder === 'other');
    const common = () =>
      watcher.client.completeFrames.some(
        ({ frameNumber }) => driver.client.frames.get(frameNumber)?.complete,
      );
    await Promise.race([watcher.client.until(common), driver.client.until(common)]);
    const refused = await metric('sessions_refused_total');
    expect(await SignaledOperator.refused(robot.stack.signalingUrl, ROBOT)).toMatchObject({
      type: 'session.closed',
      reason: 'robot-full',
      maxOperators: 2,
    });
    expect(await metric('sessions_refused_total')).toBe(refused + 1);
  });

  it('sends each operator no more clouds than its computer draws', async () => {
    const [{ client }, { client: slow }] = [await connect(), await connect()];
    slow.sendSession({ type: 'display', framesPerSecond: 5, points: 1000 });
    // Those that were sent before the robot heard of it.
    await slow.message('welcome');
    await slow.until(() => slow.telemetry !== null);
    const { sequence } = slow.telemetry ?? { sequence: 0 };
    await slow.until(() => (slow.telemetry?.sequence ?? 0) > sequence + 4);
    const [before, beforeSlow] = [client.completeFrames.length, slow.completeFrames.length];
    await client.until(() => client.completeFrames.length >= before + 60);
    const all = client.completeFrames.length - before;
    const few = slow.completeFrames.length - beforeSlow;
    // At 60 a second, or whatever this machine can: never every one.
    expect(few).toBeLessThan(all / 1.5);
    await slow.until(() => slow.completeFrames.length >= beforeSlow + 5);
  });

  it('a stranger who knows the session’s handle but not its key cannot disturb anybody', async () => {
    const operator = await connect();
    const { client, session } = operator;
    await client.until(() => client.completeFrames.length > 0);
    const restarts = await metric('ice_restarts_total');
    const heard = operator.heard.length;
    const refusals = () => metric('resumes_refused_total', '{reason="wrong-resume-key"}');
    const refused = await refusals();
    const stranger = await Stranger.connect();
    const resume = { type: 'session.resume', session, robotId: ROBOT };
    const key = (await client.message('welcome')).resumeKey ?? '';
    const wrong = ['0', 'A'.repeat(22), `${key.slice(0, -1)}_`, `${key}0`];
    for (const resumeKey of wrong) {
      stranger.say({ ...resume, resumeKey });
      expect(await stranger.told('error')).toMatchObject({ code: 'wrong-resume-key', session });
    }
    // Without being bound to the session, the stranger can neither end it nor send anything into it.
    const candidate = { candidate: 'candidate:1 1 udp 2130706431 127.0.0.1 9 typ host', sdpMid: '0' };
    for (const message of [
      { type: 'session.close', session },
      { type: 'session.answer', session, sdp: 'v=0' },
      { type: 'session.candidate', session, candidate },
    ]) {
      stranger.say(message);
      expect(await stranger.told('error')).toMatchObject({ code: 'unknown-session' });
    }
    stranger.close();
    const { length } = client.completeFrames;
    await client.until(() => client.completeFrames.length > length + 10);
    expect(operator.heard.slice(heard)).toEqual([]);
    expect(await metric('ice_restarts_total')).toBe(restarts);
    expect(await refusals()).toBe(refused + wrong.length);

    // The same request from a new socket with the right key gets a new path.
    await operator.resume();
    await operator.until(({ type }) => type === 'session.resuming');
    await until(async () => (await metric('ice_restarts_total')) === restarts + 1);
    const { packets } = client;
    await client.until(() => client.packets > packets + 20);
  });

  it('refuses an unusable answer, and says why', async () => {
    const stranger = await Stranger.connect();
    stranger.say({ type: 'session.open', robotId: ROBOT });
    const { session } = await stranger.told('session.offer');
    stranger.say({ type: 'session.answer', session, sdp: 'v=0\r\n' });
    expect(await stranger.told('session.closed')).toMatchObject({
      ...{ reason: 'bad-answer', detail: '0 m-lines, where the offer has 3' },
    });
    stranger.close();
  });

  it('sends organised frames to an operator that reads only those, and points64 to another that does not', async () => {
    const [{ client: reads }, { client: plain }] = [await connect(), await connect()];
    const newest = new Map<object, number>();
    for (const client of [reads, plain]) {
      client.onCloudPacket = (payload) => newest.set(client, payload.at(-1) as number);
    }
    reads.sendSession({ type: 'cloudFormats', formats: ['points64', 'organised'] });
    expect(await reads.message('cloudStream')).toMatchObject({ format: 'organised' });
    await reads.until(() => newest.get(reads) === 2);
    await plain.until(() => newest.get(plain) === 1 && plain.completeFrames.length > 2);
    // The frame fits none of the remaining formats.
    reads.sendSession({ type: 'cloudFormats', formats: ['points64', 'unorganised'] });
    await reads.until(() => newest.get(reads) === 1);
    expect(plain.session.some(({ type }) => type === 'cloudStream')).toBe(false);
  });

  it('pauses and resumes the stream', async () => {
    const { client } = await connect();
    await client.until(() => (client.telemetry?.stream.framesPerSecond ?? 0) > 0);
    client.sendSession({ type: 'stream', running: false });
    await client.until(() => client.telemetry?.stream.framesPerSecond === 0);
    const paused = client.packets;
    const { sequence } = client.telemetry!;
    await client.until(() => (client.telemetry?.sequence ?? 0) >= sequence + 10);
    expect(client.packets).toBe(paused);
    client.sendSession({ type: 'stream', running: true });
    await client.until(() => client.packets > paused);
  });

  it('frees the lease of an operator that vanishes, and stops', async () => {
    const lost = await connect();
    const lease = await lost.client.takeLease();
    const watcher = await connect();
    await watcher.client.message('lease', (message) => message.holder === 'other');
    await driveUntil(lost, lease, 0.2, () => (lost.client.telemetry?.twist.linear.x ?? 0) > 0.1);
    await lost.vanish();
    await watcher.client.until(() => watcher.client.telemetry?.twist.linear.x === 0);
    await watcher.client.message('lease', (message) => message.holder === 'nobody');
    await watcher.client.takeLease();
  });

  it('ends the session when the operator closes it', async () => {
    const operator = await connect();
    operator.closeSession();
    await until(async () => (await metric('operators')) === 0);
  });

  it('keeps streaming while signaling is down, and is listed again afterwards', async () => {
    const { client } = await connect();
    await robot.stack.signaling.kill();
    await until(async () => (await metric('signaling_registered')) === 0);
    const before = client.completeFrames.length;
    await client.until(() => client.completeFrames.length > before + 10);
    await robot.stack.startSignaling();
    await until(async () => (await metric('signaling_registered')) === 1);
    const second = await connect();
    await second.client.until(() => second.client.completeFrames.length > 0);
    expect(client.session.at(-1)?.type).not.toBe('fault');
  });

  it('comes back after being killed', async () => {
    const lost = await connect();
    await lost.client.until(() => lost.client.completeFrames.length > 0);
    await robot.stack.robot(ROBOT).kill();
    await robot.stack.restartRobot(ROBOT);
    const operator = await connect();
    const { client } = operator;
    await client.until(() => client.completeFrames.length > 0);
    // It knows nothing of the session from before, and says so.
    const { session } = lost;
    const stranger = await Stranger.connect();
    stranger.say({ type: 'session.resume', session, robotId: ROBOT, resumeKey: '0' });
    expect(await stranger.told('session.closed')).toMatchObject({ session, reason: 'unknown-session' });
    stranger.close();
    // A crash does not release the stop: nobody can move the robot before somebody releases it on purpose.
    expect(await client.message('estop')).toMatchObject({ latched: true, by: 'robot' });
    const lease = await client.takeLease();
    client.drive(lease, 0.3);
    await client.message('rejected', (message) => message.reason === 'estop-latched');
    await releaseEstop(operator);
    client.drive(lease, 0);
    await driveUntil(operator, lease, 0.3, () => (client.telemetry?.twist.linear.x ?? 0) > 0.1);
  });

  it('ends cleanly when asked to, and proves the key in its file in each session before and after', async () => {
    const operator = await connect();
    const { client } = operator;
    const { thumbprint } = await RobotKey.open(keyFile);
    expect(await provenKey(operator)).toBe(thumbprint);
    await client.until(() => client.completeFrames.length > 0);
    const { code } = await robot.stack.robot(ROBOT).stop();
    expect(code).toBe(0);
    await robot.stack.restartRobot(ROBOT);
    const again = await connect();
    expect(await again.client.message('estop')).toMatchObject({ latched: false });
    expect(await provenKey(again)).toBe(thumbprint);
  });
});
