/** The messages of the `session` channel as JSON: what is read is checked. */
import * as z from 'zod/mini';
import { alarmSchema } from './alarm.ts';
import { CLOUD_FORMATS } from './cloud-format.ts';
import { commandRejections } from './control.ts';
import { estopCauseSchema } from './estop-cause.ts';
import {
  driveAnswerSchema,
  driveAskSchema,
  driveOfferSchema,
  driveWithdrawSchema,
  handoverSchema,
} from './handover.ts';
import { displayNameSchema, handleSchema, robotIdSchema, uint32Schema } from './identifiers.ts';
import type { JsonCodec } from './json.ts';
import { MAX_CAMERAS } from './picture-chunk.ts';
import { MAX_SENSORS } from './placement.ts';
import { pointedSchema, pointingSchema, pointSchema } from './pointing.ts';
import { operatorsSchema, roles } from './present-operators.ts';
import { quantitySchema } from './quantity.ts';
import { robotAboutSchema } from './robot-about.ts';
import {
  commandCallSchema,
  commandCancelSchema,
  commandRefusedSchema,
  commandRunSchema,
  recordingStateSchema,
  robotCommandSchema,
} from './robot-command.ts';
import { robotModelSchema } from './robot-model.ts';
import { sensorRingsSchema, sensorSchema } from './sensor-rings.ts';
import {
  afterGapChoices,
  faultReasons,
  MOST_RESUME_MS,
  type RobotSessionMessage,
} from './session-messages.ts';
import type { OperatorSessionMessage } from './session-requests.ts';
import { MICROPHONE_STATES, VOICE_STATES } from './sound-media.ts';
import { MAX_VIDEOS, VIDEO_CODECS } from './video-media.ts';

const positive = z.number().check(z.positive());
const cameraSchema = z.int().check(z.minimum(0), z.maximum(MAX_CAMERAS - 1));
const videoSchema = z.int().check(z.minimum(0), z.maximum(MAX_VIDEOS - 1));
const secondsSchema = z.int().check(z.minimum(0), z.maximum(Number.MAX_SAFE_INTEGER));
const weightSchema = z.int().check(z.minimum(1), z.maximum(100));
/** An SDP token (RFC 8866 §9) that fits a one-byte header extension. */
export const midSchema = z.string().check(z.regex(/^[!#-'*+.0-9A-Z^-~-]{1,16}$/));
const soundDetailSchema = z.string().check(z.maxLength(256));
/** A palette of 256 colours with its tables is 2,210 bytes. */
const MAX_STREAM_HEADER_BASE64 = 3200;
export const streamHeaderSchema = z.base64().check(z.minLength(1), z.maxLength(MAX_STREAM_HEADER_BASE64));
export const videoDescriptionSchema = z.strictObject({
  name: displayNameSchema,
  mid: midSchema,
  codec: z.enum(VIDEO_CODECS),
  fault: z.optional(z.string().check(z.maxLength(256))),
  ofSensor: z.optional(sensorSchema),
});
/** A test that takes longer has failed. */
const MAX_LATENCY_MS = 60_000;
const latencyMsSchema = z.number().check(z.minimum(0), z.maximum(MAX_LATENCY_MS));

/** Of what an operator's computer draws; one that draws less shows no world that moves. */
const [LEAST_DISPLAYED_FPS, MOST_DISPLAYED_FPS] = [1, 240];
const [LEAST_DISPLAYED_POINTS, MOST_DISPLAYED_POINTS] = [1000, 1e8];

/** A robot that claims to go sideways faster than the fastest that may be configured (limits.ts) is not believed, m/s. */
const MOST_LATERAL_MPS = 10;
/** Corners farther from base_link are no robot's, m. */
const MOST_REACH_M = 10;
const reachSchema = z.number().check(z.minimum(-MOST_REACH_M), z.maximum(MOST_REACH_M));
const bodySchema = z.strictObject({
  footprint: z
    .array(z.strictObject({ x: reachSchema, y: reachSchema }))
    .check(z.minLength(3), z.maxLength(64)),
  decelerationMps2: positive,
  accelerationMps2: z.optional(positive),
  turnRadps2: z.optional(positive),
  heights: z.optional(
    z
      .strictObject({
        clearanceM: z.number().check(z.minimum(0)),
        heightM: z.number().check(z.positive(), z.maximum(MOST_REACH_M)),
        dropM: z.number().check(z.positive(), z.maximum(MOST_REACH_M)),
        slope: z.number().check(z.minimum(0), z.maximum(1)),
      })
      .check(z.refine(({ clearanceM, heightM }) => clearanceM < heightM, 'clearanceM must be below heightM')),
  ),
});

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
        maxLateral: z.optional(z.number().check(z.minimum(0), z.maximum(MOST_LATERAL_MPS))),
        maxAngular: positive,
        watchdogMs: positive,
        maxCommandsPerSecond: positive,
        afterGap: z.optional(z.enum(afterGapChoices)),
        resumeWithinMs: z.optional(z.number().check(z.minimum(0), z.maximum(MOST_RESUME_MS))),
      }),
      body: z.optional(bodySchema),
      stream: z.strictObject({
        format: z.literal('points64'),
        width: z.int().check(z.positive()),
        height: z.int().check(z.positive()),
        framesPerSecond: positive,
      }),
      resumeKey: z.optional(handleSchema),
      access: z.optional(
        z.strictObject({ role: z.enum(roles), name: displayNameSchema, expiresInS: secondsSchema }),
      ),
    }),
    z.strictObject({
      type: z.literal('lease'),
      holder: z.enum(['you', 'other', 'nobody']),
      lease: z.optional(handleSchema),
      driver: z.optional(displayNameSchema),
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
      releasedAt: z.optional(z.literal('robot')),
      latch: z.optional(uint32Schema),
      press: z.optional(uint32Schema),
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
      header: streamHeaderSchema,
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
    z.strictObject({
      type: z.literal('videos'),
      videos: z.array(videoDescriptionSchema).check(z.maxLength(MAX_VIDEOS)),
    }),
    z.strictObject({
      type: z.literal('sound'),
      mid: midSchema,
      microphone: z.optional(
        z.strictObject({ state: z.enum(MICROPHONE_STATES), detail: z.optional(soundDetailSchema) }),
      ),
      voice: z.optional(
        z.strictObject({ state: z.enum(VOICE_STATES), detail: z.optional(soundDetailSchema) }),
      ),
    }),
    estopCauseSchema,
    robotAboutSchema,
    sensorRingsSchema,
    robotModelSchema,
    quantitySchema,
    alarmSchema,
    z.strictObject({ type: z.literal('expires'), inS: secondsSchema }),
    operatorsSchema,
    handoverSchema,
    robotCommandSchema,
    commandRunSchema,
    commandRefusedSchema,
    recordingStateSchema,
    pointingSchema,
    pointedSchema,
    z.strictObject({
      type: z.literal('fault'),
      message: z.string().check(z.maxLength(512)),
      reason: z.optional(z.enum(faultReasons)),
    }),
  ]),
  maxBytes: 4096,
};

export const operatorSessionCodec: JsonCodec<OperatorSessionMessage> = {
  what: 'operator session message',
  schema: z.discriminatedUnion('type', [
    z.strictObject({ type: z.literal('leaseRequest'), take: z.boolean() }),
    z.strictObject({ type: z.literal('leaseRelease') }),
    z.strictObject({
      type: z.literal('estop'),
      latch: z.boolean(),
      press: z.optional(uint32Schema),
      of: z.optional(uint32Schema),
    }),
    driveAskSchema,
    driveOfferSchema,
    driveAnswerSchema,
    driveWithdrawSchema,
    commandCallSchema,
    commandCancelSchema,
    pointSchema,
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
      type: z.literal('videos'),
      videos: z.array(videoSchema).check(z.maxLength(MAX_VIDEOS)),
      barcode: z.optional(z.boolean()),
    }),
    z.strictObject({
      type: z.literal('display'),
      framesPerSecond: z.number().check(z.minimum(LEAST_DISPLAYED_FPS), z.maximum(MOST_DISPLAYED_FPS)),
      points: z.int().check(z.minimum(LEAST_DISPLAYED_POINTS), z.maximum(MOST_DISPLAYED_POINTS)),
    }),
    z.strictObject({ type: z.literal('listen'), on: z.boolean() }),
    z.strictObject({ type: z.literal('speak'), held: z.boolean() }),
    z.strictObject({ type: z.literal('endSession'), operator: uint32Schema, block: z.boolean() }),
    z.strictObject({
      type: z.literal('shares'),
      cloud: weightSchema,
      videos: z.array(weightSchema).check(z.maxLength(MAX_VIDEOS)),
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
