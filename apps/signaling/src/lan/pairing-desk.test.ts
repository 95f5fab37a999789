import { makeSigningKey, parseGrantKeys, parseSigningKey, verifyGrant } from '@farpoint/grants';
import { parseSignInAnswer, signInAddress } from '@farpoint/protocol';
import fc from 'fast-check';
import { beforeEach, describe, expect, test } from 'vitest';
import { MOST_GUESSES, PAUSE_MS, PairingCodes } from './pairing-codes.ts';
import { PairingDesk } from './pairing-desk.ts';

const KEY = 'k'.repeat(43);
const PAGE = 'https://laptop.local:8443/?robot=r1';
const NOW = Date.parse('2026-11-27T12:00:00Z');
const { secretJwk, publicJwk } = await makeSigningKey();
const signingKey = await parseSigningKey(JSON.stringify(secretJwk));

let paired: object[];
let desk: PairingDesk;
beforeEach(() => {
  paired = [];
  desk = new PairingDesk({
    ...{ signingKey, hours: 12 },
    codes: new PairingCodes({ random: () => 123_456, onCode: () => {} }),
    isOwnPage: (address) => new URL(address).origin === 'https://laptop.local:8443',
    onPaired: (facts) => paired.push(facts),
  });
});

const request = (back = PAGE) =>
  new URL(signInAddress('https://laptop.local:8443/pair', { key: KEY, return: back, state: 's1' }))
    .searchParams;
const form = (code: string, back = PAGE) => new URLSearchParams([...request(back), ['code', code]]);

describe('the pairing desk', () => {
  test('gives a browser with the code a grant for its own key', async () => {
    expect(desk.begin(request(), NOW)).toMatchObject({ prompt: 'type', request: { key: KEY, return: PAGE } });
    const reply = await desk.finish(form('123 456'), NOW);
    const back = new URL('redirect' in reply ? reply.redirect : '');
    const { hash } = back;
    back.hash = '';
    expect(back.href).toBe(PAGE);
    const answer = parseSignInAnswer(hash);
    expect(answer).toMatchObject({ state: 's1' });
    const keys = await parseGrantKeys(JSON.stringify({ keys: [publicJwk] }));
    const nowS = NOW / 1000;
    const text = answer !== null && 'grant' in answer ? answer.grant : '';
    const grant = await verifyGrant(text, { keys, robot: 'r1', nowS });
    expect(grant).toMatchObject({
      ...{ role: 'drive', robots: ['*'], operatorKey: KEY },
      ...{ issuedAtS: nowS, expiresAtS: nowS + 12 * 3600 },
    });
    expect(paired).toEqual([{ subject: grant.subject, grant: grant.id }]);
  });

  test('asks again after a wrong code, and not at all after too many', async () => {
    desk.begin(request(), NOW);
    for (let i = 1; i < MOST_GUESSES; i++)
      expect(await desk.finish(form('000000'), NOW)).toMatchObject({ prompt: 'wrong' });
    expect(await desk.finish(form('000000'), NOW)).toMatchObject({ prompt: 'used-up' });
    expect(desk.begin(request(), NOW)).toMatchObject({ prompt: 'paused' });
    expect(await desk.finish(form('123456'), NOW)).toMatchObject({ prompt: 'paused' });
    expect(desk.begin(request(), NOW + PAUSE_MS)).toMatchObject({ prompt: 'type' });
    expect(paired).toEqual([]);
  });

  test('after a code has expired, makes another one at once', async () => {
    expect(await desk.finish(form('123456'), NOW)).toMatchObject({ prompt: 'expired' });
    expect(await desk.finish(form('123456'), NOW)).toHaveProperty('redirect');
  });

  test.each([
    'https://evil.example/',
    'https://laptop.local:8444/',
    'http://laptop.local:8443/',
    'javascript:alert(1)',
  ])('sends no browser to %s, and makes no code for it', async (back) => {
    expect(desk.begin(request(back), NOW)).toMatchObject({ status: 400 });
    expect(await desk.finish(form('123456', back), NOW)).toMatchObject({ status: 400 });
    expect(await desk.finish(form('123456'), NOW)).toMatchObject({ prompt: 'expired' });
  });

  test('takes any form without a fault, and pairs by none', async () => {
    await fc.assert(
      fc.asyncProperty(
        fc.array(fc.tuple(fc.constantFrom('key', 'return', 'state', 'code'), fc.string())),
        async (pairs) => {
          expect(await desk.finish(new URLSearchParams(pairs), NOW)).not.toHaveProperty('redirect');
        },
      ),
    );
  });
});
