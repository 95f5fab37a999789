/** Lists of revoked grants: made by whoever issues grants, passed on by anybody, verified by each robot. */
import { handleSchema, MAX_REVOCATIONS_LENGTH } from '@farpoint/protocol';
import { CompactSign } from 'jose';
import * as z from 'zod/mini';
import { checkSignature, type JwsKind, readHeader, readPayload } from './compact-jws.ts';
import type { Grant, SigningKey } from './grant.ts';
import { dateSchema, subjectSchema } from './grant-claims.ts';
import { type GrantKeys, keyIdSchema } from './grant-keys.ts';

export const REVOCATIONS_TYPE = 'farpoint-revocations+jwt';
/** Of each kind in one list. */
export const MAX_REVOCATIONS = 1024;

/** Why a list of revocations changes nothing. */
export const revocationsRefusals = [
  'revocations-malformed', // not a list
  'revocations-untrusted', // not signed by a key that counts here
  'revocations-older', // not newer than the list that is known from this key, and nothing in it is new
] as const;
export type RevocationsRefusal = (typeof revocationsRefusals)[number];

/** Thrown for a list that changes nothing. Bad input causes no other exception. */
export class RevocationsRefusedError extends Error {
  override readonly name = 'RevocationsRefusedError';
  readonly reason: RevocationsRefusal;

  /** @param detail for people */
  constructor(reason: RevocationsRefusal, detail: string) {
    super(`${reason}: ${detail}`);
    this.reason = reason;
  }
}

const REVOCATIONS: JwsKind = {
  what: 'list of revocations',
  maxLength: MAX_REVOCATIONS_LENGTH,
  malformed: (detail) => new RevocationsRefusedError('revocations-malformed', detail),
  forged: (detail) => new RevocationsRefusedError('revocations-untrusted', detail),
};

const headerSchema = z.object({ typ: z.literal(REVOCATIONS_TYPE), alg: z.string(), kid: keyIdSchema });

/** Unknown members are ignored, as in grants. */
export const revocationsSchema = z.object({
  iss: subjectSchema,
  iat: dateSchema,
  /** Rises with each list of a key. */
  seq: z.int().check(z.minimum(1), z.maximum(Number.MAX_SAFE_INTEGER)),
  /** Single grants. `exp`: no earlier than the grant's own; the entry means nothing afterwards. */
  grants: z.array(z.object({ jti: handleSchema, exp: dateSchema })).check(z.maxLength(MAX_REVOCATIONS)),
  /** All grants of a person that were issued earlier than `before`. */
  subjects: z
    .array(z.object({ sub: subjectSchema, before: dateSchema, exp: dateSchema }))
    .check(z.maxLength(MAX_REVOCATIONS)),
});
export type RevocationsPayload = z.infer<typeof revocationsSchema>;

/** What a list says. */
export interface Revocations {
  /** The key that signed it. It revokes only grants that the same key signed. */
  keyId: string;
  payload: RevocationsPayload;
}

/** @returns the compact form. @throws {RevocationsRefusedError} if it would be longer than anybody reads */
export async function signRevocations(
  payload: RevocationsPayload,
  { keyId, alg, key }: SigningKey,
): Promise<string> {
  const text = await new CompactSign(new TextEncoder().encode(JSON.stringify(payload)))
    .setProtectedHeader({ typ: REVOCATIONS_TYPE, alg, kid: keyId })
    .sign(key);
  // Reads it as everybody will.
  readRevocations(text);
  return text;
}

/** @throws {RevocationsRefusedError} */
export async function verifyRevocations(text: string, keys: GrantKeys): Promise<Revocations> {
  const { alg, kid } = readHeader(REVOCATIONS, headerSchema, text);
  const known = keys.get(kid);
  // As with grants, the key decides on the algorithm.
  if (known === undefined || alg !== known.alg)
    throw new RevocationsRefusedError('revocations-untrusted', 'no key has its kid and algorithm');
  await checkSignature(REVOCATIONS, text, known.key, known.alg);
  return { keyId: kid, payload: readPayload(REVOCATIONS, revocationsSchema, text) };
}

/** Characters of a signature by Ed25519 or ES256: 64 bytes in base64url. */
const SIGNATURE_LENGTH = 86;

/**
 * What is in a list, whether or not it is genuine: for whoever only passes it on. A list that was cut short is malformed.
 *
 * @throws {RevocationsRefusedError} if it is malformed
 */
export function readRevocations(text: string): Revocations {
  const { kid } = readHeader(REVOCATIONS, headerSchema, text);
  if (text.length - text.lastIndexOf('.') - 1 !== SIGNATURE_LENGTH)
    throw new RevocationsRefusedError('revocations-malformed', 'its signature is not complete');
  return { keyId: kid, payload: readPayload(REVOCATIONS, revocationsSchema, text) };
}

/** A grant, as far as its revocation goes. */
export type RevocableGrant = Pick<Grant, 'id' | 'subject' | 'keyId' | 'issuedAtS'>;
