import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { KnownRevocations, MAX_KNOWN_REVOCATIONS, missingFrom } from './known-revocations.ts';

const exp = fc.integer({ min: 1, max: 100 });
const entries = fc.record({
  seq: fc.integer({ min: 1, max: 9 }),
  grants: fc.array(fc.record({ jti: fc.constantFrom('g1', 'g2', 'g3'), exp }), { maxLength: 5 }),
  subjects: fc.array(
    fc.record({ sub: fc.constantFrom('ada', 'eve'), before: fc.integer({ min: 0, max: 50 }), exp }),
    { maxLength: 5 },
  ),
});
const asked = fc.record({
  id: fc.constantFrom('g1', 'g2', 'g3', 'g4'),
  subject: fc.constantFrom('ada', 'eve', 'bob'),
  issuedAtS: fc.integer({ min: 0, max: 60 }),
});

describe('what a key has revoked', () => {
  it('is what any of its lists says, until that entry ends, in any order and however long it takes', () => {
    fc.assert(
      fc.property(
        fc.array(fc.tuple(entries, fc.integer({ min: 0, max: 20 })), { maxLength: 8 }),
        asked,
        fc.integer({ min: 0, max: 100 }),
        (lists, ask, later) => {
          const known = new KnownRevocations('k1');
          let nowS = 0;
          for (const [list, passS] of lists) {
            known.add(list, nowS);
            nowS += passS;
          }
          nowS += later;
          const truth = lists.some(
            ([{ grants, subjects }]) =>
              grants.some(({ jti, exp }) => jti === ask.id && exp > nowS) ||
              subjects.some(
                ({ sub, before, exp }) => sub === ask.subject && ask.issuedAtS < before && exp > nowS,
              ),
          );
          expect(known.revokes({ ...ask, keyId: 'k1' }, nowS)).toBe(truth);
          expect(known.revokes({ ...ask, keyId: 'k2' }, nowS)).toBe(false);
          // And so it is after it was stored.
          const stored = new KnownRevocations('k1');
          stored.add({ seq: known.sequence, ...known.entries(nowS) }, nowS);
          expect(stored.revokes({ ...ask, keyId: 'k1' }, nowS)).toBe(truth);
        },
      ),
    );
  });

  it('tells what a newer list leaves out, but not what has ended or an older list never had', () => {
    const known = new KnownRevocations('k1');
    const grants = [
      { jti: 'a', exp: 10 },
      { jti: 'b', exp: 20 },
    ];
    expect(known.add({ seq: 2, grants, subjects: [] }, 0)).toEqual({ added: 2, missing: 0, dropped: 0 });
    expect(known.add({ seq: 1, grants: [], subjects: [] }, 0)).toEqual({ added: 0, missing: 0, dropped: 0 });
    const next = { seq: 3, grants: [{ jti: 'c', exp: 30 }], subjects: [] };
    expect(known.add(next, 10)).toEqual({ added: 1, missing: 1, dropped: 0 });
    expect(missingFrom({ grants, subjects: [] }, next, 20)).toBe(0);
  });

  it('has an end: the entries that end first are given up', () => {
    const known = new KnownRevocations('k1');
    const grants = Array.from({ length: MAX_KNOWN_REVOCATIONS + 2 }, (_, i) => ({
      jti: `g${i}`,
      exp: 10 + i,
    }));
    expect(known.add({ seq: 1, grants, subjects: [] }, 0).dropped).toBe(2);
    const revoked = (id: string) => known.revokes({ id, subject: 's', keyId: 'k1', issuedAtS: 0 }, 0);
    expect([revoked('g1'), revoked('g2')]).toEqual([false, true]);
  });
});
