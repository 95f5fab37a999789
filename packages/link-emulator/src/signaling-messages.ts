/**
 * Finds candidates and session descriptions in the messages of both signaling protocols. Everything else in a message
 * is unchanged, and other messages pass through: judging messages is up to the service.
 */
import * as z from 'zod';

/** Whose candidates they are. */
export type Side = 'robot' | 'operator';

/** Maps a peer's descriptions and candidates. */
export interface CandidateMapper {
  sdp(side: Side, sdp: string): string;
  /** `null`: the candidate is left out. */
  candidate(side: Side, candidate: string): string | null;
}

const farpointSdp = z.looseObject({ type: z.enum(['session.offer', 'session.answer']), sdp: z.string() });
const farpointCandidate = z.looseObject({
  type: z.literal('session.candidate'),
  candidate: z.looseObject({ candidate: z.string() }),
});
const referenceCandidate = z.looseObject({ type: z.literal('candidate'), candidate: z.string() });
const referenceSdp = z.looseObject({
  type: z.enum(['register', 'offer', 'answer', 'sdpAnswer']),
  sdpOffer: z.string().nullish(),
  sdpAnswer: z.string().nullish(),
});
const robotRecord = z.looseObject({
  sdpOffer: z.string().nullish(),
  sdpAnswer: z.string().nullish(),
  robotCandidates: z.array(z.string()).optional(),
  clientCandidates: z.array(z.string()).optional(),
});
const referenceRobots = z.looseObject({ type: z.literal('robots'), robots: z.array(robotRecord) });
const referenceRegister = z.looseObject({ type: z.literal('register'), robot: robotRecord });

type Sdps = { sdpOffer?: string | null | undefined; sdpAnswer?: string | null | undefined };

/**
 * The message with its candidates mapped.
 *
 * @param text JSON, or anything else
 * @param from the original sender
 * @returns the message to pass on, which is the same text if nothing in it concerns us; `null` to pass on nothing
 */
export function mapMessage(text: string, from: Side, mapper: CandidateMapper): string | null {
  let message: unknown;
  try {
    message = JSON.parse(text);
  } catch {
    return text;
  }
  const sdp = farpointSdp.safeParse(message).data;
  if (sdp !== undefined) return JSON.stringify({ ...sdp, sdp: mapper.sdp(from, sdp.sdp) });
  const trickled = farpointCandidate.safeParse(message).data;
  if (trickled !== undefined) {
    const candidate = mapCandidate(trickled.candidate.candidate, from, mapper);
    if (candidate === null) return null;
    return JSON.stringify({ ...trickled, candidate: { ...trickled.candidate, candidate } });
  }
  const bare = referenceCandidate.safeParse(message).data;
  if (bare !== undefined) {
    const candidate = mapCandidate(bare.candidate, from, mapper);
    return candidate === null ? null : JSON.stringify({ ...bare, candidate });
  }
  const robots = referenceRobots.safeParse(message).data;
  if (robots !== undefined) {
    return JSON.stringify({ ...robots, robots: robots.robots.map((robot) => mapRecord(robot, mapper)) });
  }
  const register = referenceRegister.safeParse(message).data;
  if (register !== undefined) {
    return JSON.stringify({ ...register, robot: mapRecord(register.robot, mapper) });
  }
  const reference = referenceSdp.safeParse(message).data;
  if (reference !== undefined) return JSON.stringify(mapSdps(reference, mapper));
  return text;
}

/** An empty candidate marks the end of candidates, and passes. */
function mapCandidate(candidate: string, side: Side, mapper: CandidateMapper): string | null {
  return candidate.trim() === '' ? candidate : mapper.candidate(side, candidate);
}

/** Robots offer and clients answer, whoever sends the message. */
function mapSdps<T extends Sdps>(message: T, mapper: CandidateMapper): T {
  const { sdpOffer, sdpAnswer } = message;
  return {
    ...message,
    ...(typeof sdpOffer === 'string' ? { sdpOffer: mapper.sdp('robot', sdpOffer) } : {}),
    ...(typeof sdpAnswer === 'string' ? { sdpAnswer: mapper.sdp('operator', sdpAnswer) } : {}),
  };
}

function mapRecord(record: z.infer<typeof robotRecord>, mapper: CandidateMapper): object {
  const map = (side: Side, candidates: string[]) =>
    candidates.flatMap((candidate) => mapCandidate(candidate, side, mapper) ?? []);
  const { robotCandidates, clientCandidates } = record;
  return {
    ...mapSdps(record, mapper),
    ...(robotCandidates === undefined ? {} : { robotCandidates: map('robot', robotCandidates) }),
    ...(clientCandidates === undefined ? {} : { clientCandidates: map('operator', clientCandidates) }),
  };
}
