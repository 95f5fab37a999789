/**
 * `pnpm bench dds`: clouds from a ROS 2 node of another implementation to the robot's packets, and velocities back to
 * it.
 */
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { DdsGraph } from '@farpoint/dds';
import { buildAddon } from '@farpoint/dds/build';
import { findPeer, PEER_REMEDY, Peer, testDomain } from '@farpoint/dds/testing';
import { LocalStack, processFolder } from '@farpoint/local-stack';
import { SignaledOperator } from '@farpoint/robot-node/testing';
import { VELOCITY_QOS, velocityWriter } from '@farpoint/ros';
import { benchOptions, type OptionValues, option } from './bench-options.ts';
import { cpuSecondsOfTree } from './cpu-time.ts';
import { type MeasuredSpan, measuredSpan, monotonicMs, wait } from './measured-span.ts';
import { type Bench, distributionCells, printJson, printTable } from './report.ts';
import { FrameColours, readFrameLog, residentPeakMb } from './robot-frames.ts';
import { type Distribution, distribution, rounded } from './stats.ts';

const USAGE = `pnpm bench dds [--peer fastdds|python] [--side 480] [--hz 10] [--seconds 20] [--mbps 20] [--reliability best-effort|reliable] [--json]

A node on another DDS implementation publishes PointCloud2 of side × side points --hz times a second. The real robot process
(--source ros2 --sink ros2) samples them for --mbps and sends them to an operator in this process, who drives meanwhile.
Latency: from when the node starts to serialise a cloud until the robot has its packets ready. Every cloud has its own colour:
torn counts frames that arrived with two colours. Drive: from the operator's command until the node receives that Twist.
Round trip: of a Twist from a graph in this process to the node and back. Loopback.`;

const PEERS = { fastdds: 'Fast DDS', python: 'Python' } as const;
const ROBOT = 'dds-1';
const WARM_UP_MS = 2000;
const COMMAND_MS = 20;
const TWIST = 'geometry_msgs/msg/Twist';

const OPTIONS = {
  peer: option.choice('fastdds', ['fastdds', 'python']),
  side: option.number(480, { least: 1 }),
  hz: option.number(10, { least: 0.1 }),
  seconds: option.number(20, { least: 1 }),
  mbps: option.number(20, { least: 1 }),
  reliability: option.choice('best-effort', ['reliable', 'best-effort']),
};

export const bench: Bench = {
  name: 'dds',
  summary: 'a ROS 2 node on another DDS implementation: latency of clouds to packets, velocities, round trip',
  usage: USAGE,
  async run(argv) {
    const { json, peer, ...settings } = benchOptions(argv, OPTIONS);
    const { ok, output } = buildAddon();
    if (!ok) throw new Error(`the addon does not build:\n${output}`);
    const kind = PEERS[peer];
    const command = findPeer(kind);
    if (command === null) throw new Error(`no ${kind} here: ${PEER_REMEDY[kind]}`);
    const result = await measure({ command, ...settings });
    print(result);
    if (json) {
      const points = settings.side * settings.side;
      printJson({ bench: 'dds', kind, ...settings, points, ...result });
    }
  },
};

function print(result: DdsResult): void {
  printTable(
    ['ms', 'p50', 'p95', 'p99', 'max'],
    [
      ['cloud to packets', ...distributionCells(result.latencyMs)],
      ['command to Twist', ...distributionCells(result.driveMs)],
      ['Twist there and back', ...distributionCells(result.roundTripMs)],
    ],
  );
  printTable(
    ['frames/s', 'torn', 'robot, MB', 'robot, cores', 'node, cores', 'Twists', 'commands'],
    [
      [
        result.framesPerSecond,
        result.torn,
        result.rssMbMax,
        result.robotCpu,
        result.peerCpu,
        result.twists,
        result.commands,
      ],
    ],
  );
}

interface Run extends Omit<OptionValues<typeof OPTIONS>, 'peer' | 'json'> {
  /** Command that starts the node. */
  command: string[];
}

interface DdsResult {
  latencyMs: Distribution;
  driveMs: Distribution;
  roundTripMs: Distribution;
  framesPerSecond: number;
  frames: number;
  torn: number;
  rssMbMax: number;
  robotCpu: number | null;
  peerCpu: number | null;
  commands: number;
  /** Velocities that the node received, out of the commands sent. */
  twists: number;
}

async function measure({ command, side, hz, seconds, mbps, reliability }: Run): Promise<DdsResult> {
  const folder = processFolder();
  const [frameLog, config] = [join(folder, 'frames.csv'), join(folder, 'farpoint.yaml')];
  const domain = testDomain();
  writeFileSync(config, configuration(domain, reliability));
  const peer = await Peer.start(command, {
    domain,
    cloud: 'rt/points',
    side,
    hz,
    reliability,
    twist: 'rt/cmd_vel',
    echo: 'rt/echo',
  });
  let stack: LocalStack | null = null;
  try {
    const roundTripMs = await roundTrips(domain);
    const rate = ['--rate-control', 'fixed', '--plan', 'paper', '--bitrate-mbps', String(mbps)];
    const args = ['--config', config, '--measure', folder, ...rate];
    stack = await LocalStack.start({
      robots: [{ id: ROBOT, name: 'Robot in a ROS 2 graph', args }],
      env: { FARPOINT_LOG_LEVEL: 'warn' },
    });
    const driven = await drive(stack, peer, seconds);
    await stack.stop();
    return resultOf(driven, roundTripMs, frameLog);
  } finally {
    await stack?.stop();
    await peer.kill();
  }
}

/** The operator's records, and those of the programs. */
interface Driven {
  span: MeasuredSpan<'robot' | 'peer'>;
  colours: FrameColours;
  driving: Driving;
  rssMbMax: number;
}

/** Connects an operator, who drives all the while, and measures once the robot has found its pace. */
async function drive(stack: LocalStack, peer: Peer, seconds: number): Promise<Driven> {
  const robotPid = stack.robot(ROBOT).pid;
  const operator = await SignaledOperator.connect(stack.signalingUrl, ROBOT);
  const colours = new FrameColours();
  const driving = new Driving(operator, peer, await operator.client.takeLease());
  await wait(WARM_UP_MS);
  operator.client.onCloudPacket = (payload) => colours.add(payload);
  driving.forget();
  const cpu = () => ({ robot: cpuSecondsOfTree(robotPid), peer: cpuSecondsOfTree(peer.pid) });
  const span = await measuredSpan(cpu, () => wait(seconds * 1000));
  const rssMbMax = residentPeakMb(robotPid);
  driving.stop();
  operator.client.onCloudPacket = null;
  await operator.close();
  return { span, colours, driving, rssMbMax };
}

function resultOf(
  { span, colours, driving, rssMbMax }: Driven,
  roundTripMs: Distribution,
  frameLog: string,
): DdsResult {
  const frames = readFrameLog(frameLog).filter(
    ({ readyMs }) => readyMs >= span.beginMs && readyMs < span.endMs,
  );
  return {
    // The stamp is the time at which the node began to make the message; the robot converts it to its own clock.
    latencyMs: rounded(distribution(frames.map(({ capturedMs, readyMs }) => readyMs - capturedMs)), 2),
    driveMs: rounded(distribution(driving.latenciesMs), 2),
    roundTripMs,
    framesPerSecond: Number(((frames.length * 1000) / span.elapsedMs).toFixed(2)),
    frames: frames.length,
    torn: colours.torn,
    rssMbMax,
    robotCpu: span.cores.robot,
    peerCpu: span.cores.peer,
    commands: driving.commands,
    twists: driving.latenciesMs.length,
  };
}

function configuration(domain: number, reliability: string): string {
  return `
robot:
  source: { kind: ros2, fps: 120 }
  sink: { kind: ros2 }
  ros: { domain: ${domain}, reach: localhost }
  topics:
    - { topic: /points, as: cloud, qos: { reliability: ${reliability} } }
    - { topic: /cmd_vel, as: velocity }
`;
}

/** Commands at 50 Hz, each with a different speed, so that each resulting Twist can be identified. */
class Driving {
  commands = 0;
  latenciesMs: number[] = [];
  readonly #sentMs = new Map<number, number>();
  readonly #timer: NodeJS.Timeout;
  #speed = 0;

  constructor({ client }: SignaledOperator, peer: Peer, lease: string) {
    this.#timer = setInterval(() => {
      // Thousandths of a metre per second, from 0.05 m/s up.
      this.#speed = 50 + ((this.#speed + 1) % 100);
      this.#sentMs.set(this.#speed, monotonicMs());
      this.commands++;
      client.drive(lease, this.#speed / 1000);
    }, COMMAND_MS);
    peer.onTwist = ({ x, ms }) => {
      const speed = Math.round(x * 1000);
      const sentMs = this.#sentMs.get(speed);
      if (sentMs === undefined) return;
      this.#sentMs.delete(speed);
      this.latenciesMs.push(ms - sentMs);
    };
  }

  forget(): void {
    this.latenciesMs = [];
    this.commands = 0;
  }

  stop(): void {
    clearInterval(this.#timer);
  }
}

/** Round trips of Twists to the node and back, one at a time. */
async function roundTrips(domain: number): Promise<Distribution> {
  const graph = new DdsGraph({ domain, localhostOnly: true, env: {} });
  const write = velocityWriter(2, TWIST);
  const publisher = graph.advertise({ topic: '/cmd_vel', type: TWIST, qos: VELOCITY_QOS });
  let heard = 0;
  graph.subscribe({ topic: '/echo', type: TWIST, queue: 1, qos: VELOCITY_QOS }, () => heard++);
  const zero = { x: 0, y: 0, z: 0 };
  const bytes = write({ linear: zero, angular: zero }, 0n, '');
  const times: number[] = [];
  // The first ones include discovery.
  for (let i = 0; i < 300; i++) {
    const had = heard;
    const begin = monotonicMs();
    publisher.publish(bytes);
    while (heard === had && monotonicMs() - begin < 1000)
      await new Promise((resolve) => setImmediate(resolve));
    if (i >= 50 && heard > had) times.push(monotonicMs() - begin);
    await wait(5);
  }
  await graph.close();
  return rounded(distribution(times), 2);
}
