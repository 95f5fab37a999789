import { type Role, roles } from '@farpoint/protocol';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { type HeldPlace, judgePlace, mostOfSubject, type PlaceRules } from './place-rules.ts';

const RULES: PlaceRules = { most: 4, perSubject: 2 };
const RANK: Record<Role, number> = { watch: 0, drive: 1, supervise: 2 };
const place = (session: string, change: Partial<HeldPlace> = {}): HeldPlace => ({
  ...{ session, holder: session, role: 'watch', drives: false, quiet: false, activeMs: 0 },
  ...change,
});
const watchers = ['a', 'b', 'c', 'd'].map((each, index) => place(each, { activeMs: 10 - index }));

describe('a place', () => {
  it('is there for a subject until it has its share, though the robot has room', () => {
    const own = (count: number) => Array.from({ length: count }, (_, i) => place(`s${i}`, { holder: 'ada' }));
    const ada = { holder: 'ada', role: 'watch' } as const;
    expect(judgePlace(own(1), null, ada, RULES)).toEqual({ kind: 'free' });
    expect(judgePlace(own(2), null, ada, RULES)).toEqual({ kind: 'refused', why: 'subject-full' });
    const [first, second] = own(2) as [HeldPlace, HeldPlace];
    expect(judgePlace([first, { ...second, quiet: true }], null, ada, RULES)).toEqual({
      ...{ kind: 'instead-of', session: 's1', why: 'replaced' },
    });
  });

  it('is taken from the watcher that has been idle for longest, first from one that is not heard', () => {
    const sue = { holder: 'sue', role: 'supervise' } as const;
    expect(judgePlace(watchers, null, sue, RULES)).toEqual({
      kind: 'instead-of',
      session: 'd',
      why: 'displaced',
    });
    const silent = watchers.map((each) => ({ ...each, quiet: each.session === 'a' }));
    expect(judgePlace(silent, null, sue, RULES)).toMatchObject({ session: 'a' });
    expect(judgePlace(watchers, null, { holder: 'wim', role: 'watch' }, RULES)).toEqual({
      ...{ kind: 'refused', why: 'robot-full' },
    });
  });

  it('is taken from the driver last, and only by a supervisor', () => {
    const driver = place('driver', { role: 'drive', drives: true });
    const [sue, bob] = [
      { holder: 'sue', role: 'supervise' },
      { holder: 'bob', role: 'drive' },
    ] as const;
    const one = { most: 1, perSubject: 1 };
    expect(judgePlace([driver], null, sue, one)).toMatchObject({ session: 'driver' });
    expect(judgePlace([driver], null, bob, one)).toMatchObject({ kind: 'refused' });
    // A role is no licence to drive: the lease may be with somebody whose role is lower.
    expect(judgePlace([place('w', { drives: true })], null, bob, one)).toMatchObject({ kind: 'refused' });
  });

  it('is kept for who drove, but for supervisors', () => {
    const three = watchers.slice(0, 3);
    const asks = (holder: string, role: Role) => judgePlace(three, 'driver', { holder, role }, RULES);
    expect(asks('driver', 'drive')).toEqual({ kind: 'free' });
    expect(asks('wim', 'watch')).toEqual({ kind: 'refused', why: 'robot-full' });
    expect(asks('bob', 'drive')).toMatchObject({ kind: 'instead-of', why: 'displaced' });
    expect(asks('sue', 'supervise')).toEqual({ kind: 'free' });
  });
});

describe('whoever asks, in any order', () => {
  const asker = fc.record({
    ...{ holder: fc.constantFrom('a', 'b', 'c', 'd'), role: fc.constantFrom(...roles) },
    ...{ quiets: fc.boolean(), drives: fc.boolean(), kept: fc.option(fc.constantFrom('a', 'b', 'e')) },
  });
  const rules = fc.record({
    most: fc.integer({ min: 1, max: 6 }),
    perSubject: fc.integer({ min: 1, max: 8 }),
  });

  it('no more are here than may be, none has more than its share, and nobody gives way to an equal', () => {
    fc.assert(
      fc.property(rules, fc.array(asker, { maxLength: 40 }), (limits, askers) => {
        let held: HeldPlace[] = [];
        for (const [index, { holder, role, quiets, drives, kept }] of askers.entries()) {
          const verdict = judgePlace(held, kept, { holder, role }, limits);
          if (verdict.kind === 'refused') {
            // A supervisor is refused only by supervisors, and by itself.
            if (role === 'supervise' && verdict.why === 'robot-full')
              expect(held.every((each) => each.role === 'supervise')).toBe(true);
            continue;
          }
          if (verdict.kind === 'instead-of') {
            const gone = held.find(({ session }) => session === verdict.session);
            if (verdict.why === 'replaced') expect(gone).toMatchObject({ holder, quiet: true });
            else expect(RANK[gone?.role ?? 'supervise']).toBeLessThan(RANK[role]);
            if (gone?.drives && verdict.why === 'displaced') expect(role).toBe('supervise');
            held = held.filter((each) => each !== gone);
          }
          held.push(place(`s${index}`, { holder, role, quiet: quiets, drives, activeMs: index }));
          expect(held.length).toBeLessThanOrEqual(limits.most);
          for (const each of held) {
            const own = held.filter((other) => other.holder === each.holder).length;
            expect(own).toBeLessThanOrEqual(mostOfSubject(limits));
            if (limits.most > 1) expect(own).toBeLessThan(limits.most);
          }
        }
      }),
    );
  });
});
