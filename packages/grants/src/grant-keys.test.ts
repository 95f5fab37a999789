import fc from 'fast-check';
import { exportJWK } from 'jose';
import { expect, it } from 'vitest';
import { GrantKeysError, MAX_KEYS, parseGrantKeys } from './grant-keys.ts';
import { makeIssuer } from './testing/issuer.ts';

const parse = (value: unknown) => parseGrantKeys(JSON.stringify(value));

it('reads Ed25519 and P-256 keys, several at once', async () => {
  const issuers = await Promise.all([makeIssuer('a'), makeIssuer('b', 'ES256')]);
  const keys = await parse({ keys: issuers.map(({ publicJwk }) => publicJwk) });
  expect([...keys].map(([kid, { alg }]) => [kid, alg])).toEqual([
    ['a', 'EdDSA'],
    ['b', 'ES256'],
  ]);
});

it('says what is wrong', async () => {
  const { publicJwk, signingKey } = await makeIssuer();
  const secret = { ...(await exportJWK(signingKey.key)), kid: 'k1' };
  const rest: [unknown, string][] = [
    [1, 'is not a JWK set'],
    [{ keys: [] }, 'has no keys'],
    [{ keys: Array.from({ length: MAX_KEYS + 1 }, () => publicJwk) }, 'more than 16'],
    [{ keys: [publicJwk, secret] }, 'key 2 is secret'],
    [{ keys: [{ kty: 'oct', k: 'AA', kid: 'x' }] }, 'key 1 is secret'],
    [{ keys: [publicJwk, publicJwk] }, 'key 2 has the kid of another key'],
    [{ keys: [{ ...publicJwk, kid: undefined }] }, 'key 1 is not an Ed25519 or P-256 public key'],
    [{ keys: [{ ...publicJwk, alg: 'ES256' }] }, 'key 1 is not an Ed25519 or P-256 public key'],
    [{ keys: [{ kty: 'RSA', n: 'AQAB', e: 'AQAB', kid: 'x' }] }, 'key 1 is not an Ed25519'],
  ];
  for (const [value, message] of rest) await expect(parse(value)).rejects.toThrow(message);
  await expect(parseGrantKeys('{')).rejects.toThrow(GrantKeysError);
  const point = { kty: 'EC', crv: 'P-256', kid: 'x', x: 'A'.repeat(43), y: 'A'.repeat(43) };
  await expect(parse({ keys: [point] })).rejects.toThrow('not a point of its curve');
});

it('any JSON gives keys or a GrantKeysError', async () => {
  await fc.assert(
    fc.asyncProperty(fc.jsonValue(), async (value) => {
      await expect(parse({ keys: [value] })).rejects.toThrow(GrantKeysError);
      await expect(parse(value)).rejects.toThrow(GrantKeysError);
    }),
    { seed: 7, numRuns: 200 },
  );
});
