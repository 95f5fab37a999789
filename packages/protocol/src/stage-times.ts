/**
 * `stages` on the `telemetry` channel: when clouds and commands passed the stations that lie on the robot. With its own
 * instants and the robot's clock, an operator's page knows of each frame and each command which stage took how long.
 */
import * as z from 'zod/mini';
import { uint32Schema } from './identifiers.ts';
import { MAX_SENSORS } from './placement.ts';

/** Rows of each kind in a message: the longest ones of both kinds fit a message of the channel, 4096 bytes. */
export const MOST_STAGE_ROWS = 32;
/** A later instant is told as this one, µs: whoever waits for a minute has lost the session. */
export const MOST_STAGE_US = 60_000_000;

/**
 * A frame that was sent to this operator. All instants are the robot's monotonic clock, as µs since the capture, and none is
 * before the one that precedes it.
 */
export type FrameTimes = [
  sensor: number,
  frameNumber: number,
  /** Of its capture, µs, modulo 2³², as in its packets. */
  captureUs: number,
  /** Its cloud was in the robot's memory. */
  memoryUs: number,
  /** Its packets were ready. */
  encodedUs: number,
  /** The first packet was handed to the transport. */
  firstUs: number,
  /** The last packet was handed to the transport; of a frame that was cut short, the last one that was sent. */
  lastUs: number,
];

/** A command that the robot has judged. */
export type CommandTimes = [
  sequence: number,
  /** When it came: robot's monotonic clock, µs, modulo 2³². */
  receivedUs: number,
  /** When the drive guard had judged it, µs since it came. */
  judgedUs: number,
  /** When the drive had the velocity that follows from it, µs since it came; `null`: it was refused. */
  wheelsUs: number | null,
];

/** When frames and commands passed the stations on the robot, in the order in which they did. */
export interface StageTimes {
  type: 'stages';
  /** Those that were sent since the last message. */
  frames: FrameTimes[];
  /** Those that were judged since the last message. */
  commands: CommandTimes[];
}

const sinceSchema = z.int().check(z.minimum(0), z.maximum(MOST_STAGE_US));

export const stageTimesSchema = z.strictObject({
  type: z.literal('stages'),
  frames: z
    .array(
      z
        .tuple([
          z.int().check(z.minimum(0), z.maximum(MAX_SENSORS - 1)),
          uint32Schema,
          uint32Schema,
          sinceSchema,
          sinceSchema,
          sinceSchema,
          sinceSchema,
        ])
        .check(z.refine(isInOrder, 'no instant may be before the one that precedes it')),
    )
    .check(z.maxLength(MOST_STAGE_ROWS)),
  commands: z
    .array(
      z
        .tuple([uint32Schema, uint32Schema, sinceSchema, z.nullable(sinceSchema)])
        .check(
          z.refine(
            ([, , judgedUs, wheelsUs]) => wheelsUs === null || wheelsUs >= judgedUs,
            'the drive has a command after the guard',
          ),
        ),
    )
    .check(z.maxLength(MOST_STAGE_ROWS)),
}) satisfies z.ZodMiniType<StageTimes>;

function isInOrder([, , , memoryUs, encodedUs, firstUs, lastUs]: Readonly<FrameTimes>): boolean {
  return memoryUs <= encodedUs && encodedUs <= firstUs && firstUs <= lastUs;
}
