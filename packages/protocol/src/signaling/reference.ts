/**
 * The reference system's signaling: JSON text, any path, robots on port 3001 and clients on port 3002. Robot ids are
 * integers from 0. Unknown fields are accepted, because its own peers send some.
 */
import * as z from 'zod/mini';
import type { JsonCodec } from '../json.ts';

const sdp = z.string().check(z.maxLength(60_000));
const robotId = z.int().check(z.minimum(0), z.maximum(0xffffffff));
const candidate = z.string().check(z.maxLength(1024));

const robotToService = z.discriminatedUnion('type', [
  z.object({
    type: z.literal('register'),
    name: z.string().check(z.maxLength(256)),
    sdpOffer: z.nullish(sdp),
  }),
  z.object({ type: z.literal('offer'), robotId, sdpOffer: sdp }),
  z.object({ type: z.literal('candidate'), robotId, candidate }),
  z.object({ type: z.literal('deregister'), robotId }),
]);
export type ReferenceRobotToService = z.infer<typeof robotToService>;

const clientToService = z.discriminatedUnion('type', [
  z.object({ type: z.literal('getRobots') }),
  z.object({ type: z.literal('answer'), robotId, sdpAnswer: sdp }),
  z.object({ type: z.literal('candidate'), robotId, candidate }),
]);
export type ReferenceClientToService = z.infer<typeof clientToService>;

const robotRecord = z.object({
  id: robotId,
  name: z.string(),
  /** Null for a robot that registered without an offer. */
  sdpOffer: z.nullable(z.string()),
  sdpAnswer: z.nullable(z.string()),
  robotCandidates: z.array(z.string()),
  clientCandidates: z.array(z.string()),
});
/** A robot as the clients of the reference protocol see it. */
export type ReferenceRobot = z.infer<typeof robotRecord>;

const serviceToRobot = z.discriminatedUnion('type', [
  z.object({ type: z.literal('registered'), robotId }),
  z.object({ type: z.literal('sdpAnswer'), sdpAnswer: sdp }),
  z.object({ type: z.literal('candidate'), candidate }),
]);
export type ReferenceServiceToRobot = z.infer<typeof serviceToRobot>;

const serviceToClient = z.discriminatedUnion('type', [
  z.object({ type: z.literal('robots'), robots: z.array(robotRecord) }),
  z.object({ type: z.literal('register'), robot: robotRecord }),
  z.object({ type: z.literal('offer'), robotId, sdpOffer: sdp }),
  z.object({ type: z.literal('candidate'), robotId, candidate }),
  /** Sent when a robot deregisters explicitly. The reference bridge knows only `deregistered`, so ours sends both. */
  z.object({ type: z.literal('deregister'), robotId: z.optional(robotId) }),
  z.object({ type: z.literal('deregistered'), robotId }),
]);
export type ReferenceServiceToClient = z.infer<typeof serviceToClient>;

const maxBytes = 65_536;

export const referenceRobotToServiceCodec: JsonCodec<ReferenceRobotToService> = {
  what: 'reference message from robot',
  schema: robotToService,
  maxBytes,
};
export const referenceClientToServiceCodec: JsonCodec<ReferenceClientToService> = {
  what: 'reference message from client',
  schema: clientToService,
  maxBytes,
};
export const referenceServiceToRobotCodec: JsonCodec<ReferenceServiceToRobot> = {
  what: 'reference message to robot',
  schema: serviceToRobot,
  maxBytes,
};
export const referenceServiceToClientCodec: JsonCodec<ReferenceServiceToClient> = {
  what: 'reference message to client',
  schema: serviceToClient,
  maxBytes: 8_388_608,
};
