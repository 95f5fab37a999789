/**
 * The proof that a session belongs to a grant's holder, in the manner of DPoP (RFC 9449): signed with the operator's
 * own key over this session and both DTLS certificates. Whoever relays it can use it nowhere else.
 */
import { handleSchema, robotIdSchema } from '@farpoint/protocol';
import type { CryptoKey } from 'jose';
import * as z from 'zod/mini';
import { checkSignature, type JwsKind, readHeader, readPayload } from './compact-jws.ts';
import { type Grant, grantHash } from './grant.ts';
import { dateSchema, sha256Schema } from './grant-claims.ts';
import { keyThumbprint, type OperatorKey, operatorJwkSchema } from './operator-key.ts';
import { type GrantRefusal, GrantRefusedError } from './refusal.ts';
import { fingerprintSchema } from './sole-fingerprint.ts';

export const PROOF_TYPE = 'farpoint-proof+jwt';
/** Characters; the compact form of the largest proof is shorter. */
export const MAX_PROOF_LENGTH = 2048;
/** How far the clocks of operator and robot may differ, seconds. Replays are refused by what the proof names. */
export const PROOF_LEEWAY_S = 300;

const PROOF: JwsKind = {
  what: 'proof',
  maxLength: MAX_PROOF_LENGTH,
  malformed: (detail) => new GrantRefusedError('proof-malformed', detail),
  forged: (detail) => new GrantRefusedError('proof-forged', detail),
};

const headerSchema = z.object({
  typ: z.literal(PROOF_TYPE),
  alg: z.literal('ES256'),
  jwk: operatorJwkSchema,
});

const claimsSchema = z.object({
  /** The robot's id. */
  aud: robotIdSchema,
  session: handleSchema,
  /** SHA-256 of the operator's DTLS certificate, and of the robot's. */
  fp: fingerprintSchema,
  rfp: fingerprintSchema,
  /** SHA-256 of the grant. */
  gth: sha256Schema,
  iat: dateSchema,
});

/** What a proof binds a grant to. */
export interface SessionFacts {
  robot: string;
  /** The session's handle. */
  session: string;
  /** From the operator's answer. */
  operatorFingerprint: string;
  /** From the robot's offer. */
  robotFingerprint: string;
}

/** @param nowS seconds since 1970 */
export async function makeProof(
  grant: string,
  { robot, session, operatorFingerprint, robotFingerprint }: SessionFacts,
  { privateKey, publicJwk }: OperatorKey,
  nowS: number,
): Promise<string> {
  const claims: z.infer<typeof claimsSchema> = {
    aud: robot,
    session,
    fp: operatorFingerprint,
    rfp: robotFingerprint,
    gth: await grantHash(grant),
    iat: Math.floor(nowS),
  };
  const { CompactSign } = await import('./signatures.ts');
  return await new CompactSign(new TextEncoder().encode(JSON.stringify(claims)))
    .setProtectedHeader({ typ: PROOF_TYPE, alg: 'ES256', jwk: publicJwk })
    .sign(privateKey);
}

/**
 * Verifies that the holder of this grant's key means this session.
 *
 * @param grant the compact form that was verified as `operatorKey`'s
 * @throws {GrantRefusedError}
 */
export async function verifyProof(
  text: string,
  grant: string,
  { operatorKey }: Pick<Grant, 'operatorKey'>,
  facts: SessionFacts,
  nowS: number,
): Promise<void> {
  const { jwk } = readHeader(PROOF, headerSchema, text);
  if ((await keyThumbprint(jwk)) !== operatorKey)
    throw new GrantRefusedError('proof-wrong-key', 'not the key that the grant names');
  const { importJWK } = await import('./signatures.ts');
  let key: CryptoKey;
  try {
    key = (await importJWK(jwk, 'ES256')) as CryptoKey;
  } catch {
    throw new GrantRefusedError('proof-malformed', 'its key is not a point of the curve');
  }
  await checkSignature(PROOF, text, key, 'ES256');
  const { aud, session, fp, rfp, gth, iat } = readPayload(PROOF, claimsSchema, text);
  const refuse = (reason: GrantRefusal, detail: string) => {
    throw new GrantRefusedError(reason, detail);
  };
  if (gth !== (await grantHash(grant))) refuse('proof-other-grant', 'it was made for another grant');
  if (aud !== facts.robot) refuse('proof-other-robot', `it was made for ${aud}`);
  if (session !== facts.session) refuse('proof-other-session', 'it was made for another session');
  if (fp !== facts.operatorFingerprint)
    refuse('proof-other-fingerprint', 'the answer names another certificate');
  if (rfp !== facts.robotFingerprint)
    refuse('proof-other-fingerprint', 'the operator was shown another certificate of the robot');
  if (Math.abs(nowS - iat) > PROOF_LEEWAY_S)
    refuse('proof-stale', `the clocks differ by ${Math.round(nowS - iat)} s`);
}
