import {
  extendRevocations,
  makeProof,
  parseGrantKeys,
  type RevocableGrant,
  signRevocations,
} from '@farpoint/grants';
import { grantTo, makeIssuer } from '@farpoint/grants/testing';
import type { Operators } from '@farpoint/protocol';
import { silentLogger } from '@farpoint/service';
import { describe, expect, it, vi } from 'vitest';
import { ReasonCounts } from '../../ground/robot-counters.ts';
import { type Access, openAccess } from './access.ts';
import { type GuardedOperator, RobotAccess } from './robot-access.ts';

async function setUp() {
  let [nowS, nowMs] = [1000, 0];
  const [first, second] = await Promise.all([makeIssuer('k1'), makeIssuer('k2')]);
  const setOf = (...issuers: object[]) => parseGrantKeys(JSON.stringify({ keys: issuers }));
  const file = { keys: await setOf(first.publicJwk), reload: vi.fn<() => Promise<void>>() };
  file.reload.mockImplementation(async () => {
    file.keys = await setOf(second.publicJwk);
  });
  const log = { ...silentLogger(), warn: vi.fn(), info: vi.fn() };
  const refusals = new ReasonCounts();
  const access = new RobotAccess({
    files: { keys: file, journal: { start: { revoked: [], blocked: [] }, write: vi.fn() }, revocations: [] },
    ...{ robot: 'r1', refusals, revocationLists: new ReasonCounts(), nowS: () => nowS, now: () => nowMs },
    log: log as unknown as ReturnType<typeof silentLogger>,
  });
  const operator = (id: string, given: Access = openAccess('Ada')) => {
    const [send, close] = [vi.fn(), vi.fn()];
    const messages: GuardedOperator['messages'] = {
      id,
      access: given,
      operatorName: 'Ada',
      heardMs: 0,
      send,
    };
    const made: GuardedOperator = { messages, peer: { connected: true, close } };
    return { made, send, close };
  };
  /** An operator of a new session, and its answer, which proves this grant. */
  const showing = async ({ grant, key }: Awaited<ReturnType<typeof grantTo>>, session: string) => {
    const fingerprint = Array.from({ length: 32 }, () => 'AB').join(':');
    const sdp = `v=0\r\na=fingerprint:sha-256 ${fingerprint}\r\n`;
    const { made, close } = operator(session);
    access.offered(made, sdp);
    const facts = { robot: 'r1', session, operatorFingerprint: fingerprint, robotFingerprint: fingerprint };
    const proof = await makeProof(grant, facts, key, 1000);
    return { made, close, admitted: () => access.admits(made, { session, sdp, grant, proof }) };
  };
  const pass = (s: number) => {
    nowS += s;
    nowMs += s * 1000;
  };
  const enforce = (made: GuardedOperator[], driver: string | null = null) =>
    access.enforce(new Map(made.map((each) => [each.messages.id, each])), driver);
  return { access, operator, showing, pass, enforce, log, refusals, file, issuer: first };
}

const grant: RevocableGrant = { id: 'g1', subject: 'a', keyId: 'k1', issuedAtS: 900 };
const granted: Access = { role: 'drive', subject: 'a', name: 'Ada', expiresAtS: 1100, keyId: 'k1', grant };
/** What an operator was told, but for who is here. */
const told = (send: ReturnType<typeof vi.fn>) =>
  send.mock.calls.map(([message]) => message as { type: string }).filter(({ type }) => type !== 'operators');

it('warns once, a minute before the end, and ends the session at the end', async () => {
  const { operator, pass, enforce } = await setUp();
  const { made, send, close } = operator('s', granted);
  pass(39);
  enforce([made]);
  expect(told(send)).toEqual([]);
  pass(1.5);
  enforce([made]);
  enforce([made]);
  expect(told(send)).toEqual([{ type: 'expires', inS: 59 }]);
  pass(59);
  enforce([made]);
  expect(close).not.toHaveBeenCalled();
  pass(0.5);
  enforce([made]);
  expect(close).toHaveBeenCalledExactlyOnceWith('grant-expired', 'the grant has expired');
});

it('an operator that has not been admitted may do nothing, and neither is warned nor ended', async () => {
  const { access, operator, pass, enforce } = await setUp();
  const { made, send, close } = operator('s');
  access.offered(made, 'v=0');
  expect(made.messages.access).toMatchObject({ role: 'watch', name: 'Ada', keyId: null });
  pass(1e6);
  enforce([made]);
  expect([send.mock.calls, close.mock.calls]).toEqual([[], []]);
});

it('refuses once, and gives no second try', async () => {
  const { access, operator, refusals } = await setUp();
  const { made, close } = operator('s');
  expect(await access.admits(made, { session: 's', sdp: 'v=0' })).toBe(false);
  expect(close).not.toHaveBeenCalled();
  access.offered(made, 'v=0');
  const both = [1, 2].map(() => access.admits(made, { session: 's', sdp: 'v=0' }));
  expect(await Promise.all(both)).toEqual([false, false]);
  expect(await access.admits(made, { session: 's', sdp: 'v=0' })).toBe(false);
  expect(close).toHaveBeenCalledExactlyOnceWith(
    'not-granted',
    expect.stringContaining('only operators with'),
  );
  expect([...refusals.entries()]).toEqual([['grant-missing', 1]]);
});

it('logs ten refusals at once and one a second, with the number of those left out', async () => {
  const { access, operator, pass, log, refusals } = await setUp();
  const refuse = async (session: string) => {
    const { made } = operator(session);
    access.offered(made, 'v=0');
    await access.admits(made, { session, sdp: 'v=0', grant: 'x' });
  };
  for (let i = 0; i < 50; i++) await refuse(`s${i}`);
  expect(log.warn).toHaveBeenCalledTimes(10);
  pass(1);
  await refuse('last');
  expect(log.warn).toHaveBeenCalledTimes(11);
  expect(log.warn.mock.lastCall?.[0]).toMatchObject({ reason: 'grant-malformed', unreported: 40 });
  expect(refusals.get('grant-malformed')).toBe(51);
});

it('after a reload, ends the sessions of keys that are gone, and no others', async () => {
  const { access, operator, file } = await setUp();
  const [old, other, fresh] = [
    operator('a', granted),
    operator('b', { ...granted, keyId: 'k2' }),
    operator('c'),
  ];
  const all = [old, other, fresh].map(({ made }) => made);
  file.reload.mockImplementationOnce(() => Promise.reject(new Error('no JSON')));
  await expect(access.reload(() => all)).rejects.toThrow('no JSON');
  expect(old.close).not.toHaveBeenCalled();
  await access.reload(() => all);
  expect(old.close).toHaveBeenCalledExactlyOnceWith('not-granted', expect.any(String));
  expect([other.close.mock.calls, fresh.close.mock.calls]).toEqual([[], []]);
});

it('admits an operator with what its grant says, unless its key is removed meanwhile', async () => {
  const { access, showing, file, issuer, refusals } = await setUp();
  const shown = await grantTo(issuer, 1000, { role: 'supervise' });
  const [first, second] = [await showing(shown, 's1'), await showing(shown, 's2')];
  expect(await first.admitted()).toBe(true);
  expect(first.made.messages.access).toMatchObject({ role: 'supervise', subject: 'ada', keyId: 'k1' });
  // An answer to a later offer, of an ICE restart.
  expect(await access.admits(first.made, { session: 's1', sdp: 'v=0' })).toBe(true);
  const pending = second.admitted();
  file.keys = new Map();
  expect(await pending).toBe(false);
  expect([second.made.messages.access.role, refusals.get('grant-untrusted')]).toEqual(['watch', 1]);
});

describe('revocation', () => {
  const listOf = async (
    issuer: Awaited<ReturnType<typeof setUp>>['issuer'],
    ids: string[],
    subjects: string[] = [],
  ) =>
    signRevocations(
      extendRevocations(null, { ids, subjects, expiresAtS: 2000 }, 'test', 1000),
      issuer.signingKey,
    );

  it('ends the sessions of revoked grants, and no others', async () => {
    const { access, operator, issuer, enforce } = await setUp();
    const [first, second, other] = [
      operator('a', granted),
      operator('b', { ...granted, grant: { ...grant, id: 'g2', subject: 'b' } }),
      operator('c', { ...granted, keyId: 'k2', grant: { ...grant, keyId: 'k2' } }),
    ];
    const all = [first, second, other].map(({ made }) => made);
    await access.revocations.take(await listOf(issuer, ['g1']), 'test');
    enforce(all);
    expect(first.close).toHaveBeenCalledExactlyOnceWith('grant-revoked', 'the grant has been revoked');
    expect([second.close.mock.calls, other.close.mock.calls]).toEqual([[], []]);
  });

  it('refuses a revoked grant, also if the list comes while its proof is being verified', async () => {
    const { access, showing, issuer, refusals } = await setUp();
    const shown = await grantTo(issuer, 1000);
    const list = await listOf(issuer, [], ['ada']);
    const [first, second] = [await showing(shown, 's1'), await showing(shown, 's2')];
    expect(await first.admitted()).toBe(true);
    await access.revocations.take(list, 'test');
    expect(await second.admitted()).toBe(false);
    expect(second.close).toHaveBeenCalledExactlyOnceWith('not-granted', 'the grant has been revoked');
    expect([...refusals.entries()]).toEqual([['grant-revoked', 1]]);
  });
});

describe('a supervisor', () => {
  const supervisor: Access = { ...granted, role: 'supervise', name: 'Sue', grant: { ...grant, id: 'sue' } };

  async function meeting() {
    const all = await setUp();
    const [sue, ada, tab] = [
      all.operator('s', supervisor),
      all.operator('a', granted),
      all.operator('t', granted),
    ];
    const made = [sue.made, ada.made, tab.made];
    all.enforce(made);
    const list = sue.send.mock.calls[0]?.[0] as Operators;
    const [own, ...others] = list.operators.map(({ number }) => number);
    const end = (operator: number, block = false) =>
      all.access.endSession(sue.made, { type: 'endSession', operator, block }, made);
    return { ...all, sue, ada, tab, made, own: own ?? 0, others, end };
  }

  it('ends the session that it names', async () => {
    const { end, others, ada, tab, sue, enforce, made } = await meeting();
    end(others[0] ?? 0);
    expect(ada.close).toHaveBeenCalledExactlyOnceWith('ended-by-supervisor', 'Sue ended the session');
    enforce(made);
    expect([tab.close.mock.calls, sue.close.mock.calls, told(sue.send)]).toEqual([[], [], []]);
  });

  it('blocks the grant, which ends all its sessions until it expires', async () => {
    const { access, end, others, ada, tab, enforce, made, pass } = await meeting();
    end(others[0] ?? 0, true);
    expect(ada.close.mock.calls).toEqual([
      ['ended-by-supervisor', 'Sue ended the session and blocked the grant'],
    ]);
    enforce(made);
    expect(tab.close).toHaveBeenCalledExactlyOnceWith(
      'ended-by-supervisor',
      expect.stringContaining('blocked'),
    );
    expect(access.revocations.refusal(grant)).toBe('grant-blocked');
    expect(access.revocations.refusal({ ...grant, keyId: 'k2' })).toBeNull();
    pass(100);
    expect(access.revocations.refusal(grant)).toBeNull();
  });

  it('is told what is not done: its own session, nobody, too fast', async () => {
    const { end, own, ada, sue, pass } = await meeting();
    end(own);
    for (let i = 0; i < 5; i++) end(1000 + i);
    expect(told(sue.send)).toMatchObject([
      { type: 'fault', reason: 'own-session' },
      ...Array.from({ length: 4 }, () => ({ type: 'fault', reason: 'unknown-operator' })),
      { type: 'fault', reason: 'rate-limited' },
    ]);
    pass(1);
    end(1000);
    expect(told(sue.send).at(-1)).toMatchObject({ reason: 'unknown-operator' });
    expect([ada.close.mock.calls, sue.close.mock.calls]).toEqual([[], []]);
  });
});
