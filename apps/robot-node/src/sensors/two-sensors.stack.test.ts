/** The real robot program with a camera and a LiDAR, and the real signaling service. */
import { describe, expect, it } from 'vitest';
import { useRobot } from '../testing/use-robot.ts';

const ROBOT = 'two-sensors';
const [CAMERA, LIDAR] = [0, 1];
// The camera’s clouds are more than the LiDAR’s ten a second, and leave the processor to them.
const CLOUDS = ['--sim-size', '64', '--fps', '15', '--sim-lidars', '1'];
const ARGS = [...CLOUDS, '--rate-control', 'fixed', '--bitrate-mbps', '100'];

const robot = useRobot(ROBOT, ARGS);
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
    await client.until(() => whole() >= 4);
    const cameraFrames = client.completeFramesOf(CAMERA).length;
    expect(cameraFrames).toBeGreaterThan(client.completeFramesOf(LIDAR).length);
    await other.until(() => other.completeFramesOf(CAMERA).length >= 5);
    expect(other.completeFramesOf(LIDAR)).toEqual([]);
    expect(client.malformedPackets).toBe(0);
  });

  it('switches each sensor off and on without affecting the other', async () => {
    const client = await connect();
    client.sendSession({ type: 'sensors', sensors: [LIDAR] });
    await client.until(() => client.completeFramesOf(LIDAR).length >= 3);
    const before = client.completeFramesOf(CAMERA).length;
    const count = client.completeFramesOf(LIDAR).length;
    await client.until(() => client.completeFramesOf(LIDAR).length >= count + 5);
    // Let packets arrive that were under way when the sensor was switched off.
    expect(client.completeFramesOf(CAMERA).length - before).toBeLessThanOrEqual(2);
    client.sendSession({ type: 'sensors', sensors: [CAMERA] });
    const camera = client.completeFramesOf(CAMERA).length;
    await client.until(() => client.completeFramesOf(CAMERA).length >= camera + 20);
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
