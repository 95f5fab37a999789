/** The `session` channel, opened by the robot, ordered and reliable: the lease, how the stream is coded, refusals. */
import * as z from 'zod/mini';
import { CLOUD_FORMATS, type CloudFormat } from './cloud-format.ts';
import { type CommandRejection, commandRejections } from './control.ts';
import { displayNameSchema, handleSchema, robotIdSchema, uint32Schema } from './identifiers.ts';
import type { JsonCodec } from './json.ts';
import { MAX_CAMERAS } from './picture-chunk.ts';
import { MAX_SENSORS } from './placement.ts';

/** The robot's drive limits. No message can raise any of them. */
export interface DriveLimits {
  /** m/s, forward and backward. */
  maxLinear: number;
  /** rad/s. */
  maxAngular: number;
  /** Without a fresh command for this long, the robot brakes to zero. */
  watchdogMs: number;
  /** The most commands per second that are read. */
  maxCommandsPerSecond: number;
}

/** The robot's first message in every session. */
export interface Welcome {
  type: 'welcome';
  protocol: number;
  robotId: string;
  name: string;
  limits: DriveLimits;
  stream: { format: 'points64'; width: number; height: number; framesPerSecond: number };
  /**
   * Proves to the robot that a `session.resume` comes from this session's operator. Without it, the session cannot be
   * resumed.
   */
  resumeKey?: string | undefined;
}

/** Who may drive. Only the operator that holds the lease gets `lease`. */
export interface LeaseState {
  type: 'lease';
  holder: 'you' | 'other' | 'nobody';
  lease?: string | undefined;
}

export interface CommandRejected {
  type: 'rejected';
  /** The command's sequence number, if it was readable. */
  sequence?: number | undefined;
  reason: CommandRejection;
  /** For people: what is wrong and where. */
  detail: string;
  /** How many were refused for this reason since the last such message; these are sent at most 10 times per second. */
  count: number;
}

export interface EstopState {
  type: 'estop';
  latched: boolean;
  /** Who latched it, if it is latched. */
  by?: 'operator' | 'robot' | undefined;
}

/** Announces the frame that answers a latency test. */
export interface LatencyFrame {
  type: 'latencyFrame';
  id: number;
  frameNumber: number;
  points: number;
  /** Robot's monotonic clock, ms: when the command arrived, when the frame was captured. */
  commandMs: number;
  captureMs: number;
}

/**
 * The parameters for decoding packets of a coded format. Sent before the first such packet, and again whenever they
 * change. A receiver that cannot use them sends `cloudFormats` without that format.
 */
export interface CloudStream {
  type: 'cloudStream';
  format: Exclude<CloudFormat, 'points64'>;
  /** The format's own stream header, base64. */
  header: string;
  /** Which sensor's clouds; if absent, those of sensor 0. */
  sensor?: number | undefined;
}

/**
 * The robot's cameras whose pictures it can send; a camera's position in the list is its number. Follows the welcome.
 */
export interface Cameras {
  type: 'cameras';
  cameras: { name: string }[];
}

/**
 * The sensors whose clouds the robot can send; a sensor's position in the list is its number in the placement. Sent
 * after the welcome by robots with more than one sensor.
 */
export interface Sensors {
  type: 'sensors';
  sensors: { name: string }[];
}

/** A message of the operator, other than a command, that the robot could not use. */
export interface SessionFault {
  type: 'fault';
  message: string;
}

export type RobotSessionMessage =
  | Welcome
  | LeaseState
  | CommandRejected
  | EstopState
  | LatencyFrame
  | CloudStream
  | Cameras
  | Sensors
  | SessionFault;

/** Requests the lease. `take` asks to take over from another operator; the robot's policy decides. */
export interface LeaseRequest {
  type: 'leaseRequest';
  take: boolean;
}
export interface LeaseRelease {
  type: 'leaseRelease';
}
/** Latches or releases the emergency stop. Anyone may latch it; only the lease holder may release it. */
export interface EstopRequest {
  type: 'estop';
  latch: boolean;
}
/** Starts or pauses the stream of points to this operator. */
export interface StreamRequest {
  type: 'stream';
  running: boolean;
}

/** The formats that the operator reads. Before this message it gets `points64`, which may be sent to it at any time. */
export interface CloudFormats {
  type: 'cloudFormats';
  formats: CloudFormat[];
}

/** The cameras whose pictures the operator wants from now on, by number. Before this message, none are sent. */
export interface Pictures {
  type: 'pictures';
  cameras: number[];
}

/**
 * The sensors whose clouds the operator wants from now on, by number. Before this message it gets those of sensor 0.
 */
export interface WantedSensors {
  type: 'sensors';
  sensors: number[];
}

/** The result of a latency test, for the robot's recording. */
export interface LatencyMeasured {
  type: 'latencyMeasured';
  /** The `id` from the command's {@link LatencyFrame}, and the frame that was drawn. */
  id: number;
  frameNumber: number;
  /**
   * From the input event to the end of the display frame that shows the whole green cloud, and to the one that shows
   * its first points, ms.
   */
  mtpMs: number;
  firstMs: number;
}

export type OperatorSessionMessage =
  | LeaseRequest
  | LeaseRelease
  | EstopRequest
  | StreamRequest
  | CloudFormats
  | Pictures
  | WantedSensors
  | LatencyMeasured;

export const PROTOCOL_VERSION = 1;

const positive = z.number().check(z.positive());
const cameraSchema = z.int().check(z.minimum(0), z.maximum(MAX_CAMERAS - 1));
const sensorSchema = z.int().check(z.minimum(0), z.maximum(MAX_SENSORS - 1));
/** A palette of 256 colours with its tables takes 2,210 bytes. */
const MAX_STREAM_HEADER_BASE64 = 3200;
/** A test that takes longer has failed. */
const MAX_LATENCY_MS = 60_000;
const latencyMsSchema = z.number().check(z.minimum(0), z.maximum(MAX_LATENCY_MS));

export const robotSessionCodec: JsonCodec<RobotSessionMessage> = {
  what: 'robot session message',
  schema: z.discriminatedUnion('type', [
    z.strictObject({
      type: z.literal('welcome'),
      protocol: z.int().check(z.minimum(1)),
      robotId: robotIdSchema,
      name: displayNameSchema,
      limits: z.strictObject({
        maxLinear: positive,
        maxAngular: positive,
        watchdogMs: positive,
        maxCommandsPerSecond: positive,
      }),
      stream: z.strictObject({
        format: z.literal('points64'),
        width: z.int().check(z.positive()),
        height: z.int().check(z.positive()),
        framesPerSecond: positive,
      }),
      resumeKey: z.optional(handleSchema),
    }),
    z.strictObject({
      type: z.literal('lease'),
      holder: z.enum(['you', 'other', 'nobody']),
      lease: z.optional(handleSchema),
    }),
    z.strictObject({
      type: z.literal('rejected'),
      sequence: z.optional(uint32Schema),
      reason: z.enum(commandRejections),
      detail: z.string().check(z.maxLength(512)),
      count: z.int().check(z.minimum(1)),
    }),
    z.strictObject({
      type: z.literal('estop'),
      latched: z.boolean(),
      by: z.optional(z.enum(['operator', 'robot'])),
    }),
    z.strictObject({
      type: z.literal('latencyFrame'),
      id: uint32Schema,
      frameNumber: uint32Schema,
      points: z.int().check(z.minimum(0)),
      commandMs: z.number(),
      captureMs: z.number(),
    }),
    z.strictObject({
      type: z.literal('cloudStream'),
      format: z.enum(['organised', 'unorganised']),
      header: z.base64().check(z.minLength(1), z.maxLength(MAX_STREAM_HEADER_BASE64)),
      sensor: z.optional(sensorSchema),
    }),
    z.strictObject({
      type: z.literal('cameras'),
      cameras: z.array(z.strictObject({ name: displayNameSchema })).check(z.maxLength(MAX_CAMERAS)),
    }),
    z.strictObject({
      type: z.literal('sensors'),
      sensors: z.array(z.strictObject({ name: displayNameSchema })).check(z.maxLength(MAX_SENSORS)),
    }),
    z.strictObject({ type: z.literal('fault'), message: z.string().check(z.maxLength(512)) }),
  ]),
  maxBytes: 4096,
};

export const operatorSessionCodec: JsonCodec<OperatorSessionMessage> = {
  what: 'operator session message',
  schema: z.discriminatedUnion('type', [
    z.strictObject({ type: z.literal('leaseRequest'), take: z.boolean() }),
    z.strictObject({ type: z.literal('leaseRelease') }),
    z.strictObject({ type: z.literal('estop'), latch: z.boolean() }),
    z.strictObject({ type: z.literal('stream'), running: z.boolean() }),
    z.strictObject({
      type: z.literal('cloudFormats'),
      formats: z.array(z.enum(CLOUD_FORMATS)).check(z.maxLength(CLOUD_FORMATS.length)),
    }),
    z.strictObject({
      type: z.literal('pictures'),
      cameras: z.array(cameraSchema).check(z.maxLength(MAX_CAMERAS)),
    }),
    z.strictObject({
      type: z.literal('sensors'),
      sensors: z.array(sensorSchema).check(z.maxLength(MAX_SENSORS)),
    }),
    z.strictObject({
      type: z.literal('latencyMeasured'),
      id: uint32Schema,
      frameNumber: uint32Schema,
      mtpMs: latencyMsSchema,
      firstMs: latencyMsSchema,
    }),
  ]),
  maxBytes: 1024,
};
