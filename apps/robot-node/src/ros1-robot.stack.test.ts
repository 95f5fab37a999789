/** The real robot program in a ROS 1 graph: a real master, rospy nodes, signaling, WebRTC. */
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { LocalStack } from '@farpoint/local-stack';
import { PictureCodec } from '@farpoint/pictures';
import { type WholePicture, writeTile } from '@farpoint/protocol';
import { type Ros1Node, Ros1Peers } from '@farpoint/ros/testing/ros1';
import { eventually } from '@farpoint/service/testing/eventually';
import { useFolder } from '@farpoint/service/testing/folder';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { SignaledOperator } from './testing/signaled-operator.ts';
import { driveUntil } from './testing/steady-hand.ts';

const ROBOT = 'ros-1';
/** What the node's front camera sees, from the left. */
const BARS = [
  [255, 0, 0],
  [0, 255, 0],
  [0, 0, 255],
  [255, 255, 255],
];
const { python, missing } = Ros1Peers.find();
const configuration = (master: string) => `
robot:
  source: { kind: ros1 }
  sink: { kind: ros1 }
  ros: { master: '${master}', hostname: 127.0.0.1 }
  topics:
    - { topic: /points, as: cloud }
    - { topic: /camera_info, as: cameraInfo }
    - { topic: /odom, as: pose }
    - { topic: /battery, as: battery }
    - { topic: /temperature, type: std_msgs/Float32, as: text, label: Temperature }
    - { topic: /diagnostics, as: diagnostics }
    - { topic: /plan, as: path }
    - { topic: /map, as: map }
    - { topic: /cmd_vel, as: velocity }
`;

const cameras = (master: string) => `
robot:
  source: { kind: ros1 }
  ros: { master: '${master}', hostname: 127.0.0.1 }
  topics:
    - { topic: /points, as: cloud }
    - { topic: /camera_info, as: cameraInfo }
    - { topic: /front/image_raw, as: picture, label: Front }
    - { topic: /rear/image_raw/compressed, as: picture, label: Rear }
    - { topic: /mast/image_raw, as: picture, label: Mast }
`;

const images = (master: string) => `
robot:
  source: { kind: ros1 }
  ros: { master: '${master}', hostname: 127.0.0.1 }
  topics:
    - { topic: /rgbd/depth, as: depth }
    - { topic: /rgbd/colour, as: colour }
    - { topic: /rgbd/camera_info, as: cameraInfo }
`;

describe.skipIf(python === null)(
  `robot process in a ROS 1 graph (${missing ?? 'rosmaster, rospy'})`,
  {
    timeout: 60_000,
  },
  () => {
    const folder = useFolder();
    let peers: Ros1Peers;
    let base: Ros1Node;
    let stack: LocalStack;
    let operator: SignaledOperator;

    beforeAll(async () => {
      peers = await Ros1Peers.open(python ?? '');
      await peers.startCore();
      await peers.startNode('cloud,state,diagnostics,navigator', 'camera');
      base = await peers.startNode('velocity', 'base');
      const config = join(folder, 'farpoint.yaml');
      writeFileSync(config, configuration(peers.masterUrl));
      stack = await LocalStack.start({ robots: [{ id: ROBOT, name: 'Robot', args: ['--config', config] }] });
      operator = await SignaledOperator.connect(stack.signalingUrl, ROBOT);
    }, 60_000);

    afterAll(async () => {
      await operator?.close();
      await stack?.stop();
      await peers?.close();
    }, 30_000);

    const silentFor = () => performance.now() - (base.heard.at(-1)?.atMs ?? 0);
    /** Drives with a grip that was released first. */
    async function drive(lease: string): Promise<void> {
      operator.client.drive(lease, 0);
      await driveUntil(operator.client, lease, 0.25, () => base.heard.at(-1)?.x === 0.25 && silentFor() < 50);
    }

    it('streams the clouds, placed by odometry, and reports its velocity and battery', async () => {
      const { client } = operator;
      await client.until(() => client.completeFrames.length > 5);
      expect(client.malformedPackets).toBe(0);
      await client.until(() => client.telemetry?.battery !== undefined);
      expect(client.telemetry).toMatchObject({
        pose: { position: { x: 3 } },
        twist: { linear: { x: 0.125 } },
        battery: { percentage: 0.75 },
      });
      await client.until(() => client.readings.size === 6);
      expect(client.readings.get('/battery')).toMatchObject({
        label: 'Battery',
        values: [
          ['', '75 %'],
          ['', '25.1 V'],
        ],
      });
      expect(client.readings.get('/temperature')).toMatchObject({
        label: 'Temperature',
        values: [['', '21.5']],
      });
      expect(client.readings.get('/diagnostics')).toMatchObject({
        ...{ label: 'Diagnostics', level: 'warn' },
        values: [
          ['left motor', '71 degrees, which is too warm to go on for long'],
          ['', '1 of 2 OK'],
        ],
      });
    });

    it('tells the navigator’s path, and its map, which was published once before the robot came', async () => {
      const { client } = operator;
      await client.until(() => client.newest.path !== undefined && client.newest.map !== undefined);
      const corners = [
        [3, 0],
        [5, 0],
        [5, 2],
      ];
      expect(client.newest.path).toMatchObject({ topic: '/plan', points: corners });
      expect(client.readings.get('/plan')).toMatchObject({ label: 'Path', values: [['', '4.0 m']] });
      const { map } = client.newest;
      if (map === undefined) throw new Error('no map');
      expect(map).toMatchObject({ width: 40, height: 2, cellM: 0.5, origin: { x: -1, y: 0, yaw: 0 } });
      const cells = new Uint8Array(80);
      for (const [index, runs] of map.tiles) writeTile(map, index, runs, cells);
      expect([...cells]).toEqual([...Array(40).fill(1), ...Array(39).fill(3), 0]);
    });

    it('streams depth and colour images of one camera', async () => {
      const node = await peers.startNode('rgbd', 'rgbd');
      const config = join(folder, 'rgbd.yaml');
      writeFileSync(config, images(peers.masterUrl));
      await stack.startRobot({
        id: 'ros-2',
        name: 'Robot',
        args: ['--config', config, '--max-points', '6000'],
      });
      const watcher = await SignaledOperator.connect(stack.signalingUrl, 'ros-2');
      const colours = new Set<number>();
      watcher.client.onCloudPacket = (payload) => {
        // The first point's colour follows the coordinates of all points: 6 bits red, 6 green, 4 blue.
        const points = payload.readUInt32LE(12) / 8;
        colours.add(payload.readUInt16LE(16 + points * 6));
      };
      await watcher.client.until(() => watcher.client.completeFrames.length > 5);
      expect([...colours]).toEqual([((255 >> 2) << 10) | ((128 >> 2) << 4)]);
      await watcher.close();
      await stack.robot('ros-2').stop();
      await node.kill();
    });

    it('sends cameras’ pictures: raw ones are shrunk, and neither a broken file nor a silent camera stops the others', async () => {
      const node = await peers.startNode('pictures', 'cameras');
      const config = join(folder, 'cameras.yaml');
      writeFileSync(config, cameras(peers.masterUrl));
      // At a fixed rate: a busy machine delays packets like a bad link, which then carries no pictures.
      const args = ['--config', config, '--max-points', '600', '--rate-control', 'fixed'];
      await stack.startRobot({ id: 'ros-3', name: 'Robot', args });
      const watcher = await SignaledOperator.connect(stack.signalingUrl, 'ros-3');
      const { client } = watcher;
      expect((await client.message('cameras')).cameras).toEqual(
        ['Front', 'Rear', 'Mast'].map((name) => ({ name })),
      );
      client.sendSession({ type: 'pictures', cameras: [0, 1, 2] });
      await client.until(() => (client.pictures.get(0)?.pictureId ?? 0) >= 3 && client.pictures.has(1));
      const { width, height, format, bytes } = client.pictures.get(0) as WholePicture;
      expect({ width, height, format }).toEqual({ width: 640, height: 480, format: 'jpeg' });
      const { rgba } = (await PictureCodec.load()).decode('jpeg', bytes, width * height);
      for (const [bar, colour] of BARS.entries()) {
        const at = 4 * ((height / 2) * width + ((bar + 0.5) * width) / BARS.length);
        const away = colour.map((level, i) => Math.abs(level - (rgba[at + i] ?? Number.NaN)));
        expect(Math.max(...away), `bar ${bar}`).toBeLessThan(20);
      }
      // The file says that it has so many pixels, and only who decodes it finds that it has none.
      expect(client.pictures.get(1)).toMatchObject({ format: 'jpeg', width: 320, height: 240 });
      expect(client.pictures.has(2)).toBe(false);
      // The clouds go on when the cameras have gone.
      await node.kill();
      const clouds = client.completeFrames.length;
      await client.until(() => client.completeFrames.length > clouds + 5);
      await watcher.close();
      await stack.robot('ros-3').stop();
    });

    it('publishes zero when it is asked to end, and nothing more when it is killed: then the base’s own timeout applies', async () => {
      const lease = await operator.client.takeLease();
      await drive(lease);
      await stack.robot(ROBOT).stop();
      await eventually(() => base.heard.at(-1)?.x === 0);
      await operator.close();
      await stack.restartRobot(ROBOT);
      operator = await SignaledOperator.connect(stack.signalingUrl, ROBOT);
      const { client } = operator;
      await client.until(() => client.readings.get('/cmd_vel')?.level === 'ok');
      await drive(await operator.client.takeLease());
      await stack.robot(ROBOT).kill();
      await eventually(() => silentFor() > 500);
      expect(base.heard.at(-1)?.x).toBe(0.25);
    });
  },
);
