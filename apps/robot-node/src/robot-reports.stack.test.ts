/**
 * What the real robot program tells its operators, and by what it goes: its sensors and their streams, quantities,
 * components, alarms, and the feedback of the operator's WebRTC stack.
 */
import { eventually } from '@farpoint/service/testing/eventually';
import { describe, expect, it } from 'vitest';
import { metricOf } from './testing/metric-of.ts';
import { SignaledOperator } from './testing/signaled-operator.ts';
import { useRobot } from './testing/use-robot.ts';

const ROBOT = 'two-sensors';
const [CAMERA, LIDAR] = [0, 1];
// The camera’s clouds are more than the LiDAR’s ten a second, and leave the processor to them.
const CLOUDS = ['--sim-size', '64', '--fps', '15', '--sim-lidars', '1'];

const robot = useRobot(ROBOT, [
  ...[...CLOUDS, '--rate-control', 'fixed', '--bitrate-mbps', '100'],
  ...['--sim-charge', '15', '--sim-origin', '48.1374,11.5755'],
]);
const connect = async () => (await robot.connect()).client;

describe('a robot with two sensors', { timeout: 30_000 }, () => {
  it('names its sensors, and sends only the second one’s clouds to an operator who asks for only those', async () => {
    const [client, other] = [await connect(), await connect()];
    expect((await client.message('sensors')).sensors).toEqual([{ name: 'Camera' }, { name: 'LiDAR' }]);
    const { sensor, elevations } = await client.message('rings');
    expect([sensor, elevations.length, elevations[0]]).toEqual([LIDAR, 16, -0.2618]);
    client.sendSession({ type: 'sensors', sensors: [CAMERA, LIDAR] });
    // Every beam that hits something, of 16 rings of 900; where the machine stalls, a cloud may have fewer.
    const whole = () => client.completeFramesOf(LIDAR).filter(({ points }) => points > 5000).length;
    await client.until(() => whole() >= 2 && client.completeFramesOf(CAMERA).length >= 2);
    await other.until(() => other.completeFramesOf(CAMERA).length >= 5);
    expect(other.completeFramesOf(LIDAR)).toEqual([]);
    expect(client.malformedPackets).toBe(0);
  });

  it('switches each sensor off and on without affecting the other', async () => {
    const client = await connect();
    const count = (sensor: number) => client.completeFramesOf(sensor).length;
    /** Clouds of one sensor come, and after those that were under way none of the other. */
    const untilOnly = async (wanted: number, other: number) => {
      let last = { wanted: count(wanted), other: count(other) };
      await client.until(() => {
        if (count(other) > last.other) last = { wanted: count(wanted), other: count(other) };
        return count(wanted) >= last.wanted + 5;
      });
    };
    client.sendSession({ type: 'sensors', sensors: [LIDAR] });
    await untilOnly(LIDAR, CAMERA);
    client.sendSession({ type: 'sensors', sensors: [CAMERA] });
    await untilOnly(CAMERA, LIDAR);
    client.sendSession({ type: 'sensors', sensors: [] });
    await client.until(() => client.telemetry?.stream.framesPerSecond === 0);
  });

  it('announces each sensor’s coded stream', async () => {
    const client = await connect();
    client.sendSession({ type: 'sensors', sensors: [CAMERA, LIDAR] });
    client.sendSession({ type: 'cloudFormats', formats: ['points64', 'organised', 'unorganised'] });
    const camera = await client.message('cloudStream', ({ sensor }) => sensor === undefined);
    const lidar = await client.message('cloudStream', ({ sensor }) => sensor === LIDAR);
    expect([camera.format, lidar.format]).toEqual(['organised', 'unorganised']);
  });
});

describe('what a robot tells about itself', { timeout: 30_000 }, () => {
  it('it describes its quantities, samples them, reports its components and raises an alarm', async () => {
    const client = await connect();
    expect(await client.message('alarm')).toMatchObject({ level: 'warn', limit: 20, unit: '%' });
    await client.until(() => client.newest.diagnostics !== undefined && client.samples.length >= 10);
    const quantities = client.session.filter((message) => message.type === 'quantity');
    expect(quantities.map(({ topic, field }) => `${topic} ${field}`)).toEqual([
      ...['/motors left', '/motors right', '/fix latitude', '/fix longitude', '/fix altitude'],
    ]);
    const newest = new Map(client.samples.map(([number, , value]) => [number, value]));
    expect(newest.get(0)).toBeCloseTo(22, 0);
    expect(newest.get(2)).toBeCloseTo(48.1375, 3);
    expect(client.newest.diagnostics).toMatchObject({ topic: '/diagnostics', counts: { warn: 1, ok: 3 } });
    expect(client.readings.get('/diagnostics')?.timeMs).toBeGreaterThan(0);
  });
});

describe('an operator whose WebRTC stack gives no transport-wide feedback', { timeout: 30_000 }, () => {
  it('is sent at a rate by its RTCP receiver reports, and told so (how it grows: report-rate-controller.test.ts)', async () => {
    const id = 'adaptive';
    await robot.stack.startRobot({ id, name: 'Robot', args: ['--sim-size', '64', '--start-mbps', '1'] });
    const connectTo = async (transportFeedback: boolean) =>
      robot.keep(await SignaledOperator.connect(robot.stack.signalingUrl, id, { transportFeedback })).client;
    const without = await connectTo(false);
    await without.until(() => without.telemetry?.stream.feedback === 'reports');
    await without.until(() => without.completeFrames.length > 0);
    expect(without.malformedPackets).toBe(0);
    const reports = () =>
      metricOf(robot.stack.robotAdminUrl(id), 'farpoint_robot_rate_state{state="reports"}');
    await eventually(async () => (await reports()) === 1);
    const usual = await connectTo(true);
    await usual.until(() => (usual.telemetry?.stream.targetBitsPerSecond ?? 0) > 0);
    expect(usual.telemetry?.stream.feedback).toBeUndefined();
    await robot.stack.robot(id).stop();
  });
});
