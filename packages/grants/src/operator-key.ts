/** The operator's own key: P-256, made where it is used. Grants name it by its thumbprint. */
import type { CryptoKey } from 'jose';
import * as z from 'zod/mini';

const coordinate = z.string().check(z.regex(/^[A-Za-z0-9_-]{43}$/));

/** Nothing but the public key: a private one in a proof would be a leak. */
export const operatorJwkSchema = z.strictObject({
  kty: z.literal('EC'),
  crv: z.literal('P-256'),
  x: coordinate,
  y: coordinate,
});
export type OperatorJwk = z.infer<typeof operatorJwkSchema>;

export const operatorSecretJwkSchema = z.strictObject({ ...operatorJwkSchema.shape, d: coordinate });
export type OperatorSecretJwk = z.infer<typeof operatorSecretJwkSchema>;

export interface OperatorKey {
  /** For signing. Need not be extractable. */
  privateKey: CryptoKey;
  publicJwk: OperatorJwk;
}

/** @param extractable whether the private key can be exported, for a ticket */
export async function makeOperatorKey(extractable = false): Promise<OperatorKey> {
  const { exportJWK, generateKeyPair } = await import('./signatures.ts');
  const { privateKey, publicKey } = await generateKeyPair('ES256', { extractable });
  return { privateKey, publicJwk: toOperatorJwk(await exportJWK(publicKey)) };
}

/** @throws {TypeError} if the key is not extractable */
export async function exportOperatorKey({ privateKey }: OperatorKey): Promise<OperatorSecretJwk> {
  const { exportJWK } = await import('./signatures.ts');
  const { kty, crv, x, y, d } = await exportJWK(privateKey);
  return z.parse(operatorSecretJwkSchema, { kty, crv, x, y, d });
}

/** @throws {Error} if the numbers are not a key of the curve */
export async function importOperatorKey({ d, ...publicJwk }: OperatorSecretJwk): Promise<OperatorKey> {
  const { importJWK } = await import('./signatures.ts');
  return { privateKey: (await importJWK({ ...publicJwk, d }, 'ES256')) as CryptoKey, publicJwk };
}

/** RFC 7638: SHA-256 of the key's required members, in base64url. */
export async function keyThumbprint({ kty, crv, x, y }: OperatorJwk): Promise<string> {
  const { calculateJwkThumbprint } = await import('./signatures.ts');
  return await calculateJwkThumbprint({ kty, crv, x, y }, 'sha256');
}

/** @throws {Error} if it is not a P-256 key */
export function toOperatorJwk(jwk: object): OperatorJwk {
  const { kty, crv, x, y } = jwk as Record<string, unknown>;
  return z.parse(operatorJwkSchema, { kty, crv, x, y });
}
