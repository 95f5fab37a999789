/** `pnpm bench ros1`: clouds from a rospy node to the robot's packets. */
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { LocalStack, processFolder } from '@farpoint/local-stack';
import { SignaledOperator } from '@farpoint/robot-node/testing';
import { Ros1Peers } from '@farpoint/ros/testing/ros1';
import { benchOptions, option } from './bench-options.ts';
import { cpuSecondsOfTree } from './cpu-time.ts';
import { measuredSpan, wait } from './measured-span.ts';
import { type Bench, distributionCells, printJson, printTable } from './report.ts';
import { readFrameLog, residentPeakMb } from './robot-frames.ts';
import { distribution, rounded } from './stats.ts';

const USAGE = `pnpm bench ros1 [--hz 10] [--seconds 20] [--mbps 20] [--as points|picture|images] [--json]

A rospy node under a real ROS 1 master publishes PointCloud2 of 480 × 480 points, 20 bytes each, --hz times a second. The
real robot process (--source ros1) samples them for --mbps and sends them to an operator in this process. With --as picture
the CameraInfo is named too, and the cloud is taken as a depth image; with --as images depth (16UC1) and colour (rgb8) come
as images. Latency: from the stamp, which the node takes right before it publishes, until the robot has the packets ready.
Loopback.`;

const FORMS = ['points', 'picture', 'images'] as const;
const ROBOT = 'ros-1';
const WARM_UP_MS = 2000;

export const bench: Bench = {
  name: 'ros1',
  summary: 'a ROS 1 graph: latency of rospy’s clouds to packets, processor, memory',
  usage: USAGE,
  async run(argv) {
    const { json, ...options } = benchOptions(argv, {
      hz: option.number(10, { least: 0.1 }),
      seconds: option.number(20, { least: 1 }),
      mbps: option.number(20, { least: 1 }),
      as: option.choice('points', FORMS),
    });
    const { python, missing } = Ros1Peers.find();
    if (python === null) throw new Error(missing);
    const result = await measure(python, options);
    const { latencyMs, framesPerSecond, rssMbMax, robotCpu, nodeCpu } = result;
    printTable(['ms', 'p50', 'p95', 'p99', 'max'], [['stamp to packets', ...distributionCells(latencyMs)]]);
    printTable(
      ['frames/s', 'robot, MB', 'robot, cores', 'node, cores'],
      [[framesPerSecond, rssMbMax, robotCpu, nodeCpu]],
    );
    if (json) printJson({ bench: 'ros1', ...options, ...result });
  },
};

interface Options {
  as: (typeof FORMS)[number];
  hz: number;
  seconds: number;
  mbps: number;
}

async function measure(python: string, { as, hz, seconds, mbps }: Options) {
  const folder = processFolder();
  const [frameLog, config] = [join(folder, 'frames.csv'), join(folder, 'farpoint.yaml')];
  const peers = await Ros1Peers.open(python);
  let stack: LocalStack | null = null;
  try {
    await peers.startCore();
    const node = await peers.startNode(as === 'images' ? 'rgbd' : 'cloud', 'camera', hz);
    writeFileSync(config, configuration(peers.masterUrl, as));
    const rate = ['--rate-control', 'fixed', '--plan', 'paper', '--bitrate-mbps', String(mbps)];
    const args = ['--config', config, '--measure', folder, ...rate];
    stack = await LocalStack.start({
      robots: [{ id: ROBOT, name: 'Robot in a ROS 1 graph', args }],
      env: { FARPOINT_LOG_LEVEL: 'warn' },
    });
    const robotPid = stack.robot(ROBOT).pid;
    const operator = await SignaledOperator.connect(stack.signalingUrl, ROBOT);
    await wait(WARM_UP_MS);
    const cpu = () => ({ robot: cpuSecondsOfTree(robotPid), node: cpuSecondsOfTree(node.pid) });
    const { beginMs, endMs, elapsedMs, cores } = await measuredSpan(cpu, () => wait(seconds * 1000));
    const rssMbMax = residentPeakMb(robotPid);
    await operator.close();
    await stack.stop();
    const frames = readFrameLog(frameLog).filter(({ readyMs }) => readyMs >= beginMs && readyMs < endMs);
    return {
      latencyMs: rounded(distribution(frames.map(({ capturedMs, readyMs }) => readyMs - capturedMs)), 2),
      framesPerSecond: Number(((frames.length * 1000) / elapsedMs).toFixed(2)),
      frames: frames.length,
      rssMbMax,
      robotCpu: cores.robot,
      nodeCpu: cores.node,
    };
  } finally {
    await stack?.stop();
    await peers.close();
  }
}

const TOPICS: Record<Options['as'], readonly (readonly [topic: string, as: string])[]> = {
  points: [['/points', 'cloud']],
  picture: [
    ['/points', 'cloud'],
    ['/camera_info', 'cameraInfo'],
  ],
  images: [
    ['/rgbd/depth', 'depth'],
    ['/rgbd/colour', 'colour'],
    ['/rgbd/camera_info', 'cameraInfo'],
  ],
};

function configuration(master: string, as: Options['as']): string {
  return `
robot:
  source: { kind: ros1, fps: 120 }
  ros: { master: '${master}', hostname: 127.0.0.1 }
  topics:
${TOPICS[as].map(([topic, role]) => `    - { topic: ${topic}, as: ${role} }`).join('\n')}
`;
}
