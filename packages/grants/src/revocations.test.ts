import { createHmac } from 'node:crypto';
import fc from 'fast-check';
import { base64url } from 'jose';
import { beforeAll, describe, expect, it } from 'vitest';
import { extendRevocations } from './extend-revocations.ts';
import { issueGrant, verifyGrant } from './grant.ts';
import { type GrantKeys, parseGrantKeys } from './grant-keys.ts';
import { KnownRevocations } from './known-revocations.ts';
import {
  MAX_REVOCATIONS,
  type RevocationsPayload,
  RevocationsRefusedError,
  readRevocations,
  revocationsRefusals,
  signRevocations,
  verifyRevocations,
} from './revocations.ts';
import { grantTo, makeIssuer, type TestIssuer } from './testing/issuer.ts';

const NOW = 1_800_000_000;
const payload: RevocationsPayload = {
  ...{ iss: 'test', iat: NOW, seq: 1 },
  grants: [{ jti: 'g1', exp: NOW + 100 }],
  subjects: [{ sub: 'ada', before: NOW, exp: NOW + 100 }],
};

let issuer: TestIssuer;
let keys: GrantKeys;
let text: string;
beforeAll(async () => {
  issuer = await makeIssuer();
  keys = await parseGrantKeys(JSON.stringify({ keys: [issuer.publicJwk] }));
  text = await signRevocations(payload, issuer.signingKey);
});

/** `taken`, or the reason. Any other exception fails the test. */
async function outcome(list: string): Promise<string> {
  try {
    await verifyRevocations(list, keys);
    return 'taken';
  } catch (error) {
    if (!(error instanceof RevocationsRefusedError)) throw error;
    expect(error.message).toContain(error.reason);
    return error.reason;
  }
}

const part = (value: unknown) => base64url.encode(new TextEncoder().encode(JSON.stringify(value)));
const signed = (change: object, by = issuer) =>
  signRevocations({ ...payload, ...change }, by.signingKey).then(outcome);

describe('lists', () => {
  it('say what was signed, by either algorithm', async () => {
    expect(await verifyRevocations(text, keys)).toEqual({ keyId: 'k1', payload });
    const other = await makeIssuer('k2', 'ES256');
    const both = await parseGrantKeys(JSON.stringify({ keys: [issuer.publicJwk, other.publicJwk] }));
    const list = await signRevocations(payload, other.signingKey);
    expect(await verifyRevocations(list, both)).toEqual({ keyId: 'k2', payload });
    expect(readRevocations(list)).toEqual({ keyId: 'k2', payload });
  });

  it('of another issuer, under the same kid or another, are refused', async () => {
    expect(await signed({}, await makeIssuer('k1'))).toBe('revocations-untrusted');
    expect(await signed({}, await makeIssuer('k2'))).toBe('revocations-untrusted');
  });

  it('with alg none, with HS256 by the public key, and a grant instead of a list are refused', async () => {
    const [, body] = text.split('.');
    const header = (alg: string) => part({ typ: 'farpoint-revocations+jwt', alg, kid: 'k1' });
    const hmac = `${header('HS256')}.${body}`;
    const { x } = issuer.publicJwk as { x: string };
    const mac = createHmac('sha256', base64url.decode(x)).update(hmac).digest('base64url');
    expect(await outcome(`${hmac}.${mac}`)).toBe('revocations-untrusted');
    expect(await outcome(`${header('none')}.${body}.`)).toBe('revocations-untrusted');
    expect(await outcome((await grantTo(issuer, NOW)).grant)).toBe('revocations-malformed');
    // And a list is not a grant, although the same key signed it.
    await expect(verifyGrant(text, { keys, robot: null, nowS: NOW })).rejects.toMatchObject({
      reason: 'grant-malformed',
    });
  });

  it.each([
    ['seq', 0],
    ['seq', 1.5],
    ['iat', -1],
    ['iss', ''],
    ['grants', [{ jti: 'a b', exp: 1 }]],
    ['grants', [{ jti: 'a' }]],
    ['subjects', [{ sub: 'a', exp: 1 }]],
    ['subjects', [{ sub: 'a\nb', before: 1, exp: 1 }]],
    ['grants', Array.from({ length: MAX_REVOCATIONS + 1 }, () => ({ jti: 'a', exp: 1 }))],
    // As many as there may be, but too long together.
    ['grants', Array.from({ length: MAX_REVOCATIONS }, () => ({ jti: 'a'.repeat(64), exp: NOW }))],
  ])('cannot be made with %s %j', async (member, value) => {
    const made = signRevocations({ ...payload, [member]: value } as RevocationsPayload, issuer.signingKey);
    await expect(made).rejects.toMatchObject({ reason: 'revocations-malformed' });
  });

  it('that were cut short anywhere are malformed, also for whoever only passes them on', () => {
    for (let length = 0; length < text.length; length++)
      expect(() => readRevocations(text.slice(0, length))).toThrow(RevocationsRefusedError);
  });

  it('with any one character changed are refused', async () => {
    const alphabet = 'ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_.';
    await fc.assert(
      fc.asyncProperty(fc.nat(), fc.nat(alphabet.length - 1), async (at, to) => {
        const place = at % text.length;
        // The last character of a part carries bits that no byte holds.
        if ([undefined, '.'].includes(text[place + 1]) || text[place] === alphabet[to]) return;
        expect(await outcome(text.slice(0, place) + alphabet[to] + text.slice(place + 1))).not.toBe('taken');
      }),
      { seed: 7, numRuns: 400 },
    );
  });

  it('any input gives a refusal, and no other exception', async () => {
    const input = fc.oneof(
      fc.string(),
      fc
        .tuple(fc.jsonValue(), fc.jsonValue(), fc.base64String())
        .map(([a, b, c]) => `${part(a)}.${part(b)}.${c}`),
      fc.jsonValue().map((value) => `${text.split('.')[0]}.${part(value)}.${text.split('.')[2]}`),
      fc.constant('x'.repeat(70_000)),
    );
    await fc.assert(
      fc.asyncProperty(input, async (list) => {
        expect(revocationsRefusals).toContain(await outcome(list));
      }),
      { seed: 8, numRuns: 300 },
    );
  });
});

describe('the next list', () => {
  const add = { ids: ['g2'], subjects: ['eve'], expiresAtS: NOW + 1000 };

  it('keeps what still counts, and drops what has ended', () => {
    const next = extendRevocations(payload, add, 'i', NOW + 10.5);
    expect(next).toEqual({
      ...{ iss: 'i', iat: NOW + 10, seq: NOW + 10 },
      grants: [
        { jti: 'g1', exp: NOW + 100 },
        { jti: 'g2', exp: NOW + 1000 },
      ],
      subjects: [
        { sub: 'ada', before: NOW, exp: NOW + 100 },
        { sub: 'eve', before: NOW + 11, exp: NOW + 1000 },
      ],
    });
    const later = extendRevocations(next, { ids: [], subjects: [], expiresAtS: 0 }, 'i', NOW + 500);
    expect([later.grants.map(({ jti }) => jti), later.subjects.map(({ sub }) => sub)]).toEqual([
      ['g2'],
      ['eve'],
    ]);
  });

  it('rises also in the same second, with a clock that goes back, and after the earlier list was lost', () => {
    const first = extendRevocations(null, add, 'i', NOW);
    const second = extendRevocations(first, add, 'i', NOW);
    expect(extendRevocations(second, add, 'i', NOW - 1000).seq).toBe(NOW + 2);
    expect(extendRevocations(null, add, 'i', NOW + 5).seq).toBeGreaterThan(second.seq);
  });

  it('revokes a person’s grants up to now, also twice, and not the next one', async () => {
    const before = await grantTo(issuer, NOW, { sub: 'eve' });
    const first = extendRevocations(null, { ...add, ids: [] }, 'i', NOW);
    const twice = extendRevocations(first, { ...add, ids: [] }, 'i', NOW + 5);
    expect(twice.subjects).toEqual([{ sub: 'eve', before: NOW + 6, exp: NOW + 1000 }]);
    const list = new KnownRevocations('k1');
    list.add(first, NOW);
    const read = async (claims: typeof before.claims) =>
      verifyGrant(await issueGrant(claims, issuer.signingKey), { keys, robot: null, nowS: NOW + 1 });
    expect(list.revokes(await read(before.claims), NOW + 1)).toBe(true);
    expect(list.revokes(await read({ ...before.claims, iat: NOW + 1 }), NOW + 1)).toBe(false);
  });
});
