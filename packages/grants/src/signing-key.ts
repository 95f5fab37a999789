/** An issuer's key: makes it, keeps it as a private JWK, and gives its public part to robots. */
import {
  type CryptoKey,
  calculateJwkThumbprint,
  exportJWK,
  generateKeyPair,
  importJWK,
  type JWK,
} from 'jose';
import * as z from 'zod/mini';
import type { SigningKey } from './grant.ts';
import {
  algorithmOf,
  type GrantAlgorithm,
  GrantKeysError,
  type GrantPublicJwk,
  grantKeySchema,
} from './grant-keys.ts';

const secretSchema = z.object({ d: z.string().check(z.regex(/^[A-Za-z0-9_-]{43}$/)) });

export interface NewSigningKey {
  /** Private. */
  secretJwk: JWK;
  publicJwk: GrantPublicJwk;
}

/** Makes a key whose `kid` is its thumbprint (RFC 7638). */
export async function makeSigningKey(alg: GrantAlgorithm = 'EdDSA'): Promise<NewSigningKey> {
  const { privateKey, publicKey } = await generateKeyPair(alg, { extractable: true });
  const exported = await exportJWK(publicKey);
  const kid = await calculateJwkThumbprint(exported, 'sha256');
  const publicJwk = z.parse(grantKeySchema, { ...exported, kid, alg, use: 'sig' });
  return { secretJwk: { ...(await exportJWK(privateKey)), kid, alg, use: 'sig' }, publicJwk };
}

/**
 * The public part of a private JWK.
 *
 * @throws {GrantKeysError} naming nothing of the key
 */
export function publicPartOf(text: string): GrantPublicJwk {
  return parsed(text).jwk;
}

/**
 * Reads a private JWK.
 *
 * @throws {GrantKeysError} naming nothing of the key
 */
export async function parseSigningKey(text: string): Promise<SigningKey> {
  const { jwk, d } = parsed(text);
  const { use: _, ...members } = jwk;
  const alg = algorithmOf(jwk);
  try {
    const key = (await importJWK({ ...members, alg, d })) as CryptoKey;
    return { keyId: jwk.kid, alg, key };
  } catch {
    throw new GrantKeysError('is not a key of its curve');
  }
}

function parsed(text: string): { jwk: GrantPublicJwk; d: string } {
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch {
    throw new GrantKeysError('is not JSON');
  }
  const jwk = z.safeParse(grantKeySchema, value);
  if (!jwk.success) throw new GrantKeysError('is not an Ed25519 or P-256 key with a kid');
  const secret = z.safeParse(secretSchema, value);
  if (!secret.success) throw new GrantKeysError('is not a private key');
  return { jwk: jwk.data, d: secret.data.d };
}
