/** Decides whether an operator is admitted to a session. */
import { type Grant, verifyGrant } from './grant.ts';
import type { GrantKeys } from './grant-keys.ts';
import { verifyProof } from './proof.ts';
import { GrantRefusedError } from './refusal.ts';
import { soleFingerprint } from './sole-fingerprint.ts';

/** What an operator asks with: the members of its `session.answer`. */
export interface AdmissionRequest {
  session: string;
  /** The SDP answer. */
  sdp: string;
  grant?: string | undefined;
  proof?: string | undefined;
}

export interface AdmissionContext {
  keys: GrantKeys;
  robot: string;
  /** The SDP offer that the robot sent in this session. */
  offer: string;
  /** Seconds since 1970. */
  nowS: number;
}

/** @throws {GrantRefusedError} */
export async function admit(request: AdmissionRequest, context: AdmissionContext): Promise<Grant> {
  const { session, sdp, grant: text, proof } = request;
  const { keys, robot, offer, nowS } = context;
  if (text === undefined) throw new GrantRefusedError('grant-missing', 'there is none');
  const grant = await verifyGrant(text, { keys, robot, nowS });
  if (proof === undefined) throw new GrantRefusedError('proof-missing', 'there is none');
  const operatorFingerprint = soleFingerprint(sdp);
  const robotFingerprint = soleFingerprint(offer);
  if (operatorFingerprint === null || robotFingerprint === null)
    throw new GrantRefusedError(
      'proof-other-fingerprint',
      'not exactly one SHA-256 fingerprint is described',
    );
  await verifyProof(proof, text, grant, { robot, session, operatorFingerprint, robotFingerprint }, nowS);
  return grant;
}
