/**
 * Farpoint's own signaling: JSON text over one WebSocket, `/robot` for robots and `/operator` for operators. A session
 * connects one operator with one robot; the robot offers, the operator answers, ICE candidates trickle. The service
 * only introduces them: a session survives the loss of either signaling socket for as long as its peers hear each
 * other.
 */
import * as z from 'zod/mini';
import { displayNameSchema, handleSchema, robotIdSchema, tokenSchema } from '../identifiers.ts';
import type { JsonCodec } from '../json.ts';
import { signInUrlSchema } from '../sign-in.ts';
import { robotStatusMessage, statusesChanged, statusesMessage, statusesWatch } from './robot-status.ts';

/** A message to the service is at most this long, bytes (docs/protocol.md). Chosen: an SDP of 60,000 characters fits. */
export const MAX_SIGNALING_BYTES = 65_536;
/** Characters of a list of revoked grants: it fits a message with room to spare. */
export const MAX_REVOCATIONS_LENGTH = 60_000;

const sdpSchema = z.string().check(z.minLength(1), z.maxLength(60_000));

/** RTCIceCandidateInit; an empty `candidate` marks the end of candidates. */
export const iceCandidateSchema = z.strictObject({
  candidate: z.string().check(z.maxLength(1024)),
  sdpMid: z.optional(z.nullable(z.string().check(z.maxLength(64)))),
  sdpMLineIndex: z.optional(z.nullable(z.int().check(z.minimum(0), z.maximum(64)))),
  usernameFragment: z.optional(z.nullable(z.string().check(z.maxLength(256)))),
});
export type IceCandidate = z.infer<typeof iceCandidateSchema>;

/** RTCIceServer, as the service sends it to both peers. */
export const iceServerSchema = z.strictObject({
  urls: z.union([z.string(), z.array(z.string())]),
  username: z.optional(z.string()),
  credential: z.optional(z.string()),
});
export type IceServer = z.infer<typeof iceServerSchema>;

/** Why a session ended, as reported to the robot. */
export const operatorEndReasons = ['operator-left', 'closed-by-operator'] as const;
export type OperatorEndReason = (typeof operatorEndReasons)[number];

/** Why a robot ends a session, or does not start it. */
export const robotCloseReasons = [
  'robot-full', // it already serves its maximum of operators
  'bad-answer', // the SDP answer is unusable, or what it agrees to is
  'not-granted', // the robot admits only operators with a valid grant, and this one has none
  'grant-expired',
  'grant-revoked', // by its issuer, during the session
  'ended-by-supervisor',
  'unproven-peer', // the peer's certificate is not the answer's, or the peer did not prove that it holds the key
  'not-connected', // no connection was established in time
  'connection-lost', // DTLS or a channel ended
  'silent', // nothing was heard from the operator for too long
  'not-reading', // reliable messages piled up
  'shutting-down',
] as const;
export type RobotCloseReason = (typeof robotCloseReasons)[number];

/** Why a session ended, as reported to the operator. */
export const robotEndReasons = [
  ...robotCloseReasons,
  'robot-left', // the robot's socket to the service closed
  'closed-by-robot', // the robot gave no reason
  'unknown-session', // the robot does not have the session that was to be resumed
] as const;
export type RobotEndReason = (typeof robotEndReasons)[number];

/** Why a robot does not resume a session. */
export const resumeRefusals = [
  'unknown-session', // it does not have the session
  'wrong-resume-key', // the asker has not proved that the session is its own
  'resume-too-soon', // the last offer still waits for its answer, or was answered only just now
] as const;
export type ResumeRefusal = (typeof resumeRefusals)[number];

/** Why the service refuses a message. After errors marked `fatal`, it closes the socket. */
export const signalingErrorCodes = [
  'malformed', // not a message of this protocol
  'too-large',
  'rate-limited',
  'hello-first', // the first message must be a hello
  'unauthorized', // token missing or wrong: fatal
  'robot-id-taken', // a connected robot with another key has this id: fatal
  'unknown-robot', // no such robot is connected now
  'unknown-session', // not one of your sessions
  'too-many-sessions',
  'wrong-resume-key', // the robot refused a session.resume; nothing else has changed
  'resume-too-soon', // the same, but ask again later
  'unsupported-protocol', // the hello's `protocol` is not supported here: fatal
  'full', // no room for another robot or operator: fatal
  'shutting-down', // reconnect in a moment: fatal
] as const;
export type SignalingErrorCode = (typeof signalingErrorCodes)[number];

const error = z.strictObject({
  type: z.literal('error'),
  code: z.enum(signalingErrorCodes),
  message: z.string().check(z.maxLength(1024)),
  session: z.optional(handleSchema),
});

/** The service passes them all on as they are; only the peers read them (docs/security.md). */
const jwsSchema = (maxLength: number) =>
  z.string().check(z.maxLength(maxLength), z.regex(/^[A-Za-z0-9_.-]+$/, 'must be a compact JWS'));
const sessionOffer = z.strictObject({
  type: z.literal('session.offer'),
  session: handleSchema,
  sdp: sdpSchema,
  /** With a session's first offer: that its certificate is this robot's. */
  identity: z.optional(jwsSchema(2048)),
});
const sessionAnswer = z.strictObject({
  type: z.literal('session.answer'),
  session: handleSchema,
  sdp: sdpSchema,
  /** Who the operator is and what it may do. */
  grant: z.optional(jwsSchema(4096)),
  /** That this session is the grant's holder's. */
  proof: z.optional(jwsSchema(2048)),
});
const sessionCandidate = z.strictObject({
  type: z.literal('session.candidate'),
  session: handleSchema,
  candidate: iceCandidateSchema,
});
const sessionClose = z.strictObject({ type: z.literal('session.close'), session: handleSchema });
/** Optional additions to a robot's reason. */
const robotEndFields = {
  /** With `robot-full`: how many operators it accepts. */
  maxOperators: z.optional(z.int().check(z.minimum(0), z.maximum(1_000_000))),
  /** For people: what exactly was wrong. */
  detail: z.optional(z.string().check(z.maxLength(300))),
};

const robotListing = z.strictObject({ id: robotIdSchema, name: displayNameSchema });
/** A robot that is connected now. */
export interface RobotListing {
  /** Its id at the signaling service. */
  id: string;
  /** Its name, for people. */
  name: string;
}

const robotsChanged = z.strictObject({
  type: z.literal('robots.changed'),
  /** Robots that connected or changed their names. */
  here: z.array(robotListing),
  /** Ids of robots that disconnected. */
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
    /** Made by the robot and kept over reconnects. It proves that a second socket for the same id is the same robot. */
    key: handleSchema,
    token: z.optional(tokenSchema),
  }),
  /** `claim` if it answers a `session.resume`. */
  z.extend(sessionOffer, { claim: z.optional(handleSchema) }),
  sessionCandidate,
  z.extend(sessionClose, { reason: z.optional(z.enum(robotCloseReasons)), ...robotEndFields }),
  /** The robot does not resume a session; nothing else changes. */
  z.strictObject({
    type: z.literal('session.refuse'),
    session: handleSchema,
    claim: handleSchema,
    code: z.enum(resumeRefusals),
  }),
  robotStatusMessage,
]);
export type RobotToService = z.infer<typeof robotToService>;

const serviceToRobot = z.discriminatedUnion('type', [
  z.strictObject({
    type: z.literal('robot.welcome'),
    id: robotIdSchema,
    iceServers: z.array(iceServerSchema),
  }),
  /** An operator requests a session: send an offer. */
  z.strictObject({ type: z.literal('session.request'), session: handleSchema, operator: displayNameSchema }),
  /**
   * Somebody claims to be this session's operator and to hear nothing. If the session's key is correct, offer an ICE
   * restart under this claim; otherwise refuse it.
   */
  z.strictObject({
    type: z.literal('session.resume'),
    session: handleSchema,
    operator: displayNameSchema,
    /** Made by the service to tell several claimants apart. */
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
  /** A list of revoked grants, signed by their issuer: after the welcome, and whenever it changes. */
  z.strictObject({ type: z.literal('revocations'), list: jwsSchema(MAX_REVOCATIONS_LENGTH) }),
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
   * For a session that has been connected before and whose path is silent. Also works if the service has forgotten the
   * session together with an earlier socket of either side. Answered with `session.resuming`; then, if the robot
   * accepts, with `session.opened` and the robot's offer of an ICE restart.
   */
  z.strictObject({
    type: z.literal('session.resume'),
    session: handleSchema,
    robotId: robotIdSchema,
    /** From the robot's welcome to this session's operator. */
    resumeKey: handleSchema,
  }),
  sessionAnswer,
  sessionCandidate,
  sessionClose,
  statusesWatch,
]);
export type OperatorToService = z.infer<typeof operatorToService>;

const serviceToOperator = z.discriminatedUnion('type', [
  z.strictObject({
    type: z.literal('operator.welcome'),
    iceServers: z.array(iceServerSchema),
    /** Where operators get grants by signing in. */
    signIn: z.optional(signInUrlSchema),
  }),
  /** Every robot that is connected now; sent after the welcome, and to an operator that has fallen far behind. */
  z.strictObject({ type: z.literal('robots'), robots: z.array(robotListing) }),
  /** What has changed since the last `robots` or `robots.changed`. */
  robotsChanged,
  statusesMessage,
  statusesChanged,
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
/** Larger, because it lists every robot, also with its status. */
export const serviceToOperatorCodec: JsonCodec<ServiceToOperator> = {
  what: 'message to operator',
  schema: serviceToOperator,
  maxBytes: 3_145_728,
};

/**
 * The list after a change: remaining robots keep their places, new ones are appended. The given list is not modified.
 */
export function applyRobotsChanged(
  robots: readonly RobotListing[],
  { here, gone }: Pick<RobotsChanged, 'here' | 'gone'>,
): RobotListing[] {
  const byId = new Map(robots.map((robot) => [robot.id, robot]));
  for (const id of gone) byId.delete(id);
  for (const robot of here) byId.set(robot.id, robot);
  return [...byId.values()];
}
