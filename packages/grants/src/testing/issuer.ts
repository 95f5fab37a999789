/** An issuer of grants, an operator and a session, for tests. */
import { exportJWK, generateKeyPair } from 'jose';
import { issueGrant, type SigningKey } from '../grant.ts';
import type { GrantClaims } from '../grant-claims.ts';
import type { GrantAlgorithm } from '../grant-keys.ts';
import { keyThumbprint, makeOperatorKey, type OperatorKey } from '../operator-key.ts';

export interface TestIssuer {
  signingKey: SigningKey;
  /** Its part of a JWK set. */
  publicJwk: object;
}

export async function makeIssuer(keyId = 'k1', alg: GrantAlgorithm = 'EdDSA'): Promise<TestIssuer> {
  const { privateKey, publicKey } = await generateKeyPair(alg, { extractable: true });
  const publicJwk = { ...(await exportJWK(publicKey)), kid: keyId, alg, use: 'sig' };
  return { signingKey: { keyId, alg, key: privateKey }, publicJwk };
}

export interface GrantedOperator {
  key: OperatorKey;
  claims: GrantClaims;
  grant: string;
}

/** @param nowS seconds since 1970; the grant begins then and lasts an hour */
export async function grantTo(
  { signingKey }: TestIssuer,
  nowS: number,
  change: Partial<GrantClaims> = {},
): Promise<GrantedOperator> {
  const key = await makeOperatorKey(true);
  const claims: GrantClaims = {
    ...{ iss: 'test', sub: 'ada', name: 'Ada Lovelace', aud: 'farpoint' },
    ...{ iat: Math.floor(nowS), nbf: Math.floor(nowS), exp: Math.floor(nowS) + 3600, jti: 'g1' },
    ...{ robots: ['*'], role: 'drive', cnf: { jkt: await keyThumbprint(key.publicJwk) } },
    ...change,
  };
  return { key, claims, grant: await issueGrant(claims, signingKey) };
}
