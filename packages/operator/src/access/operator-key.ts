/** The operator's own key, declared here in full because the package's users see it. */
import { makeOperatorKey as makeKey, keyThumbprint as thumbprintOf } from '@farpoint/grants';

/** A public key of the curve P-256 (RFC 7518 §6.2). */
export interface OperatorJwk {
  /** Kind of key: elliptic curve. */
  kty: 'EC';
  /** The curve. */
  crv: 'P-256';
  /** Coordinate, 32 bytes in base64url. */
  x: string;
  /** Coordinate, 32 bytes in base64url. */
  y: string;
}

/** A key pair for signatures (ES256). */
export interface OperatorKey {
  /** For signing. Need not be extractable. */
  privateKey: CryptoKey;
  /** What others see of it. */
  publicJwk: OperatorJwk;
}

/** Makes a key whose private part no script can read. It can be kept in IndexedDB. Needs a secure context. */
export async function makeOperatorKey(): Promise<OperatorKey> {
  return await makeKey();
}

/** SHA-256 of a public key in base64url (RFC 7638): what the issuer of a grant needs to know of it. */
export async function keyThumbprint(key: OperatorJwk): Promise<string> {
  return await thumbprintOf(key);
}
