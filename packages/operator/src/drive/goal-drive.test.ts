import type { GoalCancel, GoalHold, GoalRequest, OperatorSessionMessage } from '@farpoint/protocol';
import { describe, expect, test } from 'vitest';
import { Driver } from './driver.ts';
import { GoalDrive, type GoalStatus } from './goal-drive.ts';
import { WishInput } from './wish-input.ts';

const PLACE = { x: 3, y: -1 };

function bench(offer: { mostM: number } | null = { mostM: 20 }) {
  const sent: (GoalRequest | GoalCancel)[] = [];
  const asked: OperatorSessionMessage[] = [];
  const holds: GoalHold[] = [];
  const changes: (GoalStatus | null)[] = [];
  const hand = new WishInput();
  const sequences: number[] = [];
  const driver = new Driver([hand], {
    sendCommand: ({ sequence }) => sequences.push(sequence),
    sendSession: (message) => asked.push(message),
    onOtherDrives: () => undefined,
  });
  driver.onLimits({ maxLinear: 1, maxAngular: 1, watchdogMs: 150, maxCommandsPerSecond: 100 });
  const goals = new GoalDrive(driver, {
    sendSession: (message) => sent.push(message),
    sendHold: (hold) => {
      holds.push(hold);
      sequences.push(hold.sequence);
    },
    onChange: (status) => changes.push(status),
  });
  goals.onOffer(offer);
  const lease = () => driver.onLease({ type: 'lease', holder: 'you', lease: 'x' });
  let nowMs = 0;
  const run = (ms: number) => {
    for (const end = nowMs + ms; nowMs < end; ) {
      nowMs += 25;
      driver.tick(nowMs);
      goals.tick(nowMs);
    }
  };
  const go = () => goals.go(PLACE, nowMs);
  return { sent, asked, holds, changes, sequences, hand, driver, goals, lease, run, go };
}

describe('a goal', () => {
  test('asks for the lease, is sent with it, and held at the commands’ rate', () => {
    const { sent, asked, holds, lease, run, go, goals } = bench();
    expect(go()).toBe(true);
    expect(asked).toEqual([{ type: 'leaseRequest', take: false }]);
    run(100);
    expect([sent, holds]).toEqual([[], []]);
    lease();
    run(1000);
    expect(sent).toEqual([{ type: 'goal', id: 1, timeMs: 0, lease: 'x', ...PLACE }]);
    expect(holds).toHaveLength(40);
    expect(holds.every(({ goal, lease }) => goal === 1 && lease === 'x')).toBe(true);
    goals.onState({ type: 'goalState', id: 1, state: 'driving' });
    goals.onState({ type: 'goalState', id: 1, state: 'reached' });
    run(200);
    expect(holds).toHaveLength(40);
    expect(goals.status).toEqual({ place: PLACE, state: 'reached', reason: null });
  });

  test('is not held any more once the robot has ended it', () => {
    const { holds, lease, run, go, goals } = bench();
    lease();
    go();
    run(50);
    goals.onState({ type: 'goalState', id: 1, state: 'blocked', reason: 'obstacle' });
    const before = holds.length;
    run(500);
    expect(holds).toHaveLength(before);
    // And another goal is another one.
    go();
    goals.onState({ type: 'goalState', id: 1, state: 'cancelled', reason: 'replaced' });
    expect(goals.active).toBe(true);
    run(50);
    expect(holds.at(-1)?.goal).toBe(2);
  });

  test('shares its sequence with the commands', () => {
    const { hand, lease, run, go, sequences } = bench();
    lease();
    go();
    run(100);
    hand.held = true;
    run(100);
    hand.held = false;
    run(300);
    go();
    run(100);
    expect(sequences).toEqual(sequences.map((_, i) => (sequences[0] ?? 0) + i));
  });

  test.each([
    [
      'the driver’s hand',
      'stick',
      (all: ReturnType<typeof bench>) => Object.assign(all.hand, { held: true }),
    ],
    [
      'a hidden page',
      'hidden',
      (all: ReturnType<typeof bench>) => Object.assign(all.driver, { suspended: true }),
    ],
    [
      'a takeover',
      'lease-lost',
      ({ driver }: ReturnType<typeof bench>) => driver.onLease({ type: 'lease', holder: 'other' }),
    ],
    [
      'a lease that is given back',
      'lease-lost',
      ({ driver }: ReturnType<typeof bench>) => driver.onLease({ type: 'lease', holder: 'nobody' }),
    ],
    ['Escape', 'asked', ({ goals }: ReturnType<typeof bench>) => goals.cancel()],
  ] as const)('%s ends it for good', (_, reason, act) => {
    const all = bench();
    all.lease();
    all.go();
    all.run(100);
    const before = all.holds.length;
    act(all);
    all.run(50);
    expect(all.goals.status).toEqual({ place: PLACE, state: 'cancelled', reason });
    expect(all.sent.at(-1)).toEqual({ type: 'goalCancel', id: 1 });
    all.hand.held = false;
    all.driver.suspended = false;
    all.lease();
    all.run(500);
    expect(all.holds).toHaveLength(before);
  });

  test('ends for a hand whose grip does not count', () => {
    const { driver, hand, lease, run, go, goals } = bench();
    lease();
    hand.held = true;
    run(50);
    driver.onPath(50);
    hand.held = false;
    go();
    run(50);
    // The page hung for a moment: no device was read.
    hand.held = true;
    driver.onPath(100);
    run(25);
    expect(driver.stream.held).toBe(false);
    expect(goals.status?.reason).toBe('stick');
  });

  test('is given up without an answer, and when the session ends', () => {
    const { lease, run, go, goals } = bench();
    go();
    run(3100);
    expect(goals.status?.reason).toBe('no-answer');
    lease();
    go();
    goals.reset();
    expect(goals.status?.reason).toBe('link-lost');
    expect(go()).toBe(false);
  });

  test('is none where the robot takes none, somebody else drives, or the hand does', () => {
    expect(bench(null).go()).toBe(false);
    const others = bench();
    others.driver.onLease({ type: 'lease', holder: 'other' });
    expect(others.go()).toBe(false);
    expect(others.goals.status?.reason).toBe('other-drives');
    const busy = bench();
    busy.lease();
    busy.hand.held = true;
    busy.run(25);
    expect(busy.go()).toBe(false);
    expect(busy.sent).toEqual([]);
  });
});
