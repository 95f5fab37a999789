import { createHmac } from 'node:crypto';
import fc from 'fast-check';
import { base64url, CompactSign } from 'jose';
import { beforeAll, describe, expect, it } from 'vitest';
import { type AdmissionRequest, admit } from './admission.ts';
import { readGrant, verifyGrant } from './grant.ts';
import { MAX_GRANT_LENGTH, MAX_ROBOTS } from './grant-claims.ts';
import { type GrantKeys, parseGrantKeys } from './grant-keys.ts';
import { makeOperatorKey } from './operator-key.ts';
import { MAX_PROOF_LENGTH, makeProof, PROOF_LEEWAY_S, type SessionFacts } from './proof.ts';
import { GrantRefusedError, grantRefusals, refusalText } from './refusal.ts';
import { type GrantedOperator, grantTo, makeIssuer, type TestIssuer } from './testing/issuer.ts';

const NOW = 1_800_000_000;
const fingerprint = (byte: number) =>
  Array.from({ length: 32 }, () => byte.toString(16).padStart(2, '0').toUpperCase()).join(':');
const sdp = (byte: number) => `v=0\r\na=fingerprint:sha-256 ${fingerprint(byte)}\r\n`;
const facts: SessionFacts = {
  ...{ robot: 'kitchen-1', session: 's1' },
  ...{ operatorFingerprint: fingerprint(1), robotFingerprint: fingerprint(2) },
};

let issuer: TestIssuer;
let keys: GrantKeys;
let ada: GrantedOperator;
let proof: string;
beforeAll(async () => {
  issuer = await makeIssuer();
  keys = await parseGrantKeys(JSON.stringify({ keys: [issuer.publicJwk] }));
  ada = await grantTo(issuer, NOW);
  proof = await makeProof(ada.grant, facts, ada.key, NOW);
});

/** `admitted`, or the reason. Any other exception fails the test. */
async function outcome(change: Partial<AdmissionRequest>, nowS = NOW, robot = facts.robot): Promise<string> {
  const request = { session: 's1', sdp: sdp(1), grant: ada.grant, proof, ...change };
  try {
    await admit(request, { keys, robot, offer: sdp(2), nowS });
    return 'admitted';
  } catch (error) {
    if (!(error instanceof GrantRefusedError)) throw error;
    expect(error.message).toContain(error.reason);
    return error.reason;
  }
}

const part = (value: unknown) => base64url.encode(new TextEncoder().encode(JSON.stringify(value)));
const granted = async (change: Parameters<typeof grantTo>[2], by = issuer) =>
  (await grantTo(by, NOW, { cnf: ada.claims.cnf, ...change })).grant;
/** Ada's own proof for another grant of hers. */
const withProof = async (grant: string) => ({ grant, proof: await makeProof(grant, facts, ada.key, NOW) });

describe('grants', () => {
  it('admits the holder, and says who it is and what it may do', async () => {
    const grant = await admit(
      { session: 's1', sdp: sdp(1), grant: ada.grant, proof },
      { keys, robot: 'kitchen-1', offer: sdp(2), nowS: NOW },
    );
    expect(grant).toMatchObject({
      ...{ subject: 'ada', name: 'Ada Lovelace', role: 'drive', expiresAtS: NOW + 3600, keyId: 'k1' },
    });
  });

  it('admits with a grant signed by ES256', async () => {
    const other = await makeIssuer('k2', 'ES256');
    const both = await parseGrantKeys(JSON.stringify({ keys: [issuer.publicJwk, other.publicJwk] }));
    const grant = await granted({}, other);
    await expect(verifyGrant(grant, { keys: both, robot: 'r', nowS: NOW })).resolves.toMatchObject({
      keyId: 'k2',
    });
    expect(await outcome(await withProof(grant))).toBe('grant-untrusted');
  });

  it('refuses a missing grant or proof', async () => {
    expect(await outcome({ grant: undefined })).toBe('grant-missing');
    expect(await outcome({ proof: undefined })).toBe('proof-missing');
  });

  it('refuses another issuer under the same kid, and a changed claim', async () => {
    const forger = await makeIssuer('k1');
    expect(await outcome(await withProof(await granted({ role: 'supervise' }, forger)))).toBe(
      'grant-untrusted',
    );
    const [header, , signature] = ada.grant.split('.');
    const raised = `${header}.${part({ ...ada.claims, role: 'supervise' })}.${signature}`;
    expect(await outcome(await withProof(raised))).toBe('grant-untrusted');
  });

  it('refuses alg none, HS256 by the public key, and another algorithm than the key’s', async () => {
    const payload = ada.grant.split('.')[1];
    const header = (alg: string) => part({ typ: 'farpoint-grant+jwt', alg, kid: 'k1' });
    const { x } = issuer.publicJwk as { x: string };
    const signed = `${header('HS256')}.${payload}`;
    for (const secret of [base64url.decode(x), x, JSON.stringify(issuer.publicJwk)]) {
      const mac = createHmac('sha256', secret).update(signed).digest('base64url');
      expect(await outcome(await withProof(`${signed}.${mac}`))).toBe('grant-untrusted');
    }
    for (const alg of ['none', 'None', '', 'ES256', 'EdDSA ']) {
      expect(await outcome(await withProof(`${header(alg)}.${payload}.`))).toBe('grant-untrusted');
    }
    expect(await outcome(await withProof(`${header('EdDSA')}.${payload}.`))).toBe('grant-untrusted');
  });

  it('refuses a header with critical extensions, and one of another type', async () => {
    const sign = (header: object) =>
      new CompactSign(new TextEncoder().encode(JSON.stringify(ada.claims)))
        .setProtectedHeader({ alg: 'EdDSA', kid: 'k1', typ: 'farpoint-grant+jwt', ...header })
        .sign(issuer.signingKey.key);
    expect(await outcome(await withProof(await sign({ typ: 'JWT' })))).toBe('grant-malformed');
    const head = part({ alg: 'EdDSA', kid: 'k1', typ: 'farpoint-grant+jwt', crit: ['b64'], b64: false });
    const [, payload, signature] = ada.grant.split('.');
    expect(await outcome(await withProof(`${head}.${payload}.${signature}`))).toMatch(/^grant-/);
  });

  it.each([
    ['grant-expired', { exp: NOW }],
    ['admitted', { exp: NOW + 1 }],
    ['grant-not-yet', { nbf: NOW + 61 }],
    ['grant-not-yet', { iat: NOW + 61 }],
    ['admitted', { nbf: NOW + 60, iat: NOW + 60 }],
    ['grant-other-robot', { robots: ['kitchen-2', 'hall*'] }],
    ['admitted', { robots: ['hall*', 'kitchen-*'] }],
    ['grant-other-audience', { aud: 'elsewhere' }],
    ['admitted', { aud: ['elsewhere', 'farpoint'] }],
    ['grant-malformed', { role: 'root' as 'drive' }],
    ['grant-malformed', { robots: [] }],
    ['grant-malformed', { exp: Number.NaN }],
    ['grant-malformed', { name: 'a\nb' }],
  ] as const)('%s: %j', async (expected, change) => {
    const grant = await granted({
      ...change,
      robots: [...((change as { robots?: string[] }).robots ?? ['*'])],
    } as never);
    expect(await outcome(await withProof(grant))).toBe(expected);
  });

  it('the largest grant and proof fit their limits', async () => {
    const long = 'a'.repeat(64);
    const name = '\u{1f600}'.repeat(32);
    const grant = await granted({
      ...{ iss: 'i'.repeat(128), sub: 's'.repeat(128), name, jti: long },
      robots: Array.from({ length: MAX_ROBOTS }, () => long),
    });
    expect(grant.length).toBeLessThan(MAX_GRANT_LENGTH);
    const largest = await makeProof(grant, { ...facts, robot: long, session: long }, ada.key, NOW);
    expect(largest.length).toBeLessThan(MAX_PROOF_LENGTH);
  });
});

describe('proofs', () => {
  const made = async (change: Partial<SessionFacts>, key = ada.key, nowS = NOW) => ({
    proof: await makeProof(ada.grant, { ...facts, ...change }, key, nowS),
  });

  it('refuses another key than the grant’s', async () => {
    expect(await outcome(await made({}, await makeOperatorKey()))).toBe('proof-wrong-key');
    // The grant's key in the header, signed by another.
    const { privateKey } = await makeOperatorKey();
    expect(await outcome(await made({}, { ...ada.key, privateKey }))).toBe('proof-forged');
  });

  it('refuses a proof for another session, robot, certificate or grant', async () => {
    expect(await outcome(await made({ session: 's2' }))).toBe('proof-other-session');
    expect(await outcome(await made({ robot: 'kitchen-2' }))).toBe('proof-other-robot');
    expect(await outcome(await made({ operatorFingerprint: fingerprint(3) }))).toBe(
      'proof-other-fingerprint',
    );
    expect(await outcome(await made({ robotFingerprint: fingerprint(3) }))).toBe('proof-other-fingerprint');
    expect(await outcome({ sdp: sdp(3) })).toBe('proof-other-fingerprint');
    expect(await outcome({ sdp: sdp(1) + sdp(3) })).toBe('proof-other-fingerprint');
    expect(await outcome({ sdp: 'v=0\r\n' })).toBe('proof-other-fingerprint');
    expect(await outcome({ session: 's2' })).toBe('proof-other-session');
    expect(await outcome({ grant: await granted({ jti: 'g2' }) })).toBe('proof-other-grant');
  });

  it('refuses a proof by a clock that is too far off', async () => {
    for (const sign of [-1, 1]) {
      expect(await outcome(await made({}, ada.key, NOW + sign * (PROOF_LEEWAY_S + 1)))).toBe('proof-stale');
      expect(await outcome(await made({}, ada.key, NOW + sign * PROOF_LEEWAY_S))).toBe('admitted');
    }
  });

  it('refuses a private key in the header, a grant as a proof, and a key that is no point', async () => {
    const [header = '', payload, signature] = proof.split('.');
    const { jwk, ...rest } = JSON.parse(new TextDecoder().decode(base64url.decode(header))) as {
      jwk: Record<string, string>;
    };
    const withJwk = (changed: object) => `${part({ ...rest, jwk: changed })}.${payload}.${signature}`;
    expect(await outcome({ proof: withJwk({ ...jwk, d: jwk.x }) })).toBe('proof-malformed');
    expect(await outcome({ proof: ada.grant })).toBe('proof-malformed');
    expect(await outcome({ proof: withJwk({ ...jwk, y: jwk.x }) })).toMatch(/^proof-/);
    expect(await outcome({ grant: proof })).toBe('grant-malformed');
  });
});

describe('any input', () => {
  it('gives a refusal with a text, and no other exception', async () => {
    const text = fc.oneof(
      fc.string(),
      fc.stringMatching(/^[\w-]{1,40}\.[\w-]{1,40}\.[\w-]{0,40}$/),
      fc
        .tuple(fc.jsonValue(), fc.jsonValue(), fc.base64String())
        .map(([a, b, c]) => `${part(a)}.${part(b)}.${c}`),
      fc.constant('x'.repeat(5000)),
    );
    await fc.assert(
      fc.asyncProperty(text, text, async (grant, other) => {
        expect(grantRefusals).toContain(await outcome({ grant }));
        expect(grantRefusals).toContain(await outcome({ proof: other }));
      }),
      { seed: 5, numRuns: 300 },
    );
  });

  it('with any one character of grant, proof or fingerprint changed is refused', async () => {
    const alphabet = 'ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_.';
    await fc.assert(
      fc.asyncProperty(fc.boolean(), fc.nat(), fc.nat(alphabet.length - 1), async (inGrant, at, to) => {
        const text = inGrant ? ada.grant : proof;
        const place = at % text.length;
        // The last character of a part carries bits that no byte holds.
        if ([undefined, '.'].includes(text[place + 1]) || text[place] === alphabet[to]) return;
        const changed = text.slice(0, place) + alphabet[to] + text.slice(place + 1);
        expect(await outcome(inGrant ? { grant: changed } : { proof: changed })).not.toBe('admitted');
      }),
      { seed: 6, numRuns: 400 },
    );
  });

  it('every reason has a text for the operator, which names nothing of the grant', () => {
    for (const reason of grantRefusals) expect(refusalText(reason)).toMatch(/^[a-z][^.]{10,100}$/);
  });

  it('shows what is in a grant that is not valid', () => {
    expect(readGrant(ada.grant)).toEqual({ claims: ada.claims, keyId: 'k1' });
    expect(() => readGrant('x')).toThrow(GrantRefusedError);
  });
});
