/**
 * A robot's identity: the robot signs with a key of its own that the DTLS certificate in its offer is its own in this
 * session. An operator that knows the key thus recognises the robot, whoever introduced them.
 */
import { handleSchema, robotIdSchema } from '@farpoint/protocol';
import type { CryptoKey } from 'jose';
import * as z from 'zod/mini';
import { checkSignature, type JwsKind, readHeader, readPayload } from './compact-jws.ts';
import { dateSchema } from './grant-claims.ts';
import { keyThumbprint, type OperatorKey, operatorJwkSchema } from './operator-key.ts';
import { fingerprintSchema } from './sole-fingerprint.ts';

export const IDENTITY_TYPE = 'farpoint-robot+jwt';
/** Characters; the compact form of the largest identity is shorter. */
export const MAX_IDENTITY_LENGTH = 2048;

/** Why a robot's identity is not believed. */
export type IdentityFault =
  | 'identity-malformed' // not one
  | 'identity-forged' // its signature does not match
  | 'identity-other-robot' // made for another robot id
  | 'identity-other-session'
  | 'identity-other-fingerprint'; // another DTLS certificate than the offer names

/** Thrown for every identity that is not believed. Bad input causes no other exception. */
export class RobotIdentityError extends Error {
  override readonly name = 'RobotIdentityError';
  readonly reason: IdentityFault;

  constructor(reason: IdentityFault, detail: string) {
    super(`${reason}: ${detail}`);
    this.reason = reason;
  }
}

const IDENTITY: JwsKind = {
  what: 'identity',
  maxLength: MAX_IDENTITY_LENGTH,
  malformed: (detail) => new RobotIdentityError('identity-malformed', detail),
  forged: (detail) => new RobotIdentityError('identity-forged', detail),
};

const headerSchema = z.object({
  typ: z.literal(IDENTITY_TYPE),
  alg: z.literal('ES256'),
  jwk: operatorJwkSchema,
});

const claimsSchema = z.object({
  /** The robot's id. */
  iss: robotIdSchema,
  session: handleSchema,
  /** SHA-256 of the robot's DTLS certificate. */
  fp: fingerprintSchema,
  iat: dateSchema,
});

/** What an identity is bound to. */
export interface OfferFacts {
  robot: string;
  /** The session's handle. */
  session: string;
  /** From the robot's offer. */
  robotFingerprint: string;
}

/** @param nowS seconds since 1970 */
export async function makeIdentity(
  { robot, session, robotFingerprint }: OfferFacts,
  { privateKey, publicJwk }: OperatorKey,
  nowS: number,
): Promise<string> {
  const claims: z.infer<typeof claimsSchema> = {
    iss: robot,
    session,
    fp: robotFingerprint,
    iat: Math.floor(nowS),
  };
  const { CompactSign } = await import('./signatures.ts');
  return await new CompactSign(new TextEncoder().encode(JSON.stringify(claims)))
    .setProtectedHeader({ typ: IDENTITY_TYPE, alg: 'ES256', jwk: publicJwk })
    .sign(privateKey);
}

/**
 * Verifies that the holder of the key in it has this certificate in this session. It names the certificate, so no time
 * is checked: a replay is worth nothing without the certificate's private key.
 *
 * @returns the key's thumbprint (RFC 7638), by which the operator recognises the robot
 * @throws {RobotIdentityError}
 */
export async function verifyIdentity(text: string, facts: OfferFacts): Promise<string> {
  const { jwk } = readHeader(IDENTITY, headerSchema, text);
  const { importJWK } = await import('./signatures.ts');
  let key: CryptoKey;
  try {
    key = (await importJWK(jwk, 'ES256')) as CryptoKey;
  } catch {
    throw new RobotIdentityError('identity-malformed', 'its key is not a point of the curve');
  }
  await checkSignature(IDENTITY, text, key, 'ES256');
  const { iss, session, fp } = readPayload(IDENTITY, claimsSchema, text);
  if (iss !== facts.robot) throw new RobotIdentityError('identity-other-robot', `it is ${iss}’s`);
  if (session !== facts.session)
    throw new RobotIdentityError('identity-other-session', 'it was made for another session');
  if (fp !== facts.robotFingerprint)
    throw new RobotIdentityError('identity-other-fingerprint', 'the offer names another certificate');
  return await keyThumbprint(jwk);
}
