import { issueGrant, keyThumbprint, makeIdentity, makeOperatorKey, type OperatorKey } from '@farpoint/grants';
import { grantTo, makeIssuer, type TestIssuer } from '@farpoint/grants/testing';
import fc from 'fast-check';
import { beforeAll, describe, expect, it } from 'vitest';
import { type KnownRobots, knownInMemory } from './known-robots.ts';
import { grantFor, type OperatorCredentials, readTicket } from './operator-credentials.ts';
import { type ReceivedOffer, SessionAdmission, StrangeRobotError } from './session-admission.ts';

const NOW = 1_800_000_000;
const fingerprint = (byte: number) =>
  Array.from({ length: 32 }, () => byte.toString(16).padStart(2, '0').toUpperCase()).join(':');
const sdp = (byte: number) => `v=0\r\na=fingerprint:sha-256 ${fingerprint(byte)}\r\n`;

let [robotKey, otherKey]: OperatorKey[] = [];
let [thumbprint, otherThumbprint] = ['', ''];
let issuer: TestIssuer;
beforeAll(async () => {
  [robotKey, otherKey] = await Promise.all([makeOperatorKey(), makeOperatorKey()]);
  [thumbprint, otherThumbprint] = await Promise.all([mine(), keyThumbprint(otherKey.publicJwk)]);
  issuer = await makeIssuer();
});
const mine = () => keyThumbprint((robotKey as OperatorKey).publicJwk);

interface Change {
  known?: KnownRobots;
  credentials?: readonly OperatorCredentials[];
}
const admissionOf = ({ known = knownInMemory(), credentials = [] }: Change = {}) =>
  new SessionAdmission({
    ...{ robotId: 'r1', session: 's1', known, nowS: () => NOW },
    credentials: async () => credentials,
  });

const identityOf = (change: Partial<Parameters<typeof makeIdentity>[0]> = {}, key = robotKey) =>
  makeIdentity(
    { robot: 'r1', session: 's1', robotFingerprint: fingerprint(2), ...change },
    key as OperatorKey,
    NOW,
  );

/** `taken`, or why the robot is a stranger. Any other exception fails the test. */
async function outcome(admission: SessionAdmission, offer: ReceivedOffer): Promise<string> {
  try {
    await admission.check(offer);
    return 'taken';
  } catch (error) {
    if (!(error instanceof StrangeRobotError)) throw error;
    return error.reason;
  }
}

describe('the robot', () => {
  it('is remembered at the first session, once DTLS has shown the certificate, and recognised later', async () => {
    const known = knownInMemory();
    const first = admissionOf({ known });
    expect(await outcome(first, { sdp: sdp(2), identity: await identityOf() })).toBe('taken');
    expect(known.get('r1')).toBeUndefined();
    first.connected();
    expect(known.get('r1')).toBe(thumbprint);
    expect(await outcome(admissionOf({ known }), { sdp: sdp(2), identity: await identityOf() })).toBe(
      'taken',
    );
  });

  it('is a stranger with another key, and both keys are named', async () => {
    const admission = admissionOf({ known: knownInMemory({ r1: thumbprint }) });
    const offer = { sdp: sdp(2), identity: await identityOf({}, otherKey) };
    const error = await admission.check(offer).catch((fault: unknown) => fault);
    expect(error).toMatchObject({
      reason: 'robot-key-changed',
      changed: { robotId: 'r1', known: thumbprint, shown: otherThumbprint, byGrant: false },
    });
  });

  it('is a stranger if it is known and proves nothing, and may be unknown without a key', async () => {
    const known = knownInMemory({ r1: thumbprint });
    expect(await outcome(admissionOf({ known }), { sdp: sdp(2) })).toBe('robot-unproven');
    const admission = admissionOf();
    expect(await outcome(admission, { sdp: sdp(2) })).toBe('taken');
    admission.connected();
  });

  it('is a stranger if its proof is for another robot, session or certificate', async () => {
    for (const change of [{ robot: 'r2' }, { session: 's2' }, { robotFingerprint: fingerprint(3) }]) {
      const offer = { sdp: sdp(2), identity: await identityOf(change) };
      expect(await outcome(admissionOf(), offer)).toBe('robot-unproven');
    }
    const two = `${sdp(2)}${sdp(3)}`;
    expect(await outcome(admissionOf(), { sdp: two, identity: await identityOf() })).toBe('robot-unproven');
  });

  it('is a stranger with any other identity', async () => {
    const genuine = await identityOf();
    await fc.assert(
      fc.asyncProperty(fc.nat(genuine.length - 1), fc.constantFrom(...'AB-_.z9'), async (at, letter) => {
        const identity = genuine.slice(0, at) + letter + genuine.slice(at + 1);
        // Base64url leaves bits of the last letter unused.
        fc.pre(letter !== genuine[at] && at < genuine.length - 1 && genuine[at + 1] !== '.');
        expect(await outcome(admissionOf(), { sdp: sdp(2), identity })).toBe('robot-unproven');
      }),
      { numRuns: 200, seed: 7 },
    );
    await fc.assert(
      fc.asyncProperty(fc.string({ maxLength: 3000 }), async (identity) => {
        expect(await outcome(admissionOf(), { sdp: sdp(2), identity })).toBe('robot-unproven');
      }),
      { numRuns: 100, seed: 7 },
    );
  });

  it('keeps its certificate in later offers, which need no identity', async () => {
    const admission = admissionOf();
    await admission.check({ sdp: sdp(2), identity: await identityOf() });
    expect(await outcome(admission, { sdp: `${sdp(2)}a=ice-ufrag:new\r\n` })).toBe('taken');
    expect(await outcome(admission, { sdp: sdp(3), identity: await identityOf() })).toBe('robot-unproven');
    expect(await outcome(admission, { sdp: 'v=0' })).toBe('robot-unproven');
  });

  it('is the one that the grant names, whatever was seen before', async () => {
    const { grant, key } = await grantTo(issuer, NOW, { robotKeys: { r1: thumbprint } });
    const known = knownInMemory({ r1: otherThumbprint });
    const admission = admissionOf({ known, credentials: [{ grant, key }] });
    expect(await outcome(admission, { sdp: sdp(2), identity: await identityOf() })).toBe('taken');
    admission.connected();
    expect(known.get('r1')).toBe(thumbprint);
    const forged = admissionOf({ known, credentials: [{ grant, key }] });
    const identity = await identityOf({}, otherKey);
    await expect(forged.check({ sdp: sdp(2), identity })).rejects.toMatchObject({
      changed: { byGrant: true },
    });
  });
});

describe('the operator', () => {
  it('shows a grant and a proof with its first answer only', async () => {
    const { grant, key } = await grantTo(issuer, NOW);
    const admission = admissionOf({ credentials: [{ grant, key }] });
    await admission.check({ sdp: sdp(2) });
    expect(await admission.show(sdp(1))).toEqual({ grant, proof: expect.any(String) });
    expect(await admission.show(sdp(1))).toEqual({});
  });

  it('shows no grant to a robot that it does not cover', async () => {
    const { grant, key } = await grantTo(issuer, NOW, { robots: ['kitchen-*'] });
    const admission = admissionOf({ credentials: [{ grant, key }] });
    await admission.check({ sdp: sdp(2) });
    expect(await admission.show(sdp(1))).toEqual({});
  });

  it('chooses what is valid, then what allows most, then what lasts longest', async () => {
    const { key, claims } = await grantTo(issuer, NOW);
    const made = async (jti: string, change: object) => ({
      key,
      grant: await issueGrant({ ...claims, jti, ...change }, issuer.signingKey),
    });
    const ended = await made('ended', { role: 'supervise', exp: NOW });
    const watch = await made('watch', { role: 'watch', exp: NOW + 9000 });
    const drive = await made('drive', { role: 'drive' });
    const longer = await made('longer', { role: 'drive', exp: NOW + 7200 });
    const foreign = { grant: (await grantTo(issuer, NOW, { role: 'supervise' })).grant, key };
    const chosen = async (...all: OperatorCredentials[]) =>
      (await grantFor([{ grant: 'rubbish', key }, foreign, ...all], 'r1', NOW))?.claims.jti;
    expect(await chosen(ended, watch, drive, longer)).toBe('longer');
    expect(await chosen(longer, drive, watch)).toBe('longer');
    expect(await chosen(watch, ended)).toBe('watch');
    expect(await chosen(ended)).toBe('ended');
    expect(await chosen()).toBeUndefined();
  });

  it('reads no ticket whose key is not the grant’s', async () => {
    for (const text of ['', 'farpoint-ticket.', 'farpoint-ticket.e30', 'x'.repeat(9000)])
      expect(await readTicket(text)).toBeNull();
  });
});
