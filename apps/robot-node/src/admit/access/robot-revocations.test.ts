import { readdirSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { type GrantKeys, parseGrantKeys, signRevocations } from '@farpoint/grants';
import { makeIssuer, type TestIssuer } from '@farpoint/grants/testing';
import { silentLogger } from '@farpoint/service';
import { testFolder } from '@farpoint/service/testing/folder';
import fc from 'fast-check';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { ReasonCounts } from '../../ground/robot-counters.ts';
import { MAX_BLOCKED, RevocationJournal, RevocationJournalError } from './revocation-journal.ts';
import { RobotRevocations, SIGNALING } from './robot-revocations.ts';

let folder: string;
let first: TestIssuer;
let second: TestIssuer;
let keys: GrantKeys;
let nowS: number;
let outcomes: ReasonCounts;
beforeEach(async () => {
  folder = testFolder();
  [first, second] = await Promise.all([makeIssuer('k1'), makeIssuer('k2')]);
  keys = await keysOf(first, second);
  nowS = 1000;
  outcomes = new ReasonCounts();
});

const keysOf = (...issuers: TestIssuer[]) =>
  parseGrantKeys(JSON.stringify({ keys: issuers.map(({ publicJwk }) => publicJwk) }));
const list = (by: TestIssuer, seq: number, ...ids: string[]) =>
  signRevocations(
    { iss: 'test', iat: 0, seq, grants: ids.map((jti) => ({ jti, exp: 2000 })), subjects: [] },
    by.signingKey,
  );
const grant = (id: string, keyId = 'k1') => ({ id, keyId, subject: 'ada', issuedAtS: 0 });

/** A robot that starts, or starts again, with what it remembers. */
function start(log = silentLogger()) {
  const journal = new RevocationJournal(folder, 'r1');
  const clocks = { nowS: () => nowS, now: () => nowS * 1000 };
  return new RobotRevocations({ keys: () => keys, journal, outcomes, log, ...clocks });
}
const refused = (robot: RobotRevocations, ...ids: string[]) =>
  ids.filter((id) => robot.refusal(grant(id)) !== null);

describe('lists', () => {
  it('add to what is known: a newer one gives nothing back until it ends, and says so', async () => {
    const log = { ...silentLogger(), warn: vi.fn() };
    const robot = start(log as unknown as ReturnType<typeof silentLogger>);
    await robot.take(await list(first, 5, 'a'), SIGNALING);
    await robot.take(await list(second, 1, 'b'), SIGNALING);
    expect(refused(robot, 'a', 'b', 'c')).toEqual(['a']);
    expect(robot.refusal(grant('b', 'k2'))).toBe('grant-revoked');
    await robot.take(await list(first, 6, 'c'), SIGNALING);
    for (const each of [robot, start()]) expect(refused(each, 'a', 'b', 'c')).toEqual(['a', 'c']);
    expect(log.warn.mock.lastCall?.[0]).toMatchObject({ missing: 1, sequence: 6 });
    await robot.take(await list(first, 7, 'a', 'c', 'd'), SIGNALING);
    expect([...outcomes.entries()]).toEqual([
      ['taken', 3],
      ['taken-shrunk', 1],
    ]);
    expect(log.warn).toHaveBeenCalledOnce();
    nowS = 2000;
    expect(refused(robot, 'a', 'b', 'c', 'd')).toEqual([]);
  });

  it('keep a person’s grants revoked, whatever a newer one says of the person', async () => {
    const robot = start();
    const of = (seq: number, ...subjects: { sub: string; before: number; exp: number }[]) =>
      signRevocations({ iss: 'test', iat: 0, seq, grants: [], subjects }, first.signingKey);
    const issued = (issuedAtS: number) => robot.refusal({ ...grant('x'), issuedAtS });
    await robot.take(await of(1, { sub: 'ada', before: 500, exp: 1500 }), SIGNALING);
    await robot.take(await of(2, { sub: 'ada', before: 300, exp: 2000 }), SIGNALING);
    expect([issued(299), issued(499), issued(500)]).toEqual(['grant-revoked', 'grant-revoked', null]);
    nowS = 1500;
    expect([issued(299), issued(499)]).toEqual(['grant-revoked', null]);
  });

  it('that are older add what only they have: two files of one key may have gone apart', async () => {
    const robot = start();
    await robot.take(await list(first, 6, 'b'), '/etc/own-list');
    await robot.take(await list(first, 5, 'a'), SIGNALING);
    expect(refused(robot, 'a', 'b')).toEqual(['a', 'b']);
    await robot.take(await list(first, 4, 'a'), SIGNALING);
    expect([...outcomes.entries()]).toEqual([
      ['taken', 2],
      ['revocations-older', 1],
    ]);
  });

  it('that are replayed, forged, unknown or no list change nothing', async () => {
    const robot = start();
    const current = await list(first, 5, 'a');
    await robot.take(current, SIGNALING);
    const forger = await makeIssuer('k1');
    for (const bad of [
      await list(first, 4),
      await list(first, 3, 'a'),
      await list(forger, 9, 'b'),
      await list(await makeIssuer('k3'), 9, 'b'),
      'a.b.c',
    ])
      await robot.take(bad, SIGNALING);
    // The same one again, as at every welcome, is not even counted.
    await robot.take(current, SIGNALING);
    expect(refused(robot, 'a', 'b')).toEqual(['a']);
    expect([...outcomes.entries()]).toEqual([
      ['taken', 1],
      ['revocations-older', 2],
      ['revocations-untrusted', 2],
      ['revocations-malformed', 1],
    ]);
  });

  it('in any order and at the same time leave all in force', async () => {
    const made = await Promise.all([1, 2, 3, 4].map((seq) => list(first, seq, `g${seq}`)));
    await fc.assert(
      fc.asyncProperty(fc.shuffledSubarray(made, { minLength: 1 }), async (order) => {
        rmSync(folder, { recursive: true, force: true });
        const robot = start();
        await Promise.all(order.map((each) => robot.take(each, SIGNALING)));
        const all = order.map((each) => `g${made.indexOf(each) + 1}`).sort();
        expect(refused(robot, 'g1', 'g2', 'g3', 'g4')).toEqual(all);
        expect(refused(start(), 'g1', 'g2', 'g3', 'g4')).toEqual(all);
      }),
      { seed: 3, numRuns: 30 },
    );
  });

  it('of a key that is read later count as soon as it is', async () => {
    const third = await makeIssuer('k3');
    const robot = start();
    await robot.take(await list(third, 1, 'a'), SIGNALING);
    expect(robot.refusal(grant('a', 'k3'))).toBeNull();
    keys = await keysOf(first, third);
    await robot.keysChanged();
    expect(robot.refusal(grant('a', 'k3'))).toBe('grant-revoked');
  });

  it('come no faster than they can be verified', async () => {
    const robot = start();
    for (let i = 0; i < 200; i++) await robot.take(`a.b.${i}`, SIGNALING);
    expect(outcomes.get('rate-limited')).toBe(136);
    const [own, sent] = [await list(first, 1, 'a'), await list(second, 1, 'b')];
    await robot.take(sent, SIGNALING);
    await robot.take(own, '/etc/own-list');
    expect([robot.refusal(grant('a')), robot.refusal(grant('b', 'k2'))]).toEqual(['grant-revoked', null]);
    nowS += 1;
    await robot.take(sent, SIGNALING);
    expect(robot.refusal(grant('b', 'k2'))).toBe('grant-revoked');
  });
});

describe('a robot that starts again', () => {
  it('remembers lists and blocked grants, and goes on refusing older lists', async () => {
    const robot = start();
    await robot.take(await list(first, 5, 'a'), SIGNALING);
    expect(robot.block(grant('b'), 1500)).toBe(true);
    expect(refused(start(), 'a', 'b', 'c')).toEqual(['a', 'b']);
    const again = start();
    await again.take(await list(first, 4), SIGNALING);
    expect(refused(again, 'a', 'b', 'c')).toEqual(['a', 'b']);
    nowS = 1500;
    expect(refused(start(), 'a', 'b')).toEqual(['a']);
    expect(readdirSync(folder)).toEqual(['r1.revocations.json']);
  });

  it('reads what an earlier version wrote', async () => {
    const state = { version: 1, lists: [await list(first, 5, 'a')], blocked: [] };
    writeFileSync(join(folder, 'r1.revocations.json'), JSON.stringify(state));
    const robot = start();
    expect(refused(robot, 'a', 'b')).toEqual(['a']);
    await robot.take(await list(first, 4), SIGNALING);
    expect(outcomes.get('revocations-older')).toBe(1);
  });

  it('remembers them while their key is away', async () => {
    await start().take(await list(first, 5, 'a'), SIGNALING);
    keys = await keysOf(second);
    const robot = start();
    await robot.take(await list(second, 1, 'b'), SIGNALING);
    keys = await keysOf(first, second);
    expect(refused(start(), 'a')).toEqual(['a']);
  });

  it.each([
    '',
    '{}',
    '{"version":1,"lists":["a.b.c"],"blocked":[]}',
    '{"version":2,"lists":[],"blocked":[]}',
    '{"version":3,"revoked":[],"blocked":[]}',
    '{"version":2,"revoked":[{"keyId":"k1","sequence":1,"grants":[{"jti":"a"}],"subjects":[]}],"blocked":[]}',
  ])('does not start with %j: it could not tell who was revoked', (text) => {
    writeFileSync(join(folder, 'r1.revocations.json'), text);
    expect(() => start()).toThrow(RevocationJournalError);
  });

  it('says so if it cannot store them, and refuses them all the same', async () => {
    const log = { ...silentLogger(), error: vi.fn() };
    const robot = start(log as unknown as ReturnType<typeof silentLogger>);
    // A file where the folder should be.
    rmSync(folder, { recursive: true });
    writeFileSync(folder, '');
    await robot.take(await list(first, 5, 'a'), SIGNALING);
    expect(log.error).toHaveBeenCalledOnce();
    expect(refused(robot, 'a')).toEqual(['a']);
  });
});

it('blocks as many grants as it can remember, and room returns as they end', () => {
  const robot = start();
  const journal = vi.spyOn(RevocationJournal.prototype, 'write').mockImplementation(() => undefined);
  try {
    for (let i = 0; i < MAX_BLOCKED; i++) expect(robot.block(grant(`g${i}`), 1100)).toBe(true);
    expect(robot.block(grant('more'), 1100)).toBe(false);
    nowS = 1100;
    expect(robot.block(grant('more'), 1200)).toBe(true);
    expect(refused(robot, 'g1', 'more')).toEqual(['more']);
  } finally {
    journal.mockRestore();
  }
});
