/** The keys whose signatures under grants count: a JWK set (RFC 7517 §5) with public keys only. */
import type { CryptoKey } from 'jose';
import * as z from 'zod/mini';

export const grantAlgorithms = ['EdDSA', 'ES256'] as const;
export type GrantAlgorithm = (typeof grantAlgorithms)[number];

export interface GrantKey {
  alg: GrantAlgorithm;
  key: CryptoKey;
}
/** By `kid`. Several keys at once let an issuer change its key without a gap. */
export type GrantKeys = ReadonlyMap<string, GrantKey>;

/** The text is not a set of keys that can be used. The message says what is wrong, for people. */
export class GrantKeysError extends Error {
  override readonly name = 'GrantKeysError';
}

/** Keys of a set. Chosen: an old and a new one of several issuers. */
export const MAX_KEYS = 16;

const coordinate = z.string().check(z.regex(/^[A-Za-z0-9_-]{43}$/));
export const keyIdSchema = z
  .string()
  .check(z.minLength(1), z.maxLength(128), z.regex(/^[^\p{Cc}]*$/u, 'must have no control characters'));
const common = { kid: keyIdSchema, use: z.optional(z.literal('sig')) };

/** A public key for grants; other members are ignored. */
export const grantKeySchema = z.discriminatedUnion('kty', [
  z.object({
    ...common,
    kty: z.literal('OKP'),
    crv: z.literal('Ed25519'),
    alg: z.optional(z.literal('EdDSA')),
    x: coordinate,
  }),
  z.object({
    ...common,
    kty: z.literal('EC'),
    crv: z.literal('P-256'),
    alg: z.optional(z.literal('ES256')),
    x: coordinate,
    y: coordinate,
  }),
]);
export type GrantPublicJwk = z.infer<typeof grantKeySchema>;

const setSchema = z.object({ keys: z.array(z.unknown()) });

/** @throws {GrantKeysError} */
export function readJwkSet(text: string): GrantPublicJwk[] {
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch {
    throw new GrantKeysError('is not JSON');
  }
  const set = z.safeParse(setSchema, value);
  if (!set.success) throw new GrantKeysError('is not a JWK set: {"keys": […]}');
  const { keys } = set.data;
  if (keys.length === 0) throw new GrantKeysError('has no keys');
  if (keys.length > MAX_KEYS) throw new GrantKeysError(`has more than ${MAX_KEYS} keys`);
  const seen = new Set<string>();
  return keys.map((each, index) => {
    const where = `key ${index + 1}`;
    if (typeof each === 'object' && each !== null && ('d' in each || 'k' in each))
      throw new GrantKeysError(`${where} is secret: the set must hold public keys only`);
    const parsed = z.safeParse(grantKeySchema, each);
    if (!parsed.success) {
      const path = parsed.error.issues[0]?.path.map(String).join('.') ?? '';
      const member = path === '' ? '' : ` (${path})`;
      throw new GrantKeysError(`${where} is not an Ed25519 or P-256 public key with a kid${member}`);
    }
    if (seen.has(parsed.data.kid)) throw new GrantKeysError(`${where} has the kid of another key`);
    seen.add(parsed.data.kid);
    return parsed.data;
  });
}

/** @throws {GrantKeysError} */
export async function parseGrantKeys(text: string): Promise<GrantKeys> {
  const { importJWK } = await import('./signatures.ts');
  const keys = new Map<string, GrantKey>();
  for (const jwk of readJwkSet(text)) {
    const alg = algorithmOf(jwk);
    try {
      const { use: _, ...members } = jwk;
      // Only symmetric keys are imported as bytes.
      keys.set(jwk.kid, { alg, key: (await importJWK({ ...members, alg })) as CryptoKey });
    } catch {
      throw new GrantKeysError(`the key ${JSON.stringify(jwk.kid)} is not a point of its curve`);
    }
  }
  return keys;
}

export function algorithmOf({ kty }: Pick<GrantPublicJwk, 'kty'>): GrantAlgorithm {
  return kty === 'OKP' ? 'EdDSA' : 'ES256';
}
