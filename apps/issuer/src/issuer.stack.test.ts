/** The running issuer against a real OpenID Connect provider. */
import { generateKeyPairSync, type KeyObject, randomUUID } from 'node:crypto';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { type Grant, parseGrantKeys, verifyGrant } from '@farpoint/grants';
import { parseSignInAnswer, signInAddress } from '@farpoint/protocol';
import { useFolder } from '@farpoint/service/testing/folder';
import { afterAll, afterEach, beforeAll, describe, expect, it } from 'vitest';
import {
  type Forger,
  type Page,
  SignOn,
  type SignOnOptions,
  signedJwt,
  WebBrowser,
} from './testing/index.ts';

const folder = useFolder();
const PAGE = 'http://localhost:9/teleop/';
const KEY = 'k'.repeat(43);
const lines: string[] = [];
let forge: Forger | null = null;
let signOn: SignOn;

const options = (more: Partial<SignOnOptions> = {}): SignOnOptions => ({
  folder: join(folder, randomUUID()),
  pages: [PAGE],
  people: {
    ada: { name: 'Ada Lovelace', groups: ['drivers', 'staff'] },
    wim: { name: 'Wim', groups: ['guests'] },
  },
  rules: [
    { claim: 'groups', value: 'chiefs', role: 'supervise', robots: ['*'] },
    { claim: 'groups', value: 'drivers', role: 'drive', robots: ['kitchen-*'] },
  ],
  forge: (tokens, provider) => forge?.(tokens, provider),
  onLine: (line) => lines.push(line),
  ...more,
});

beforeAll(async () => {
  signOn = await SignOn.start(options());
}, 60_000);
afterEach(() => {
  forge = null;
});
afterAll(async () => {
  await signOn.stop();
}, 30_000);

const address = (at = signOn, change: { key?: string; return?: string } = {}) =>
  signInAddress(at.signInUrl, { key: KEY, return: `${PAGE}?robot=kitchen-1`, state: 'mine', ...change });
const signIn = (name: string, at = signOn) => new WebBrowser([PAGE]).signIn(address(at), name);
const answerOf = ({ url }: Page) => parseSignInAnswer(url.hash);

async function grantOf(page: Page, at = signOn): Promise<Grant> {
  const answer = answerOf(page);
  if (answer === null || !('grant' in answer)) throw new Error(`no grant: ${page.url.href} ${page.text}`);
  const keys = await parseGrantKeys(readFileSync(at.keysFile, 'utf8'));
  return await verifyGrant(answer.grant, { keys, robot: 'kitchen-1', nowS: Date.now() / 1000 });
}

/** A sign-in up to the address with which the provider sends the browser back. */
async function upToCallback(name: string): Promise<{ browser: WebBrowser; callback: string }> {
  const browser = new WebBrowser([PAGE, `${signOn.url}/callback`]);
  const { url } = await browser.signIn(address(), name);
  return { browser, callback: url.href };
}

describe('whom the rules permit', () => {
  it('gets a grant for its own key, and comes back to where it was', async () => {
    const page = await signIn('ada');
    expect(page.url.href).toMatch(/^http:\/\/localhost:9\/teleop\/\?robot=kitchen-1#grant=/);
    expect(answerOf(page)?.state).toBe('mine');
    const grant = await grantOf(page);
    expect(grant).toMatchObject({
      ...{
        subject: `${signOn.provider.url}#ada`,
        name: 'Ada Lovelace',
        role: 'drive',
        robots: ['kitchen-*'],
      },
      ...{ operatorKey: KEY, issuer: signOn.url },
    });
    expect(Math.round((grant.expiresAtS - Date.now() / 1000) / 3600)).toBe(12);
  });

  it('also where the provider’s ID token has no groups, and the issuer has a secret there', async () => {
    const secret = randomUUID();
    const other = await SignOn.start(
      options({ claimsInIdToken: false, clientSecret: secret, more: { userInfo: true, hours: 1 } }),
    );
    try {
      expect(await grantOf(await signIn('ada', other), other)).toMatchObject({
        name: 'Ada Lovelace',
        role: 'drive',
      });
    } finally {
      await other.stop();
    }
    expect(lines.filter((line) => line.includes(secret))).toEqual([]);
  });
});

describe('a link that somebody else made', () => {
  it('gets no grant for its key before the person has seen the page and the role, and agreed', async () => {
    const browser = new WebBrowser([PAGE]);
    const asked = await browser.signInAtProvider(address(signOn, { key: 'x'.repeat(43) }), 'ada');
    expect(asked.url.href).toMatch(/\/callback\?/);
    for (const shown of [PAGE, 'Ada Lovelace', 'drive', 'kitchen-*', 'x'.repeat(43), '12 h'])
      expect(asked.text).toContain(shown);
    expect(asked.text).not.toContain('#grant');
    expect(answerOf(await browser.allow(asked, 'no'))).toEqual({ error: 'cancelled', state: 'mine' });
    // Not by another site's form.
    const headers = { origin: 'https://evil.example' };
    const forged = await fetch(`${signOn.url}/consent`, { method: 'POST', headers, body: 'answer=yes' });
    expect(forged.status).toBe(403);
  });
});

describe('who is refused', () => {
  it('who cancels at the provider', async () => {
    const browser = new WebBrowser([PAGE]);
    const { url } = await browser.open(address());
    expect(answerOf(await browser.open(`${url.href}/abort`))).toMatchObject({ error: 'cancelled' });
  });

  it('who brings another browser’s code, with or without a sign-in of its own', async () => {
    const { browser, callback } = await upToCallback('ada');
    const thief = new WebBrowser([PAGE]);
    expect(await thief.open(callback)).toMatchObject({
      status: 400,
      text: expect.stringContaining('this browser'),
    });
    const own = await upToCallback('wim');
    expect(await own.browser.open(callback)).toMatchObject({ url: new URL(callback) });
    // Another's code in a sign-in of one's own: the verifier does not match.
    const mixed = new URL(own.callback);
    mixed.searchParams.set('code', new URL(callback).searchParams.get('code') ?? '');
    own.browser.stopAt = [PAGE];
    expect(answerOf(await own.browser.open(mixed.href))).toMatchObject({ error: 'provider-refused' });
    // Nothing of this disturbs whoever it belongs to.
    browser.stopAt = [PAGE];
    expect((await grantOf(await browser.allow(await browser.open(callback)))).name).toBe('Ada Lovelace');
  });

  const stranger = generateKeyPairSync('rsa', { modulusLength: 2048 }).privateKey;
  type Made = (claims: Record<string, unknown>, provider: Parameters<Forger>[1]) => string;
  const signed =
    (change: object, by: { key?: KeyObject; keyId?: string } = {}): Made =>
    (claims, provider) => {
      const { key, keyId } = { ...provider, ...by };
      return signedJwt({ alg: 'RS256', kid: keyId }, { ...claims, ...change }, key);
    };
  it.each<[string, Made]>([
    ['signed by another key', signed({}, { key: stranger })],
    ['of an unknown key', signed({}, { key: stranger, keyId: 'other' })],
    [
      'not signed',
      (claims) => `${signedJwt({ alg: 'none' }, claims, stranger).split('.').slice(0, 2).join('.')}.`,
    ],
    ['for another client', signed({ aud: 'x' })],
    ['of another provider', signed({ iss: 'https://x.example' })],
    ['of another sign-in', signed({ nonce: 'x' })],
    ['that has expired', signed({ exp: 1 })],
    ['that is no token', () => 'rubbish'],
  ])('an ID token %s', async (_, made) => {
    forge = (tokens, provider) => {
      const [, payload = ''] = String(tokens.id_token).split('.');
      const claims = JSON.parse(Buffer.from(payload, 'base64url').toString()) as Record<string, unknown>;
      tokens.id_token = made({ ...claims, groups: ['chiefs'] }, provider);
    };
    expect(answerOf(await signIn('ada'))).toEqual({ error: 'unproven', state: 'mine' });
  });

  it('an issuer that the provider does not know by its secret', async () => {
    const other = await SignOn.start(options({ clientSecret: 'right', more: { clientSecret: 'wrong' } }));
    try {
      expect(answerOf(await signIn('ada', other))).toMatchObject({ error: 'provider-refused' });
    } finally {
      await other.stop();
    }
  });

  it('a page that is not one of ours, and a request that is none', async () => {
    const browser = new WebBrowser([PAGE]);
    expect(await browser.open(address(signOn, { return: 'https://evil.example/' }))).toMatchObject({
      status: 400,
    });
    expect(await browser.open(signOn.signInUrl)).toMatchObject({ status: 400 });
    expect(await browser.open(`${signOn.url}/callback`)).toMatchObject({ status: 400 });
    expect(await browser.open(`${signOn.url}/metrics`)).toMatchObject({ status: 404 });
    expect(await browser.open(signOn.signInUrl, { key: KEY })).toMatchObject({ status: 405 });
  });
});

describe('a provider', () => {
  it('that is away is said to be, and is used again when it is back, with the keys it has then', async () => {
    const { browser, callback } = await upToCallback('ada');
    await signOn.provider.close();
    browser.stopAt = [PAGE];
    expect(answerOf(await browser.open(callback))).toMatchObject({ error: 'provider-unreachable' });
    await signOn.stopIssuer();
    await signOn.startIssuer();
    expect(answerOf(await new WebBrowser([PAGE]).open(address()))).toMatchObject({
      error: 'provider-unreachable',
    });
    await signOn.restartProvider();
    expect((await grantOf(await signIn('ada'))).name).toBe('Ada Lovelace');
    // Keys that nobody announced cost one sign-in.
    await signOn.provider.close();
    await signOn.restartProvider();
    expect(answerOf(await signIn('ada'))).toMatchObject({ error: 'unproven' });
    expect((await grantOf(await signIn('ada'))).name).toBe('Ada Lovelace');
  }, 60_000);
});

describe('the service', () => {
  it('answers nothing that a browser may keep, frame or read as something else', async () => {
    const response = await fetch(address(), { redirect: 'manual' });
    expect(response.status).toBe(303);
    expect(Object.fromEntries(response.headers)).toMatchObject({
      ...{
        'cache-control': 'no-store',
        'referrer-policy': 'no-referrer',
        'x-content-type-options': 'nosniff',
      },
      'content-security-policy': expect.stringContaining("frame-ancestors 'none'"),
      'set-cookie': expect.stringMatching(/; HttpOnly; SameSite=Lax$/),
    });
  });

  it('counts how sign-ins end, and says how it is', async () => {
    const metrics = await (await fetch(`${signOn.adminUrl}/metrics`)).text();
    expect(metrics).toMatch(/farpoint_issuer_sign_ins_total\{outcome="granted"\} \d/);
    expect(metrics).toMatch(/farpoint_issuer_pending_sign_ins \d/);
    const health = (await (await fetch(`${signOn.adminUrl}/healthz`)).json()) as { checks: object };
    expect(health.checks).toMatchObject({ provider: { ok: true, detail: { reachable: true } } });
  });

  it('logs who got what, and no token, code or state', async () => {
    const { browser, callback } = await upToCallback('ada');
    browser.stopAt = [PAGE];
    const page = await browser.allow(await browser.open(callback));
    const answer = answerOf(page);
    const log = lines.join('\n');
    expect(log).toContain('Ada Lovelace');
    const { searchParams } = new URL(callback);
    const secrets = [
      searchParams.get('code'),
      searchParams.get('state'),
      answer !== null && 'grant' in answer ? answer.grant : null,
    ];
    expect(secrets.filter((secret) => secret === null || log.includes(secret))).toEqual([]);
  });
});
