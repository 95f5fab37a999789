/** The real robot program with the real signaling service: processes, sockets, WebRTC. */
import { join } from 'node:path';
import { soleFingerprint, verifyIdentity } from '@farpoint/grants';
import {
  type CommandTimes,
  emptyPlacement,
  emptyPointPacketHeader,
  readCloudPayload,
  readPictureFile,
} from '@farpoint/protocol';
import { eventually } from '@farpoint/service/testing/eventually';
import { useFolder } from '@farpoint/service/testing/folder';
import { afterEach, describe, expect, it } from 'vitest';
import { RobotKey } from './admit/access/robot-key-file.ts';
import { metricOf } from './testing/metric-of.ts';
import type { SignaledOperator } from './testing/signaled-operator.ts';
import { driveUntil } from './testing/steady-hand.ts';
import { useRobot } from './testing/use-robot.ts';

const ROBOT = 'sim-1';
const folder = useFolder();
const keyFile = join(folder, 'key.json');
/** At a fixed rate: a busy machine delays packets like a bad link, which then carries no pictures. */
const ARGS = [
  ...['--rate-control', 'fixed', '--sim-size', '64', '--pictures-of-cloud', '--max-points', '600'],
  ...['--silence-s', '1', '--max-operators', '2', '--robot-key', keyFile],
];

// Hooks run in reverse order: this one after the operators of the test have closed.
afterEach(() => eventually(async () => (await metric('operators')) === 0));
const robot = useRobot(ROBOT, ARGS);
const connect = () => robot.connect();

const metric = (name: string) => metricOf(robot.stack.robotAdminUrl(ROBOT), `farpoint_robot_${name}`);

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
    await eventually(async () => {
      const before = await made();
      const { framesPerSecond } = client.telemetry?.stream ?? { framesPerSecond: 0 };
      const { size } = client.frames;
      await client.until(() => client.frames.size > size + framesPerSecond / 2);
      return (await made()) === before;
    });
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

  it('tells when the clouds that it sends and the commands that it takes have passed its stations', async () => {
    const { client } = await connect();
    /** Capture times in the packets of clouds. */
    const captured = new Set<number>();
    client.onCloudPacket = (payload) => {
      const placement = emptyPlacement();
      const view = new DataView(payload.buffer, payload.byteOffset, payload.byteLength);
      if (readCloudPayload(view, emptyPointPacketHeader(), placement) === null)
        captured.add(placement.captureTimeUs);
    };
    const lease = await client.takeLease();
    let taken: CommandTimes | undefined;
    await driveUntil(client, lease, 0, () => {
      taken ??= client.newest.stages?.commands.find(([, , , wheelsUs]) => wheelsUs !== null);
      return taken !== undefined;
    });
    const [, , judgedUs = 0, wheelsUs] = taken ?? [];
    expect(wheelsUs).toBeGreaterThanOrEqual(judgedUs);
    // Of a frame of which something has come.
    await client.until(() => captured.has(client.newest.stages?.frames.at(-1)?.[2] ?? -1));
    const [sensor, , , memoryUs = 0, encodedUs = 0, , lastUs = 0] = client.newest.stages?.frames.at(-1) ?? [];
    expect(sensor).toBe(0);
    // The simulated camera is rendered after its capture time: it takes time until the cloud is there, and until it leaves.
    expect(memoryUs).toBeGreaterThan(0);
    expect(encodedUs).toBeGreaterThan(memoryUs);
    expect(lastUs).toBeGreaterThan(encodedUs);
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

  it('comes back after being killed', async () => {
    const lost = await connect();
    await lost.client.until(() => lost.client.completeFrames.length > 0);
    await robot.stack.robot(ROBOT).kill();
    await robot.stack.restartRobot(ROBOT);
    const operator = await connect();
    const { client } = operator;
    await client.until(() => client.completeFrames.length > 0);
    // A crash does not release the stop: nobody can move the robot before somebody releases it on purpose.
    expect(await client.message('estop')).toMatchObject({ latched: true, by: 'robot' });
    const lease = await client.takeLease();
    client.drive(lease, 0.3);
    await client.message('rejected', (message) => message.reason === 'estop-latched');
    await releaseEstop(operator);
    client.drive(lease, 0);
    await driveUntil(client, lease, 0.3, () => (client.telemetry?.twist.linear.x ?? 0) > 0.1);
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
