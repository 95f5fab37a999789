import type { ReferenceBridgeToPage } from '@farpoint/protocol';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { PageAnnouncer, type ShownRobots } from './page-announcer.ts';

const first = { id: 0, name: 'first' };
const second = { id: 1, name: 'second' };

describe('PageAnnouncer', () => {
  it('lists a robot before saying that it is shown', () => {
    const announcer = new PageAnnouncer();
    expect(announcer.changes({ robots: [first], selected: 0 })).toEqual([
      { type: 'updateRobots', robots: [first] },
      { type: 'switchedRobot', robotId: 0 },
    ]);
    expect(announcer.changes({ robots: [first], selected: 0 })).toEqual([]);
    expect(announcer.changes({ robots: [first, second], selected: 0 })).toEqual([
      { type: 'updateRobots', robots: [first, second] },
    ]);
    expect(announcer.changes({ robots: [first, second], selected: 1 })).toEqual([
      { type: 'switchedRobot', robotId: 1 },
    ]);
    expect(announcer.changes({ robots: [], selected: null })).toEqual([
      { type: 'updateRobots', robots: null },
    ]);
  });

  it('tells a new page everything, and no switched robot if there is none', () => {
    const announcer = new PageAnnouncer();
    expect(announcer.present({ robots: [], selected: null })).toEqual([
      { type: 'updateRobots', robots: null },
    ]);
    expect(announcer.present({ robots: [first, second], selected: 1 })).toEqual([
      { type: 'updateRobots', robots: [first, second] },
      { type: 'switchedRobot', robotId: 1 },
    ]);
  });

  it('never switches to a robot that is missing from the last list', () => {
    const state = fc.record({
      robots: fc.uniqueArray(fc.record({ id: fc.nat(4), name: fc.constantFrom('a', 'b') }), {
        selector: ({ id }) => id,
      }),
      selected: fc.option(fc.nat(4)),
    });
    fc.assert(
      fc.property(fc.array(state), (states) => {
        const announcer = new PageAnnouncer();
        let listed: ReadonlySet<number> = new Set();
        const check = (messages: readonly ReferenceBridgeToPage[]) => {
          for (const message of messages) {
            if (message.type === 'updateRobots') listed = new Set(message.robots?.map(({ id }) => id));
            else expect(listed.has(message.robotId)).toBe(true);
          }
        };
        for (const now of states as ShownRobots[]) {
          check(announcer.changes(now));
          expect([...listed].sort()).toEqual(now.robots.map(({ id }) => id).sort());
          check(announcer.present(now));
        }
      }),
    );
  });
});
