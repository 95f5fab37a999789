/** The robot program's options, and what the robot is made of when they are right. */

import { randomBytes } from 'node:crypto';
import { readFileSync } from 'node:fs';
import { displayNameSchema, handleSchema, robotIdSchema, tokenSchema } from '@farpoint/protocol';
import { defaultDriveLimits } from '@farpoint/safety';
import {
  adminOptions,
  defineOption,
  defineProgram,
  OptionsError,
  type OptionTable,
  type OptionValues,
  schema,
} from '@farpoint/service';
import { DEFAULT_FOLDER } from '@farpoint/shared-memory';
import * as z from 'zod';
import type { SourceOptions } from './capture/open-source.ts';
import { PLAN_POLICIES } from './encode/plan.ts';
import { STREAM_MODES } from './encode/stream-mode.ts';
import type { RobotOptions } from './robot.ts';

const signalingUrlSchema = z
  .url({ protocol: /^wss?$/, error: 'must be a ws:// or wss:// address' })
  .refine((url) => new URL(url).search === '', 'must have no query');

const options = {
  signaling: defineOption({
    schema: signalingUrlSchema,
    default: 'ws://127.0.0.1:3000',
    argument: 'URL',
    help: 'signaling service, ws:// or wss://',
  }),
  tlsCa: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'FILE',
    help: 'PEM file of certificate authorities to trust for wss://, instead of the system’s',
  }),
  token: defineOption({
    schema: schema.optional(tokenSchema),
    default: null,
    argument: 'TOKEN',
    secret: true,
    help: 'token that the signaling service asks for',
  }),
  id: defineOption({
    schema: robotIdSchema,
    default: 'robot-1',
    argument: 'ID',
    help: 'the robot’s identity: a–z 0–9 . _ -',
  }),
  name: defineOption({
    schema: displayNameSchema,
    default: 'Robot',
    argument: 'NAME',
    help: 'what operators read',
  }),
  key: defineOption({
    schema: schema.optional(handleSchema),
    default: null,
    argument: 'KEY',
    secret: true,
    help: 'proves to signaling, also after a restart, that this is the same robot; random where left out',
  }),
  source: defineOption({
    schema: schema.choice(['sim', 'pcd', 'rgbd', 'shm', 'recording']),
    default: 'sim',
    argument: 'KIND',
    help: 'where the points come from: sim (a simulated robot), pcd (recorded clouds), rgbd (recorded colour and depth pictures), shm (a camera’s producer, through shared memory), recording (an MCAP file or a ROS 1 bag)',
  }),
  shmLayout: defineOption({
    schema: schema.choice(['farpoint', 'reference']),
    default: 'farpoint',
    argument: 'LAYOUT',
    help: 'shm: farpoint (frames as the camera gives them), or reference (the reference system’s packed points)',
  }),
  shmFolder: defineOption({
    schema: schema.text(),
    default: DEFAULT_FOLDER,
    argument: 'FOLDER',
    help: 'where the files of shared memory are, of source and sink',
  }),
  shmWaitS: defineOption({
    schema: schema.number({ min: 0, max: 3600 }),
    default: 10,
    argument: 'SECONDS',
    help: 'shm: how long to wait for the producer at the start',
  }),
  shmAccess: defineOption({
    schema: schema.choice(['owner', 'group']),
    default: 'owner',
    argument: 'WHO',
    help: 'who may read and write the files that --sink shm makes: owner (0600), or group (0660)',
  }),
  sink: defineOption({
    schema: schema.choice(['source', 'shm']),
    default: 'source',
    argument: 'KIND',
    help: 'where velocities go: source (the simulator’s wheels), shm (the reference system’s command block)',
  }),
  path: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'PATH',
    help: 'pcd: a .pcd file or a folder of them; rgbd: a folder as Open3D lays it out; recording: an MCAP file or a ROS 1 bag',
  }),
  pcdFrame: defineOption({
    schema: schema.choice(['auto', 'optical', 'body']),
    default: 'auto',
    argument: 'FRAME',
    help: 'axes of PCD points: optical (z forward), body (x forward, z up), or auto: optical for grids, else body',
  }),
  topic: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'TOPIC',
    help: 'recording: which clouds; left out, the topic with most of them',
  }),
  playRate: defineOption({
    schema: schema.number({ min: 0.01, max: 100 }),
    default: 1,
    argument: 'FACTOR',
    help: 'recording: how much faster than it was recorded',
  }),
  playFromS: defineOption({
    schema: schema.number({ min: 0 }),
    default: 0,
    argument: 'SECONDS',
    help: 'recording: where to begin',
  }),
  playEnd: defineOption({
    schema: schema.choice(['repeat', 'stop']),
    default: 'repeat',
    argument: 'WHAT',
    help: 'recording: at its end repeat, or stop with the last cloud',
  }),
  playAxes: defineOption({
    schema: schema.choice(['auto', 'optical', 'body']),
    default: 'auto',
    argument: 'AXES',
    help: 'recording: axes of the clouds’ frame: optical (z forward), body (x forward, z up), or auto: optical where its name says so',
  }),
  fps: defineOption({
    schema: schema.optional(schema.number({ min: 0.1, max: 120 })),
    default: null,
    argument: 'RATE',
    help: 'most frames a second that the source is asked for; left out, 60 of the simulated camera, 30 of recordings',
  }),
  simSeed: defineOption({
    schema: schema.integer({ min: 0, max: 0xffffffff }),
    default: 1,
    argument: 'SEED',
    help: 'seed of the simulated robot’s sensor noise',
  }),
  simSize: defineOption({
    schema: schema.integer({ min: 16, max: 1024 }),
    default: 480,
    argument: 'PIXELS',
    help: 'width and height of the simulated camera, a multiple of 4',
  }),
  bitrateMbps: defineOption({
    schema: schema.number({ min: 0.1, max: 1000 }),
    default: 60,
    argument: 'MBPS',
    help: 'most the stream to an operator may take on the wire, 10^6 bit/s, headers counted',
  }),
  rateControl: defineOption({
    schema: schema.choice(['adaptive', 'fixed']),
    default: 'adaptive',
    argument: 'KIND',
    help: 'adaptive: what the link is found to carry; fixed: always the most, halved on sustained loss',
  }),
  startMbps: defineOption({
    schema: schema.number({ min: 0.1, max: 1000 }),
    default: 3,
    argument: 'MBPS',
    help: 'rate of the first moments, before anything is known of the link, 10^6 bit/s',
  }),
  mode: defineOption({
    schema: schema.choice(STREAM_MODES),
    default: 'auto',
    argument: 'MODE',
    help: 'auto: the best format that the operator reads, the whole cloud where the rate allows; points64: the reference format, a sample of the cloud',
  }),
  plan: defineOption({
    schema: schema.choice(PLAN_POLICIES),
    default: 'latency',
    argument: 'POLICY',
    help: 'latency: as many frames a second as the rate makes pictures of; paper: every frame, points by its equations 2 and 3',
  }),
  maxPoints: defineOption({
    schema: schema.integer({ min: 150, max: 4_194_304 }),
    default: 4_194_304,
    argument: 'N',
    help: 'most points of a points64 frame, whatever the rate allows',
  }),
  lambda: defineOption({
    schema: schema.number({ min: 0, max: 64 }),
    // As the reference system ships. With 3 and more, a budget below the points nearer than D leaves nothing beyond it.
    default: 1,
    argument: 'L',
    help: 'how fast a point’s weight falls with depth; 0 draws evenly',
  }),
  epsilon: defineOption({
    schema: schema.number({ min: 1e-12, max: 1 }),
    default: 1e-6,
    argument: 'E',
    help: 'keeps the weight of the nearest points finite',
  }),
  priorityDistance: defineOption({
    schema: schema.number({ min: 0, max: 1000 }),
    default: 3.85,
    argument: 'METRES',
    help: 'points nearer than this weigh as much as the nearest',
  }),
  floor: defineOption({
    schema: schema.number({ min: 0, max: 1 }),
    default: 0.1,
    argument: 'FRACTION',
    help: 'with --plan paper: fraction of the raw cloud that is sent each second whatever the rate',
  }),
  maxLinear: defineOption({
    schema: schema.number({ min: 0.01, max: 10 }),
    default: defaultDriveLimits.maxLinear,
    argument: 'M/S',
    help: 'speed limit, m/s',
  }),
  maxAngular: defineOption({
    schema: schema.number({ min: 0.01, max: 10 }),
    default: defaultDriveLimits.maxAngular,
    argument: 'RAD/S',
    help: 'turning limit, rad/s',
  }),
  watchdogMs: defineOption({
    schema: schema.number({ min: 50, max: 1000 }),
    default: defaultDriveLimits.watchdogMs,
    argument: 'MS',
    help: 'without a fresh command for this long the robot stops',
  }),
  maxCommandsPerSecond: defineOption({
    schema: schema.number({ min: 10, max: 1000 }),
    default: defaultDriveLimits.maxCommandsPerSecond,
    argument: 'N',
    help: 'more commands a second are refused',
  }),
  takePolicy: defineOption({
    schema: schema.choice(['never', 'idle', 'always']),
    default: 'idle',
    argument: 'POLICY',
    help: 'may another operator take over: never, idle (where nothing has moved for 5 s), always',
  }),
  referenceSignaling: defineOption({
    schema: schema.optional(signalingUrlSchema),
    default: null,
    argument: 'URL',
    help: 'also register at this robots’ port of the reference system’s signaling; who connects there may watch and drive without proving who it is',
  }),
  maxOperators: defineOption({
    schema: schema.integer({ min: 1, max: 32 }),
    default: 4,
    argument: 'N',
    help: 'operators at once, the one who drives included',
  }),
  icePolicy: defineOption({
    schema: schema.choice(['all', 'relay']),
    default: 'all',
    argument: 'POLICY',
    help: 'relay: reach operators by TURN servers only',
  }),
  silenceS: defineOption({
    schema: schema.number({ min: 1, max: 300 }),
    default: 60,
    argument: 'SECONDS',
    help: 'an operator of whom nothing is heard for this long is gone; after 5 s of it another may drive',
  }),
  iceServers: defineOption({
    schema: schema.list(z.string().regex(/^(stun|turns?):/, 'must begin with stun:, turn: or turns:')),
    default: [],
    argument: 'URLS',
    help: 'STUN or TURN servers besides those of the signaling service',
  }),
  udpPorts: defineOption({
    schema: schema.optional(
      z
        .string()
        .regex(/^\d{1,5}-\d{1,5}$/, 'must be two ports, e.g. 40000-40100')
        .refine((text) => {
          const [low, high] = text.split('-').map(Number) as [number, number];
          return low >= 1 && low <= high && high <= 65_535;
        }, 'must be two ports, the lower first'),
    ),
    default: null,
    argument: 'LOW-HIGH',
    help: 'local UDP ports for operators’ connections; any where left out',
  }),
  packetLog: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'FILE',
    help: 'for measurements: when each packet was sent, as CSV, written when the robot stops',
  }),
  frameLog: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'FILE',
    help: 'for measurements: when each frame was captured and ready, as CSV, written when the robot stops',
  }),
  stats: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'FILE',
    help: 'for measurements: what each stream does in each 100 ms, one JSON object a line',
  }),
  record: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'FILE',
    help: 'record clouds, commands, telemetry, rate estimates and latencies to this MCAP file; there must be none yet',
  }),
  recordCapturedFps: defineOption({
    schema: schema.number({ min: 0.1, max: 120 }),
    default: 5,
    argument: 'RATE',
    help: 'record: most clouds a second as captured, 16 bytes a point; those sent are all recorded as sent, too',
  }),
  recordCompression: defineOption({
    schema: schema.choice(['none', 'zstd']),
    default: 'none',
    argument: 'KIND',
    help: 'record: none, or zstd (smaller, and more work for the processor)',
  }),
  niceness: defineOption({
    schema: schema.integer({ min: -20, max: 19 }),
    default: -5,
    argument: 'N',
    help: 'of this process, where the system lets it: commands and packets should not wait for the processor',
  }),
  ...adminOptions(9400),
} satisfies OptionTable;

export const robotProgram = defineProgram({
  name: 'farpoint-robot',
  summary: 'The robot peer: captures point clouds, fits them to the link, streams them, obeys safe commands.',
  version: '0.1.0',
  section: 'robot',
  options,
});

export type RobotOptionValues = OptionValues<typeof options>;

/** @throws {OptionsError} for what only shows when options are seen together, or a file that cannot be read */
export function toRobotOptions(values: RobotOptionValues): RobotOptions {
  const limits = {
    maxLinear: values.maxLinear,
    maxAngular: values.maxAngular,
    watchdogMs: values.watchdogMs,
    maxCommandsPerSecond: values.maxCommandsPerSecond,
  };
  const [low, high] = (values.udpPorts ?? '').split('-').map(Number);
  return {
    id: values.id,
    name: values.name,
    signaling: {
      url: values.signaling,
      key: values.key ?? randomBytes(16).toString('hex'),
      token: values.token,
      ca: values.tlsCa === null ? null : readText('--tls-ca', values.tlsCa),
    },
    capture: {
      source: toSource(values),
      framesPerSecond: values.fps ?? (values.source === 'sim' ? 60 : 30),
      plan: values.plan,
      sampling: { lambda: values.lambda, epsilon: values.epsilon, nearDistance: values.priorityDistance },
      floorFraction: values.floor,
      mostPoints: values.maxPoints,
      watchdogMs: values.watchdogMs,
    },
    sink:
      values.sink === 'shm'
        ? {
            kind: 'shm',
            folder: values.shmFolder,
            mode: values.shmAccess === 'group' ? 0o660 : 0o600,
            silenceMs: values.watchdogMs,
          }
        : { kind: 'source' },
    limits,
    takePolicy: values.takePolicy,
    referenceSignaling: values.referenceSignaling ?? undefined,
    bitsPerSecond: values.bitrateMbps * 1e6,
    mode: values.mode,
    rateControl: values.rateControl,
    startBitsPerSecond: values.startMbps * 1e6,
    maxOperators: values.maxOperators,
    silenceMs: values.silenceS * 1000,
    connectTimeoutMs: 20_000,
    iceServers: values.iceServers.map((urls) => ({ urls })),
    icePolicy: values.icePolicy,
    portRange: values.udpPorts === null ? undefined : [low as number, high as number],
    packetLog: values.packetLog ?? undefined,
    frameLog: values.frameLog ?? undefined,
    statisticsFile: values.stats ?? undefined,
    record:
      values.record === null
        ? undefined
        : {
            path: values.record,
            compression: values.recordCompression,
            capturedPerSecond: values.recordCapturedFps,
          },
  };
}

function toSource(values: RobotOptionValues): SourceOptions {
  const { source, path } = values;
  if (source === 'shm') {
    const { shmLayout: layout, shmFolder: folder } = values;
    return { kind: source, layout, folder, waitMs: values.shmWaitS * 1000 };
  }
  if (source !== 'sim') {
    if (path === null) throw new OptionsError('--path', `is needed for --source ${source}`);
    if (source === 'recording') {
      return {
        ...{ kind: source, path, topic: values.topic, rate: values.playRate, fromS: values.playFromS },
        ...{ atEnd: values.playEnd, axes: values.playAxes },
      };
    }
    return source === 'pcd' ? { kind: source, path, frame: values.pcdFrame } : { kind: source, path };
  }
  if (values.simSize % 4 !== 0) throw new OptionsError('--sim-size', 'must be a multiple of 4');
  return { kind: 'sim', seed: values.simSeed, size: values.simSize };
}

function readText(where: string, path: string): string {
  try {
    return readFileSync(path, 'utf8');
  } catch (error) {
    throw new OptionsError(
      where,
      `cannot be read: ${error instanceof Error ? error.message : String(error)}`,
    );
  }
}
