/**
 * The `telemetry` channel, opened by the robot, unordered, with a short lifetime: the robot's state, 20 times per
 * second, what is near it, samples of quantities, readings, diagnostics, its navigator's path and its map, its joints, and
 * when clouds and commands passed its stations.
 */
import * as z from 'zod/mini';
import { type Diagnostics, diagnosticsSchema } from './diagnostics.ts';
import { type Pose, poseSchema, type Twist, twistSchema } from './geometry.ts';
import { uint32Schema } from './identifiers.ts';
import type { JsonCodec } from './json.ts';
import { type MapTiles, mapTilesSchema } from './map-tiles.ts';
import { type MotionState, motionStateSchema } from './motion-state.ts';
import { type NearField, nearFieldSchema } from './near-field.ts';
import { type PlannedPath, plannedPathSchema } from './planned-path.ts';
import { type Samples, samplesSchema } from './quantity.ts';
import { type Reading, readingSchema } from './reading.ts';
import { type JointPositions, jointPositionsSchema } from './robot-model.ts';
import { type StageTimes, stageTimesSchema } from './stage-times.ts';

/** Whether the robot is driving, and if not, why. */
export const driveStates = [
  'driving', // following fresh commands
  'idle', // nobody holds the lease, or the holder requests no motion
  'watchdog', // no fresh command for the watchdog time: braking or standing
  'estop', // the emergency stop is latched
  'blocked', // in contact with an obstacle, or held by what `motion` names
] as const;
/**
 * Why the robot stands still, or that it does not.
 *
 * @useDeclaredType
 */
export type DriveState = (typeof driveStates)[number];

/** State of the robot's battery: what of it is known. */
export interface Battery {
  /** Volts. Absent if unknown. */
  voltage?: number | undefined;
  /** 0–1, as in sensor_msgs/BatteryState. Absent if unknown. */
  percentage?: number | undefined;
}

/** Mean time that a frame spent in each stage during the last telemetry interval, ms. */
export interface StageTimings {
  /** Reading or rendering the cloud. */
  captureMs: number;
  /** Choosing the points that are sent. */
  sampleMs: number;
  /** Writing or coding the packets. */
  packMs: number;
  /** From the first packet sent to the last. */
  sendMs: number;
}

/** What was sent to this operator, and what was dropped. Rates over the last second. */
export interface StreamStatus {
  /** The newest frame that was sent; wraps at 2³². */
  frameNumber: number;
  /** Frames sent a second. */
  framesPerSecond: number;
  /** Points sent in a frame, mean. */
  pointsPerFrame: number;
  /** Valid points of the raw cloud. */
  validPoints: number;
  /** Sent a second. */
  bitsPerSecond: number;
  /** The rate that the rate controller allows. */
  targetBitsPerSecond: number;
  /** Frames dropped before sending since the session began, because the queue was full. */
  droppedFrames: number;
  /** The connection gives no transport-wide feedback, so the rate follows receiver reports. Absent if it does. */
  feedback?: 'reports' | undefined;
}

/** The robot's state, 20 times a second. */
export interface Telemetry {
  type: 'telemetry';
  /** Counts up, wraps at 2³². */
  sequence: number;
  /** Robot's monotonic clock, ms. */
  timeMs: number;
  /** How much earlier pose and twist were measured, ms; absent if then. It grows when the odometry has stopped. */
  ageMs?: number | undefined;
  /** Pose of base_link in the world frame. */
  pose: Pose;
  /** Measured velocity of base_link. */
  twist: Twist;
  /** Absent if the robot has no battery gauge. */
  battery?: Battery | undefined;
  /** Why the robot stands still, or that it does not. */
  drive: DriveState;
  /** What the robot makes of the driver's wish. Left out by robots that do not bound it. */
  motion?: MotionState | undefined;
  /** How long a frame takes on the robot. */
  stages: StageTimings;
  /** What leaves the robot for this operator. */
  stream: StreamStatus;
  /** How many operators are connected. */
  operators: number;
}

const nonNegative = z.number().check(z.minimum(0));
const count = z.int().check(z.minimum(0));

export type TelemetryMessage =
  | Telemetry
  | NearField
  | Reading
  | Samples
  | Diagnostics
  | PlannedPath
  | MapTiles
  | JointPositions
  | StageTimes;

const telemetrySchema = z.strictObject({
  type: z.literal('telemetry'),
  sequence: uint32Schema,
  timeMs: nonNegative,
  ageMs: z.optional(nonNegative),
  pose: poseSchema,
  twist: twistSchema,
  battery: z.optional(
    z.strictObject({
      voltage: z.optional(nonNegative),
      percentage: z.optional(z.number().check(z.minimum(0), z.maximum(1))),
    }),
  ),
  drive: z.enum(driveStates),
  motion: z.optional(motionStateSchema),
  stages: z.strictObject({
    captureMs: nonNegative,
    sampleMs: nonNegative,
    packMs: nonNegative,
    sendMs: nonNegative,
  }),
  stream: z.strictObject({
    frameNumber: uint32Schema,
    framesPerSecond: nonNegative,
    pointsPerFrame: nonNegative,
    validPoints: count,
    bitsPerSecond: nonNegative,
    targetBitsPerSecond: nonNegative,
    droppedFrames: count,
    feedback: z.optional(z.literal('reports')),
  }),
  operators: count,
}) satisfies z.ZodMiniType<Telemetry>;

export const telemetryCodec: JsonCodec<TelemetryMessage> = {
  what: 'telemetry message',
  schema: z.discriminatedUnion('type', [
    telemetrySchema,
    nearFieldSchema,
    readingSchema,
    samplesSchema,
    diagnosticsSchema,
    plannedPathSchema,
    mapTilesSchema,
    jointPositionsSchema,
    stageTimesSchema,
  ]),
  maxBytes: 4096,
};
