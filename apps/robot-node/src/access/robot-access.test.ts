import { makeProof, parseGrantKeys } from '@farpoint/grants';
import { grantTo, makeIssuer } from '@farpoint/grants/testing';
import { silentLogger } from '@farpoint/service';
import { expect, it, vi } from 'vitest';
import { ReasonCounts } from '../telemetry/robot-counters.ts';
import type { Access } from './access.ts';
import { openAccess } from './access.ts';
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
    ...{ file, robot: 'r1', refusals, nowS: () => nowS, now: () => nowMs },
    log: log as unknown as ReturnType<typeof silentLogger>,
  });
  const operator = (id: string, given: Access = openAccess('Ada')) => {
    const [send, close] = [vi.fn(), vi.fn()];
    const messages: GuardedOperator['messages'] = { id, access: given, operatorName: 'Ada', send };
    const made: GuardedOperator = { messages, peer: { connected: true, close } };
    return { made, send, close };
  };
  const pass = (s: number) => {
    nowS += s;
    nowMs += s * 1000;
  };
  return { access, operator, pass, log, refusals, file, issuer: first };
}

const granted: Access = {
  role: 'drive',
  subject: 'a',
  grantId: 'g',
  name: 'Ada',
  expiresAtS: 1100,
  keyId: 'k1',
};

it('warns once, a minute before the end, and ends the session at the end', async () => {
  const { access, operator, pass } = await setUp();
  const { made, send, close } = operator('s', granted);
  pass(39);
  access.tick([made]);
  expect(send).not.toHaveBeenCalled();
  pass(1.5);
  access.tick([made]);
  access.tick([made]);
  expect(send.mock.calls).toEqual([[{ type: 'expires', inS: 59 }]]);
  pass(59);
  access.tick([made]);
  expect(close).not.toHaveBeenCalled();
  pass(0.5);
  access.tick([made]);
  expect(close).toHaveBeenCalledExactlyOnceWith('grant-expired', 'the grant has expired');
});

it('an operator that has not been admitted may do nothing, and neither is warned nor ended', async () => {
  const { access, operator, pass } = await setUp();
  const { made, send, close } = operator('s');
  access.offered(made, 'v=0');
  expect(made.messages.access).toMatchObject({ role: 'watch', name: 'Ada', keyId: null });
  pass(1e6);
  access.tick([made]);
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
  const { access, operator, file, issuer, refusals } = await setUp();
  const fingerprint = Array.from({ length: 32 }, () => 'AB').join(':');
  const sdp = `v=0\r\na=fingerprint:sha-256 ${fingerprint}\r\n`;
  const { grant, key } = await grantTo(issuer, 1000, { role: 'supervise' });
  const ask = async (session: string) => {
    const { made } = operator(session);
    access.offered(made, sdp);
    const fingerprints = { operatorFingerprint: fingerprint, robotFingerprint: fingerprint };
    const proof = await makeProof(grant, { robot: 'r1', session, ...fingerprints }, key, 1000);
    return { made, answer: { session, sdp, grant, proof } };
  };
  const first = await ask('s1');
  expect(await access.admits(first.made, first.answer)).toBe(true);
  expect(first.made.messages.access).toMatchObject({ role: 'supervise', subject: 'ada', keyId: 'k1' });
  // An answer to a later offer, of an ICE restart.
  expect(await access.admits(first.made, { session: 's1', sdp: 'v=0' })).toBe(true);
  const second = await ask('s2');
  const pending = access.admits(second.made, second.answer);
  file.keys = new Map();
  expect(await pending).toBe(false);
  expect([second.made.messages.access.role, refusals.get('grant-untrusted')]).toEqual(['watch', 1]);
});
