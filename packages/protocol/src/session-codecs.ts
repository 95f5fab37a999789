/** The messages of the `session` channel as JSON: what is read is checked. */
import * as z from 'zod';
import { CLOUD_FORMATS } from './cloud-format.ts';
import { commandRejections } from './control.ts';
import { displayNameSchema, handleSchema, robotIdSchema, uint32Schema } from './identifiers.ts';
import type { JsonCodec } from './json.ts';
import { MAX_CAMERAS } from './picture-chunk.ts';
import { MAX_SENSORS } from './placement.ts';
import type { OperatorSessionMessage, RobotSessionMessage } from './session-messages.ts';

const positive = z.number().positive();
const sensorSchema = z
  .int()
  .min(0)
  .max(MAX_SENSORS - 1);
/** A palette of 256 colours with its tables is 2,210 bytes. */
const MAX_STREAM_HEADER_BASE64 = 3200;
/** A test that takes longer has failed. */
const MAX_LATENCY_MS = 60_000;

export const robotSessionCodec: JsonCodec<RobotSessionMessage> = {
  what: 'robot session message',
  schema: z.discriminatedUnion('type', [
    z.strictObject({
      type: z.literal('welcome'),
      protocol: z.int().min(1),
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
        width: z.int().positive(),
        height: z.int().positive(),
        framesPerSecond: positive,
      }),
      resumeKey: handleSchema.optional(),
    }),
    z.strictObject({
      type: z.literal('lease'),
      holder: z.enum(['you', 'other', 'nobody']),
      lease: handleSchema.optional(),
    }),
    z.strictObject({
      type: z.literal('rejected'),
      sequence: uint32Schema.optional(),
      reason: z.enum(commandRejections),
      detail: z.string().max(512),
      count: z.int().min(1),
    }),
    z.strictObject({
      type: z.literal('estop'),
      latched: z.boolean(),
      by: z.enum(['operator', 'robot']).optional(),
    }),
    z.strictObject({
      type: z.literal('latencyFrame'),
      id: uint32Schema,
      frameNumber: uint32Schema,
      points: z.int().min(0),
      commandMs: z.number(),
      captureMs: z.number(),
    }),
    z.strictObject({
      type: z.literal('cloudStream'),
      format: z.enum(['organised', 'unorganised']),
      header: z.base64().min(1).max(MAX_STREAM_HEADER_BASE64),
      sensor: sensorSchema.optional(),
    }),
    z.strictObject({
      type: z.literal('cameras'),
      cameras: z.array(z.strictObject({ name: displayNameSchema })).max(MAX_CAMERAS),
    }),
    z.strictObject({
      type: z.literal('sensors'),
      sensors: z.array(z.strictObject({ name: displayNameSchema })).max(MAX_SENSORS),
    }),
    z.strictObject({ type: z.literal('fault'), message: z.string().max(512) }),
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
      formats: z.array(z.enum(CLOUD_FORMATS)).max(CLOUD_FORMATS.length),
    }),
    z.strictObject({
      type: z.literal('pictures'),
      cameras: z
        .array(
          z
            .int()
            .min(0)
            .max(MAX_CAMERAS - 1),
        )
        .max(MAX_CAMERAS),
    }),
    z.strictObject({ type: z.literal('sensors'), sensors: z.array(sensorSchema).max(MAX_SENSORS) }),
    z.strictObject({
      type: z.literal('latencyMeasured'),
      id: uint32Schema,
      frameNumber: uint32Schema,
      mtpMs: z.number().min(0).max(MAX_LATENCY_MS),
      firstMs: z.number().min(0).max(MAX_LATENCY_MS),
    }),
  ]),
  maxBytes: 1024,
};
