/**
 * Farpoint's own signaling: JSON text over one WebSocket, `/robot` for robots and `/operator` for operators. A session
 * is one operator with one robot; the robot offers, the operator answers, ICE trickles, the service only introduces:
 * a session outlives the loss of either signaling socket for as long as its peers hear each other.
 */
import * as z from 'zod';
import { displayNameSchema, handleSchema, robotIdSchema, tokenSchema } from '../identifiers.ts';
import type { JsonCodec } from '../json.ts';

export const MAX_SIGNALING_BYTES = 65_536;

const sdpSchema = z.string().min(1).max(60_000);

/** RTCIceCandidateInit; an empty `candidate` ends the candidates. */
export const iceCandidateSchema = z.strictObject({
  candidate: z.string().max(1024),
  sdpMid: z.string().max(64).nullable().optional(),
  sdpMLineIndex: z.int().min(0).max(64).nullable().optional(),
  usernameFragment: z.string().max(256).nullable().optional(),
});
export type IceCandidate = z.infer<typeof iceCandidateSchema>;

/** RTCIceServer, as the service hands it to both peers. */
export const iceServerSchema = z.strictObject({
  urls: z.union([z.string(), z.array(z.string())]),
  username: z.string().optional(),
  credential: z.string().optional(),
});
export type IceServer = z.infer<typeof iceServerSchema>;

/** Why a session ended, as told to the other peer. */
export const sessionEndReasons = [
  'operator-left',
  'robot-left',
  'closed-by-operator',
  'closed-by-robot',
] as const;
export type SessionEndReason = (typeof sessionEndReasons)[number];

/** Why the service refuses a message. After `fatal` ones it closes the socket. */
export const signalingErrorCodes = [
  'malformed', // not a message of this protocol
  'too-large',
  'rate-limited',
  'hello-first', // the first message must say who you are
  'unauthorized', // token missing or wrong: fatal
  'robot-id-taken', // a live robot of another key has this id: fatal
  'unknown-robot', // no such robot here now
  'unknown-session', // not a session of yours
  'too-many-sessions',
  'unsupported-protocol', // `protocol` of the hello is not spoken here: fatal
  'full', // no room for another robot or operator: fatal
  'shutting-down', // come back in a moment: fatal
] as const;
export type SignalingErrorCode = (typeof signalingErrorCodes)[number];

const error = z.strictObject({
  type: z.literal('error'),
  code: z.enum(signalingErrorCodes),
  message: z.string().max(1024),
  session: handleSchema.optional(),
});

const sessionOffer = z.strictObject({
  type: z.literal('session.offer'),
  session: handleSchema,
  sdp: sdpSchema,
});
const sessionAnswer = z.strictObject({
  type: z.literal('session.answer'),
  session: handleSchema,
  sdp: sdpSchema,
});
const sessionCandidate = z.strictObject({
  type: z.literal('session.candidate'),
  session: handleSchema,
  candidate: iceCandidateSchema,
});
const sessionClose = z.strictObject({ type: z.literal('session.close'), session: handleSchema });
const sessionClosed = z.strictObject({
  type: z.literal('session.closed'),
  session: handleSchema,
  reason: z.enum(sessionEndReasons),
});

const robotListing = z.strictObject({ id: robotIdSchema, name: displayNameSchema });
/** A robot that is here now. */
export type RobotListing = z.infer<typeof robotListing>;

const robotsChanged = z.strictObject({
  type: z.literal('robots.changed'),
  /** Who came, or changed its name. */
  here: z.array(robotListing),
  /** Ids of who went. */
  gone: z.array(robotIdSchema),
});
export type RobotsChanged = z.infer<typeof robotsChanged>;

const robotToService = z.discriminatedUnion('type', [
  z.strictObject({
    type: z.literal('robot.hello'),
    protocol: z.int().min(1),
    id: robotIdSchema,
    name: displayNameSchema,
    /** Made by the robot, kept over reconnects: proves that a second socket for the same id is the same robot. */
    key: handleSchema,
    token: tokenSchema.optional(),
  }),
  sessionOffer,
  sessionCandidate,
  sessionClose,
]);
export type RobotToService = z.infer<typeof robotToService>;

const serviceToRobot = z.discriminatedUnion('type', [
  z.strictObject({
    type: z.literal('robot.welcome'),
    id: robotIdSchema,
    iceServers: z.array(iceServerSchema),
  }),
  /** An operator asks for a session: offer. */
  z.strictObject({ type: z.literal('session.request'), session: handleSchema, operator: displayNameSchema }),
  /** The operator hears nothing in this session: offer an ICE restart, or close a session that you do not have. */
  z.strictObject({ type: z.literal('session.resume'), session: handleSchema, operator: displayNameSchema }),
  sessionAnswer,
  sessionCandidate,
  sessionClosed,
  error,
]);
export type ServiceToRobot = z.infer<typeof serviceToRobot>;

const operatorToService = z.discriminatedUnion('type', [
  z.strictObject({
    type: z.literal('operator.hello'),
    protocol: z.int().min(1),
    name: displayNameSchema,
    token: tokenSchema.optional(),
  }),
  z.strictObject({ type: z.literal('session.open'), robotId: robotIdSchema }),
  /**
   * For a session that has connected once: its path is silent. Also where the service has forgotten the session with an
   * earlier socket of either side. Answered with `session.opened`; the robot offers an ICE restart.
   */
  z.strictObject({ type: z.literal('session.resume'), session: handleSchema, robotId: robotIdSchema }),
  sessionAnswer,
  sessionCandidate,
  sessionClose,
]);
export type OperatorToService = z.infer<typeof operatorToService>;

const serviceToOperator = z.discriminatedUnion('type', [
  z.strictObject({ type: z.literal('operator.welcome'), iceServers: z.array(iceServerSchema) }),
  /** Every robot that is here now; sent after the welcome, and to an operator that fell far behind. */
  z.strictObject({ type: z.literal('robots'), robots: z.array(robotListing) }),
  /** What has changed since the last `robots` or `robots.changed`. */
  robotsChanged,
  z.strictObject({ type: z.literal('session.opened'), session: handleSchema, robotId: robotIdSchema }),
  sessionOffer,
  sessionCandidate,
  sessionClosed,
  error,
]);
export type ServiceToOperator = z.infer<typeof serviceToOperator>;

export const robotToServiceCodec: JsonCodec<RobotToService> = {
  what: 'message from robot',
  schema: robotToService,
  maxBytes: MAX_SIGNALING_BYTES,
};
export const serviceToRobotCodec: JsonCodec<ServiceToRobot> = {
  what: 'message to robot',
  schema: serviceToRobot,
  maxBytes: MAX_SIGNALING_BYTES,
};
export const operatorToServiceCodec: JsonCodec<OperatorToService> = {
  what: 'message from operator',
  schema: operatorToService,
  maxBytes: MAX_SIGNALING_BYTES,
};
/** Larger: it lists every robot. */
export const serviceToOperatorCodec: JsonCodec<ServiceToOperator> = {
  what: 'message to operator',
  schema: serviceToOperator,
  maxBytes: 1_048_576,
};
