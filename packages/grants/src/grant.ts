/** Issues and verifies grants: who may do what with which robot, until when. */
import type { Role } from '@farpoint/protocol';
import { base64url, type CryptoKey } from 'jose';
import * as z from 'zod/mini';
import { checkSignature, readHeader, readPayload } from './compact-jws.ts';
import {
  AUDIENCE,
  coversRobot,
  GRANT,
  GRANT_TYPE,
  type GrantClaims,
  grantClaimsSchema,
} from './grant-claims.ts';
import { type GrantAlgorithm, type GrantKeys, keyIdSchema } from './grant-keys.ts';
import { GrantRefusedError } from './refusal.ts';

/** How far the issuer's clock may be ahead of the robot's, seconds. A grant ends exactly at its end. */
export const ISSUER_LEEWAY_S = 60;

const headerSchema = z.object({ typ: z.literal(GRANT_TYPE), alg: z.string(), kid: keyIdSchema });

/** A grant that was verified. */
export interface Grant {
  /** Who. Stays the same when a person gets another grant. */
  subject: string;
  /** For people. */
  name: string;
  role: Role;
  /** Ids or patterns. */
  robots: readonly string[];
  /** Thumbprint of the operator's own key. */
  operatorKey: string;
  /** Names the grant. */
  id: string;
  issuer: string;
  /** Seconds since 1970. */
  issuedAtS: number;
  /** Seconds since 1970. */
  expiresAtS: number;
  /** The key that signed it. */
  keyId: string;
}

export interface SigningKey {
  keyId: string;
  alg: GrantAlgorithm;
  key: CryptoKey;
}

/** @returns the compact form; printable characters without spaces */
export async function issueGrant(claims: GrantClaims, { keyId, alg, key }: SigningKey): Promise<string> {
  const { CompactSign } = await import('./signatures.ts');
  return await new CompactSign(new TextEncoder().encode(JSON.stringify(claims)))
    .setProtectedHeader({ typ: GRANT_TYPE, alg, kid: keyId })
    .sign(key);
}

/**
 * Verifies a grant for a robot, without its holder's proof.
 *
 * @param robot its id; `null` to ask about no robot in particular
 * @param nowS seconds since 1970
 * @throws {GrantRefusedError}
 */
export async function verifyGrant(
  text: string,
  { keys, robot, nowS }: { keys: GrantKeys; robot: string | null; nowS: number },
): Promise<Grant> {
  const { alg, kid } = readHeader(GRANT, headerSchema, text);
  const known = keys.get(kid);
  if (known === undefined) throw new GrantRefusedError('grant-untrusted', `no key has the kid ${shown(kid)}`);
  // The key decides on the algorithm. A header that says otherwise (none, HS256) is an attack.
  if (alg !== known.alg)
    throw new GrantRefusedError('grant-untrusted', `signed by ${shown(alg)}, not ${known.alg}`);
  await checkSignature(GRANT, text, known.key, known.alg);
  const claims = readPayload(GRANT, grantClaimsSchema, text);
  const { aud, iat, nbf, exp, robots } = claims;
  if (![aud].flat().includes(AUDIENCE))
    throw new GrantRefusedError('grant-other-audience', 'it is for another audience');
  if (Math.max(iat, nbf) > nowS + ISSUER_LEEWAY_S)
    throw new GrantRefusedError('grant-not-yet', `begins ${inWords(Math.max(iat, nbf) - nowS)} from now`);
  if (exp <= nowS) throw new GrantRefusedError('grant-expired', `ended ${inWords(nowS - exp)} ago`);
  if (robot !== null && !coversRobot(robots, robot))
    throw new GrantRefusedError('grant-other-robot', `it is for ${robots.join(', ')}`);
  return toGrant(claims, kid);
}

/**
 * What is in a grant, whether or not it is valid. Never act upon it.
 *
 * @throws {GrantRefusedError} if it is malformed
 */
export function readGrant(text: string): { claims: GrantClaims; keyId: string } {
  const { kid } = readHeader(GRANT, headerSchema, text);
  return { claims: readPayload(GRANT, grantClaimsSchema, text), keyId: kid };
}

/** SHA-256 of the compact form in base64url, by which a proof names its grant. */
export async function grantHash(text: string): Promise<string> {
  const digest = await crypto.subtle.digest('SHA-256', new TextEncoder().encode(text));
  return base64url.encode(new Uint8Array(digest));
}

function toGrant(claims: GrantClaims, keyId: string): Grant {
  const { sub, name, role, robots, cnf, jti, iss, iat, exp } = claims;
  return {
    subject: sub,
    name,
    role,
    robots,
    operatorKey: cnf.jkt,
    id: jti,
    issuer: iss,
    issuedAtS: iat,
    expiresAtS: exp,
    keyId,
  };
}

function shown(text: string): string {
  return JSON.stringify(text.slice(0, 64));
}

function inWords(seconds: number): string {
  return seconds < 7200 ? `${Math.round(seconds)} s` : `${Math.round(seconds / 3600)} h`;
}
