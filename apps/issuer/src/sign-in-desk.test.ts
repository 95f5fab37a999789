import { parseGrantKeys, verifyGrant } from '@farpoint/grants';
import { makeIssuer } from '@farpoint/grants/testing';
import { parseSignInAnswer, signInAddress } from '@farpoint/protocol';
import { anyAddress } from '@farpoint/service/testing/any-address';
import fc from 'fast-check';
import { beforeEach, describe, expect, it } from 'vitest';
import { AddressLimiter } from './address-limiter.ts';
import { BrowserCookie } from './browser-cookie.ts';
import { consentPage, consentPolicy } from './consent-page.ts';
import { SIGN_IN_TIME_MS } from './pending-sign-ins.ts';
import type { SignedIn } from './provider.ts';
import { SignInRefusedError } from './provider-fault.ts';
import { type DeskOptions, isAllowedPage, type Reply, SignInDesk } from './sign-in-desk.ts';

const issuer = await makeIssuer();
const keys = await parseGrantKeys(JSON.stringify({ keys: [issuer.publicJwk] }));
const KEY = 'k'.repeat(43);
const BACK = 'https://teleop.example/?robot=r1';
const NOW = 1_800_000_000_000;

let outcomes: string[];
let person: SignedIn;
let fault: Error | null;
let state: string;
let desk: SignInDesk;

/** What comes after the provider. The provider itself is in issuer.stack.test.ts. */
const provider: DeskOptions['provider'] = {
  begin: async (given) => {
    if (fault !== null) throw fault;
    state = given;
    return `https://login.example/?state=${given}`;
  },
  finish: async () => {
    if (fault !== null) throw fault;
    return person;
  },
};

beforeEach(() => {
  [outcomes, fault, state] = [[], null, ''];
  person = { issuer: 'https://login.example', sub: 'u1', claims: { name: 'Ada', groups: ['drivers'] } };
  desk = new SignInDesk({
    ...{ provider, signingKey: issuer.signingKey, signInsPerMinute: 3, pages: ['https://teleop.example/'] },
    terms: { issuer: 'https://issuer.example', hours: 12, robotKeys: {} },
    rules: [{ claim: 'groups', value: 'drivers', role: 'drive', robots: ['r*'] }],
    onOutcome: (outcome) => outcomes.push(outcome),
  });
});

const caller = (browser: string | null = null, address = '192.0.2.1') => ({ address, browser });
const asked = (change: object = {}) =>
  new URL(
    signInAddress('https://issuer.example/sign-in', { key: KEY, return: BACK, state: 'mine', ...change }),
  ).searchParams;
const begun = async (from = caller()) => {
  const reply = await desk.begin(asked(), from, NOW);
  if (!('redirect' in reply)) throw new Error('nobody is sent to the provider');
  return reply.browser ?? '';
};
const back = (given: string) => new URLSearchParams({ code: 'c', state: given });
/** Says yes to what the person is asked. */
const agree = async (reply: Reply, answer = 'yes', nowMs = NOW): Promise<Reply> => {
  if (!('consent' in reply)) return reply;
  return desk.answer(
    new URLSearchParams({ token: reply.consent.token, answer }),
    caller(reply.browser),
    nowMs,
  );
};
/** The provider sends the newest sign-in's browser back, and the person agrees. */
const finish = async (browser: string, nowMs = NOW) =>
  agree(await desk.finish(back(state), caller(browser), nowMs), 'yes', nowMs);
const answerOf = (reply: Reply) =>
  'redirect' in reply ? parseSignInAnswer(new URL(reply.redirect).hash) : null;

describe('a sign-in', () => {
  it('ends on the page with a grant for its key', async () => {
    const reply = await finish(await begun());
    const answer = answerOf(reply);
    expect('redirect' in reply && reply.redirect).toMatch(/^https:\/\/teleop\.example\/\?robot=r1#grant=/);
    expect(answer?.state).toBe('mine');
    const grant = await verifyGrant(answer !== null && 'grant' in answer ? answer.grant : '', {
      keys,
      robot: 'r1',
      nowS: NOW / 1000,
    });
    expect(grant).toMatchObject({
      ...{ subject: 'https://login.example#u1', name: 'Ada', role: 'drive', operatorKey: KEY },
      ...{ issuer: 'https://issuer.example', expiresAtS: NOW / 1000 + 43_200 },
    });
    expect(outcomes).toEqual(['granted']);
  });

  it('signs nothing before the person has agreed, in time', async () => {
    const ask = async () => {
      const browser = await begun();
      return desk.finish(back(state), caller(browser), NOW);
    };
    expect(await ask()).toMatchObject({
      consent: { page: BACK, person: 'Ada', role: 'drive', robots: ['r*'], key: KEY, hours: 12 },
    });
    expect(outcomes).toEqual([]);
    expect(answerOf(await agree(await ask(), 'no'))).toEqual({ error: 'cancelled', state: 'mine' });
    expect(answerOf(await agree(await ask(), 'yes', NOW + SIGN_IN_TIME_MS))).toMatchObject({
      error: 'expired',
    });
    expect(outcomes).toEqual(['cancelled', 'expired']);
  });

  it('is refused in words that the page knows', async () => {
    person = { ...person, claims: { groups: ['guests'] } };
    expect(answerOf(await finish(await begun()))).toEqual({
      error: 'not-permitted',
      state: 'mine',
    });
    const browser = await begun();
    expect(answerOf(await finish(browser, NOW + SIGN_IN_TIME_MS))).toMatchObject({
      error: 'expired',
    });
    const again = await begun(caller(browser));
    expect(again).toBe(browser);
    fault = new SignInRefusedError('unproven', 'x');
    expect(answerOf(await finish(again))).toMatchObject({ error: 'unproven' });
    fault = new Error('a mistake of ours');
    expect(answerOf(await desk.begin(asked(), caller(null, '192.0.2.2'), NOW))).toMatchObject({
      error: 'issuer-failed',
    });
    expect(desk.pending).toBe(0);
  });

  it('is finished by nobody else, and once', async () => {
    const browser = await begun();
    const stranger = await begun();
    const [theirs] = [state];
    expect(await desk.finish(back(theirs), caller(browser), NOW)).toMatchObject({ status: 400 });
    expect(await desk.finish(back(theirs), caller(null), NOW)).toMatchObject({ status: 400 });
    const asked = await desk.finish(back(theirs), caller(stranger), NOW);
    const { token } = 'consent' in asked ? asked.consent : { token: '' };
    const form = new URLSearchParams({ token, answer: 'yes' });
    expect(await desk.answer(form, caller(browser), NOW)).toMatchObject({ status: 400 });
    expect(answerOf(await agree(asked))).toHaveProperty('grant');
    expect(await agree(asked)).toMatchObject({ status: 400 });
    const other = caller(stranger, '192.0.2.2');
    expect(await desk.finish(back(theirs), other, NOW)).toMatchObject({ status: 400 });
    expect(outcomes).toEqual([
      ...['other-browser', 'other-browser', 'other-browser', 'granted'],
      ...['unknown', 'unknown'],
    ]);
  });

  it('does not begin for a page that is not ours, nor for a request that is none', async () => {
    const evil = asked({ return: 'https://evil.example/' });
    expect(await desk.begin(evil, caller(), NOW)).toMatchObject({ status: 400 });
    expect(answerOf(await desk.begin(asked({ key: 'x' }), caller(), NOW))).toMatchObject({
      error: 'bad-request',
    });
    expect(desk.pending).toBe(0);
  });

  it('begins only so often for one address', async () => {
    for (let i = 0; i < 3; i++) await begun();
    expect(answerOf(await desk.begin(asked(), caller(), NOW))).toEqual({ error: 'too-many', state: 'mine' });
    expect(await begun(caller(null, '192.0.2.2'))).not.toBe('');
    for (let i = 0; i < 3; i++) await desk.finish(back('x'), caller(), NOW);
    for (let i = 0; i < 3; i++) await desk.answer(back('x'), caller(), NOW);
    expect(await desk.answer(back('x'), caller(), NOW)).toMatchObject({ status: 429 });
    expect(await desk.finish(back('x'), caller(), NOW)).toMatchObject({ status: 429 });
  });
});

it('whatever is asked, a browser is sent to the provider or to one of our pages, or nowhere', async () => {
  const text = fc.oneof(
    fc.string(),
    anyAddress,
    fc.constantFrom(BACK, KEY, 'https://teleop.example', '//evil.example'),
  );
  const query = fc.dictionary(fc.oneof(fc.string(), fc.constantFrom('key', 'return', 'state', 'code')), text);
  await fc.assert(
    fc.asyncProperty(query, async (members) => {
      for (const reply of [
        await desk.begin(new URLSearchParams(members), caller(), NOW),
        await desk.finish(new URLSearchParams(members), caller(), NOW),
      ]) {
        const { origin } = 'redirect' in reply ? new URL(reply.redirect) : { origin: null };
        expect(['https://login.example', 'https://teleop.example', null]).toContain(origin);
      }
    }),
  );
});

it.each([
  [['https://a.example/'], 'https://a.example/?y=1', true],
  [['https://a.example/'], 'https://a.example/x?y=1', false],
  [['https://a.example/'], 'https://b.example/', false],
  [['https://a.example/'], 'http://a.example/', false],
  [['https://a.example/'], 'javascript:alert(1)', false],
  [['https://a.example/'], 'https://a.example@b.example/', false],
  [['https://a.example/'], 'https://a.example:8443/', false],
  [['https://a.example'], 'https://a.example/', true],
  [['https://a.example'], 'https://a.example/x', false],
  [['https://a.example/teleop/'], 'https://a.example/teleop/', true],
  [['https://a.example/teleop/'], 'https://a.example/teleop/../open?to=b', false],
  [['https://a.example/teleop/'], 'https://a.example/teleop', false],
  [['https://a.example/index.html'], 'https://a.example/index.html?robot=r', true],
  [['https://a.example/index.html'], 'https://a.example/index.html/x', false],
  [['https://b.example/', 'http://localhost:3000/'], 'http://localhost:3000/?robot=r', true],
  [[], 'https://a.example/', false],
])('of the pages %j, %s: %s', (pages, address, allowed) => {
  expect(isAllowedPage(pages, address)).toBe(allowed);
});

it('the question shows whatever it is asked about as text, and lets a form go nowhere else', () => {
  fc.assert(
    fc.property(fc.string(), anyAddress, (text, page) => {
      const html = consentPage(
        { token: text, page, person: text, role: 'drive', robots: [text], hours: 0.5, key: text },
        '/consent',
      );
      expect(
        html.match(
          /<(?!\/?(?:html|head|meta|title|body|main|h1|p|strong|dl|dt|dd|code|form|input|button)\b)/g,
        ),
      ).toEqual(['<']);
      expect(html.match(/<(?:input|button|form|meta)\b/g)).toHaveLength(6);
      expect(consentPolicy(page)).toContain(`form-action 'self' ${new URL(page).origin};`);
    }),
  );
});

it('the cookie is the browser’s alone', () => {
  const secret = 's'.repeat(43);
  const cookie = new BrowserCookie(true);
  expect(cookie.write(secret)).toBe(
    `__Host-farpoint-sign-in=${secret}; Path=/; Max-Age=600; HttpOnly; SameSite=Lax; Secure`,
  );
  expect(cookie.read(`a=b; __Host-farpoint-sign-in=${secret}`)).toBe(secret);
  for (const header of [undefined, '', `farpoint-sign-in=${secret}`, '__Host-farpoint-sign-in=short', ';;=;'])
    expect(cookie.read(header)).toBeNull();
  expect(new BrowserCookie(false).write(secret)).not.toContain('Secure');
});

it('an address is forgiven with time, and its neighbours in a /64 count with it', () => {
  const limiter = new AddressLimiter(2);
  const take = (address: string, nowMs: number) => limiter.take(address, nowMs);
  expect([take('2001:db8::1', 0), take('2001:db8::2', 0), take('2001:db8::3', 0)]).toEqual([
    true,
    true,
    false,
  ]);
  expect([take('2001:db8::3', 29_000), take('2001:db8::3', 31_000)]).toEqual([false, true]);
});
