/**
 * The `control` channel, opened by the operator, unordered and never retransmitted: late messages are worthless.
 * Operator → robot: commands, clock probes, receiver reports and STOP. Robot → operator: answers to probes and to STOP.
 */
import * as z from 'zod/mini';
import { type EstopAck, type EstopPress, estopAckSchema, estopPressSchema } from './estop-press.ts';
import { type Twist, twistSchema } from './geometry.ts';
import { handleSchema, uint32Schema } from './identifiers.ts';
import type { JsonCodec } from './json.ts';

/**
 * The lease of commands by which an operator who does not drive says that its hand is open. They are not answered. A robot lets
 * no hand drive of which it does not know that it has been open before.
 */
export const NO_LEASE = 'none';

/** A requested velocity. It is valid only for the robot's watchdog time; without a valid command, the robot stops. */
export interface Command {
  type: 'command';
  /** Counts up by one for each command of this connection, wraps at 2³². */
  sequence: number;
  /** The operator's monotonic clock when the input was read, ms. A held stick or key is read anew each time. */
  timeMs: number;
  /** The lease under which the command is given (session-messages.ts), or {@link NO_LEASE}. */
  lease: string;
  /** True while the dead-man grip is held; without it, only a zero twist is accepted. */
  deadMan: boolean;
  /**
   * The grip was held when its device was last read, but that is too long ago to drive by: the robot brakes at once,
   * whatever the twist. Unlike a zero twist, it does not say that the hand has let go. Left out otherwise.
   */
  unread?: true | undefined;
  /**
   * linear.x in m/s and angular.z in rad/s of base_link, and linear.y in m/s where the robot's limits have `maxLateral`; every
   * other component is 0.
   */
  twist: Twist;
  /**
   * Capture time of the newest picture or cloud that is on the operator's screen: the robot's monotonic clock, µs, modulo
   * 2³². Left out by operators that show nothing or do not know.
   */
  seenUs?: number | undefined;
  /** Requests a latency-test frame: the next captured cloud is entirely green and is announced under this number. */
  latencyTest?: number | undefined;
}

/** Requests the robot's clock. */
export interface ClockProbe {
  type: 'clockProbe';
  id: number;
  /** The operator's monotonic clock at sending, ms. */
  sentMs: number;
}

export interface ClockAnswer {
  type: 'clockAnswer';
  id: number;
  sentMs: number;
  /** The robot's monotonic clock when the probe arrived, ms. */
  robotMs: number;
}

/** What the operator's page has received since the session began. The values are sums: a lost report does no harm. */
export interface ReceiverReport {
  type: 'receiverReport';
  sequence: number;
  packetsReceived: number;
  /** Gaps in the RTP sequence that were not filled. */
  packetsLost: number;
  bytesReceived: number;
}

export type OperatorControlMessage = Command | ClockProbe | ReceiverReport | EstopPress;
export type RobotControlMessage = ClockAnswer | EstopAck;

const timeMsSchema = z.number().check(z.minimum(0), z.maximum(Number.MAX_SAFE_INTEGER));
const countSchema = z.int().check(z.minimum(0));

export const commandSchema = z.strictObject({
  type: z.literal('command'),
  sequence: uint32Schema,
  timeMs: timeMsSchema,
  lease: handleSchema,
  deadMan: z.boolean(),
  unread: z.optional(z.literal(true)),
  twist: twistSchema,
  seenUs: z.optional(uint32Schema),
  latencyTest: z.optional(uint32Schema),
}) satisfies z.ZodMiniType<Command>;

const clockProbeSchema = z.strictObject({
  type: z.literal('clockProbe'),
  id: uint32Schema,
  sentMs: timeMsSchema,
});

const receiverReportSchema = z.strictObject({
  type: z.literal('receiverReport'),
  sequence: uint32Schema,
  packetsReceived: countSchema,
  packetsLost: countSchema,
  bytesReceived: countSchema,
});

export const operatorControlCodec: JsonCodec<OperatorControlMessage> = {
  what: 'operator control message',
  schema: z.discriminatedUnion('type', [
    commandSchema,
    clockProbeSchema,
    receiverReportSchema,
    estopPressSchema,
  ]),
  maxBytes: 1024,
};

const clockAnswerSchema = z.strictObject({
  type: z.literal('clockAnswer'),
  id: uint32Schema,
  sentMs: timeMsSchema,
  robotMs: timeMsSchema,
});

export const clockAnswerCodec: JsonCodec<ClockAnswer> = {
  what: 'clock answer',
  schema: clockAnswerSchema,
  maxBytes: 256,
};

/** Everything that the robot sends on the channel. */
export const robotControlCodec: JsonCodec<RobotControlMessage> = {
  what: 'robot control message',
  schema: z.discriminatedUnion('type', [clockAnswerSchema, estopAckSchema]),
  maxBytes: 256,
};

/** Why the robot did not act on a command. */
export const commandRejections = [
  'malformed', // not a command message
  'out-of-range', // beyond the robot's limits, or on an axis it does not have
  'stale', // sent too long ago
  'repeated', // a sequence number not after that of the last fresh command
  'not-permitted', // the operator's grant does not let it drive
  'not-lease-holder', // another operator drives, or nobody has requested the lease
  'dead-man-released', // motion requested without the grip
  'let-go-first', // motion with a grip that was held while no command got through for too long
  'no-wheels', // nothing that moves the wheels takes the robot's velocities
  'estop-latched', // the emergency stop must be released first
  'rate-limited', // more commands per second than the robot reads
] as const;
/**
 * Why the robot did not act on a command.
 *
 * @useDeclaredType
 */
export type CommandRejection = (typeof commandRejections)[number];
