/**
 * Farpoint's own signaling: JSON text over one WebSocket, `/robot` for robots and `/operator` for operators. A session
 * is one operator with one robot; the robot offers, the operator answers, ICE trickles, the service only introduces:
 * a session outlives the loss of either signaling socket for as long as its peers hear each other.
 */
import * as z from 'zod/mini';
import { displayNameSchema, handleSchema, robotIdSchema, tokenSchema } from '../identifiers.ts';
import type { JsonCodec } from '../json.ts';

export const MAX_SIGNALING_BYTES = 65_536;

const sdpSchema = z.string().check(z.minLength(1), z.maxLength(60_000));

/** RTCIceCandidateInit; an empty `candidate` ends the candidates. */
export const iceCandidateSchema = z.strictObject({
  candidate: z.string().check(z.maxLength(1024)),
  sdpMid: z.optional(z.nullable(z.string().check(z.maxLength(64)))),
  sdpMLineIndex: z.optional(z.nullable(z.int().check(z.minimum(0), z.maximum(64)))),
  usernameFragment: z.optional(z.nullable(z.string().check(z.maxLength(256)))),
});
export type IceCandidate = z.infer<typeof iceCandidateSchema>;

/** RTCIceServer, as the service hands it to both peers. */
export const iceServerSchema = z.strictObject({
  urls: z.union([z.string(), z.array(z.string())]),
  username: z.optional(z.string()),
  credential: z.optional(z.string()),
});
export type IceServer = z.infer<typeof iceServerSchema>;

/** Why a session ended, as told to the robot. */
export const operatorEndReasons = ['operator-left', 'closed-by-operator'] as const;
export type OperatorEndReason = (typeof operatorEndReasons)[number];

/** Why a robot ends a session, or does not begin it. */
export const robotCloseReasons = [
  'robot-full', // as many operators as it takes
  'bad-answer', // the SDP answer, or what it agrees to, cannot be used
  'unproven-peer', // its certificate is not the one that the answer names, or it did not prove that the key is its own
  'not-connected', // no connection came about in time
  'connection-lost', // DTLS or a channel ended
  'silent', // nothing was heard of the operator for too long
  'not-reading', // reliable messages piled up
  'shutting-down',
] as const;
export type RobotCloseReason = (typeof robotCloseReasons)[number];

/** Why a session ended, as told to the operator. */
export const robotEndReasons = [
  ...robotCloseReasons,
  'robot-left', // its socket to the service closed
  'closed-by-robot', // it gave no reason
  'unknown-session', // it does not have the session that was to be resumed
] as const;
export type RobotEndReason = (typeof robotEndReasons)[number];

/** Why a robot does not resume a session. */
export const resumeRefusals = [
  'unknown-session', // it does not have it
  'wrong-resume-key', // who asks has not proven that the session is its own
  'resume-too-soon', // the last offer waits for its answer, or has only just been answered
] as const;
export type ResumeRefusal = (typeof resumeRefusals)[number];

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
  'wrong-resume-key', // the robot refused a session.resume; nothing else has changed
  'resume-too-soon', // the same: ask again later
  'unsupported-protocol', // `protocol` of the hello is not spoken here: fatal
  'full', // no room for another robot or operator: fatal
  'shutting-down', // come back in a moment: fatal
] as const;
export type SignalingErrorCode = (typeof signalingErrorCodes)[number];

const error = z.strictObject({
  type: z.literal('error'),
  code: z.enum(signalingErrorCodes),
  message: z.string().check(z.maxLength(1024)),
  session: z.optional(handleSchema),
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
/** What may come with a robot's reason. */
const robotEndFields = {
  /** With `robot-full`: how many operators it takes. */
  maxOperators: z.optional(z.int().check(z.minimum(0), z.maximum(1_000_000))),
  /** For people: what exactly was wrong. */
  detail: z.optional(z.string().check(z.maxLength(300))),
};

const robotListing = z.strictObject({ id: robotIdSchema, name: displayNameSchema });
/** A robot that is here now. */
export interface RobotListing {
  /** Its id at the signaling service. */
  id: string;
  /** Its name, for people. */
  name: string;
}

const robotsChanged = z.strictObject({
  type: z.literal('robots.changed'),
  /** Who came, or changed its name. */
  here: z.array(robotListing),
  /** Ids of who went. */
  gone: z.array(robotIdSchema),
});
export interface RobotsChanged {
  type: 'robots.changed';
  here: RobotListing[];
  gone: string[];
}

const robotToService = z.discriminatedUnion('type', [
  z.strictObject({
    type: z.literal('robot.hello'),
    protocol: z.int().check(z.minimum(1)),
    id: robotIdSchema,
    name: displayNameSchema,
    /** Made by the robot, kept over reconnects: proves that a second socket for the same id is the same robot. */
    key: handleSchema,
    token: z.optional(tokenSchema),
  }),
  /** `claim` where it answers a `session.resume`. */
  z.extend(sessionOffer, { claim: z.optional(handleSchema) }),
  sessionCandidate,
  z.extend(sessionClose, { reason: z.optional(z.enum(robotCloseReasons)), ...robotEndFields }),
  /** Does not resume a session; nothing else changes. */
  z.strictObject({
    type: z.literal('session.refuse'),
    session: handleSchema,
    claim: handleSchema,
    code: z.enum(resumeRefusals),
  }),
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
  /**
   * Somebody says that it is this session's operator and hears nothing. With the session's key: offer an ICE restart under
   * this claim; else refuse it.
   */
  z.strictObject({
    type: z.literal('session.resume'),
    session: handleSchema,
    operator: displayNameSchema,
    /** Made by the service: tells its askers apart. */
    claim: handleSchema,
    resumeKey: handleSchema,
  }),
  sessionAnswer,
  sessionCandidate,
  z.strictObject({
    type: z.literal('session.closed'),
    session: handleSchema,
    reason: z.enum(operatorEndReasons),
  }),
  error,
]);
export type ServiceToRobot = z.infer<typeof serviceToRobot>;

const operatorToService = z.discriminatedUnion('type', [
  z.strictObject({
    type: z.literal('operator.hello'),
    protocol: z.int().check(z.minimum(1)),
    name: displayNameSchema,
    token: z.optional(tokenSchema),
  }),
  z.strictObject({ type: z.literal('session.open'), robotId: robotIdSchema }),
  /**
   * For a session that has connected once: its path is silent. Also where the service has forgotten the session with an
   * earlier socket of either side. Answered with `session.resuming`; then, where the robot accepts, with `session.opened` and
   * its offer of an ICE restart.
   */
  z.strictObject({
    type: z.literal('session.resume'),
    session: handleSchema,
    robotId: robotIdSchema,
    /** What the robot told this session's operator in its welcome. */
    resumeKey: handleSchema,
  }),
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
  /** `session.resume` was passed on to the robot. */
  z.strictObject({ type: z.literal('session.resuming'), session: handleSchema }),
  sessionOffer,
  sessionCandidate,
  z.strictObject({
    type: z.literal('session.closed'),
    session: handleSchema,
    reason: z.enum(robotEndReasons),
    ...robotEndFields,
  }),
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
