import type { HandoverEnd } from '@farpoint/protocol';
import { expect, it } from 'vitest';
import { type DriveFacts, Handovers } from './handovers.ts';

/** Ada drives; Bob may, Wim watches. */
function robot() {
  let facts: DriveFacts = { driver: 'ada', lease: 'l1', latched: false, latch: 0 };
  let leases = 1;
  const may = new Map([
    ['ada', true],
    ['bob', true],
    ['cy', true],
    ['wim', false],
  ]);
  const told: (readonly [from: string, end: HandoverEnd | null])[] = [];
  const give = (driver: string | null) => {
    facts = { ...facts, driver, lease: driver === null ? null : `l${++leases}` };
  };
  const handovers = new Handovers({
    facts: () => facts,
    mayDrive: (session) => may.get(session) ?? null,
    handOver: (from, to) => {
      if (facts.driver !== from) return false;
      give(to);
      return true;
    },
    changed: ({ from }, end) => told.push([from, end]),
  });
  const latch = (latched: boolean) => {
    facts = { ...facts, latched, latch: (facts.latch ?? 0) + (latched ? 1 : 0) };
  };
  const taken = () => told.splice(0);
  return { handovers, may, give, latch, taken, driver: () => facts.driver };
}

const idOf = ({ open }: Handovers) => open.at(-1)?.id ?? -1;

it('moves the drive to who accepts an offer, and to who asked once the driver gives it', () => {
  const { handovers, taken, driver } = robot();
  expect(handovers.offer('ada', 'bob', 0)).toBeNull();
  expect(handovers.answer('bob', idOf(handovers), true, 100)).toBeNull();
  expect([driver(), taken()]).toEqual([
    'bob',
    [
      ['ada', null],
      ['ada', 'accepted'],
    ],
  ]);
  expect(handovers.ask('ada', 200)).toBeNull();
  expect(handovers.answer('bob', idOf(handovers), true, 300)).toBeNull();
  expect([driver(), handovers.open]).toEqual(['ada', []]);
});

it('lets nobody answer but the one who was asked, and nobody twice', () => {
  const { handovers, driver } = robot();
  handovers.offer('ada', 'bob', 0);
  const id = idOf(handovers);
  for (const by of ['ada', 'cy', 'wim', 'nobody']) expect(handovers.answer(by, id, true, 1)).toBe('not-open');
  expect(handovers.withdraw('bob', id, 1)).toBe('not-open');
  expect(handovers.answer('bob', id + 1, true, 1)).toBe('not-open');
  expect(handovers.answer('bob', id, true, 2)).toBeNull();
  expect(handovers.answer('bob', id, true, 3)).toBe('not-open');
  expect(driver()).toBe('bob');
});

it('asks only for what can be given, and only of who can give it', () => {
  const { handovers, give, latch } = robot();
  expect(handovers.ask('wim', 0)).toBe('not-permitted');
  expect(handovers.ask('stranger', 0)).toBe('not-permitted');
  expect(handovers.ask('ada', 0)).toBe('own-session');
  expect(handovers.offer('ada', 'ada', 0)).toBe('own-session');
  expect(handovers.offer('bob', 'cy', 0)).toBe('not-driver');
  expect(handovers.offer('ada', 'wim', 0)).toBe('only-watches');
  expect(handovers.offer('ada', 'stranger', 0)).toBe('unknown-operator');
  expect(handovers.offer('ada', 'bob', 0)).toBeNull();
  expect(handovers.offer('ada', 'cy', 0)).toBe('already-open');
  latch(true);
  expect(handovers.offer('ada', 'bob', 1)).toBe('estop');
  expect(handovers.ask('bob', 1)).toBe('estop');
  give(null);
  expect(handovers.ask('bob', 1)).toBe('nobody-drives');
});

it.each<[string, HandoverEnd, (of: ReturnType<typeof robot>) => unknown]>([
  ['when its time is over', 'expired', ({ handovers }) => handovers.endDue(15_000)],
  ['when the one to whom it was offered leaves', 'left', ({ may }) => may.delete('bob')],
  ['when the driver leaves', 'left', ({ may }) => may.delete('ada')],
  ['when the driver lets the lease go', 'driver-changed', ({ give }) => give(null)],
  ['when another takes over', 'driver-changed', ({ give }) => give('cy')],
  ['when the driver loses the lease and gets it back', 'driver-changed', ({ give }) => give('ada')],
  ['when STOP is pressed', 'estop', ({ latch }) => latch(true)],
  [
    'when STOP is pressed and released again',
    'estop',
    ({ latch }) => {
      latch(true);
      latch(false);
    },
  ],
])('ends %s', (_, end, happens) => {
  const all = robot();
  all.handovers.offer('ada', 'bob', 0);
  const id = idOf(all.handovers);
  all.handovers.endDue(14_999);
  all.taken();
  happens(all);
  const driver = all.driver();
  expect(all.handovers.answer('bob', id, true, 14_999)).toBe('not-open');
  expect([all.taken(), all.driver()]).toEqual([[['ada', end]], driver]);
});

it('what was asked of the driver before ends when the drive changes hands', () => {
  const { handovers, taken } = robot();
  handovers.ask('bob', 0);
  const id = idOf(handovers);
  handovers.ask('cy', 0);
  taken();
  handovers.answer('ada', id, true, 1);
  expect(taken()).toEqual([
    ['bob', 'accepted'],
    ['cy', 'driver-changed'],
  ]);
});

it('whoever was refused waits before it asks again, and only that one', () => {
  const { handovers } = robot();
  handovers.ask('bob', 0);
  handovers.answer('ada', idOf(handovers), false, 100);
  expect(handovers.ask('bob', 10_099)).toBe('rate-limited');
  expect(handovers.ask('cy', 10_099)).toBeNull();
  expect(handovers.ask('bob', 10_100)).toBeNull();
  expect(handovers.withdraw('bob', idOf(handovers), 10_101)).toBeNull();
  expect(handovers.ask('bob', 10_102)).toBeNull();
});
