import type { Command, CommandRejection } from '@farpoint/protocol';
import { beforeEach, describe, expect, test } from 'vitest';
import { CommandGate, type CommandVerdict, type GateContext } from './command-gate.ts';
import { defaultDriveLimits } from './limits.ts';
import { commandOf } from './testing/driven-guard.ts';

let gate: CommandGate;
beforeEach(() => {
  gate = new CommandGate(defaultDriveLimits);
});

const open: GateContext = { holdsLease: true, meetEstop: () => 'clear', stands: true };

const command = (change: Partial<Command> = {}, x = 0.5, yaw = -0.25) => commandOf(x, yaw, change);

function reasonOf(verdict: CommandVerdict): CommandRejection | 'accepted' {
  return verdict.accepted ? 'accepted' : verdict.reason;
}

test('accepts a valid command', () => {
  expect(gate.check('a', command(), 0, open)).toEqual({
    accepted: true,
    spentMs: 0,
    unread: false,
    twist: { linear: { x: 0.5, y: 0, z: 0 }, angular: { x: 0, y: 0, z: -0.25 } },
  });
});

test('accepts nothing without the lease, not even zero', () => {
  const verdict = gate.check('a', command({}, 0, 0), 0, { ...open, holdsLease: false });
  expect(reasonOf(verdict)).toBe('not-lease-holder');
});

describe('sequence', () => {
  test.each([
    [5, 5, 'repeated'],
    [5, 4, 'repeated'],
    [5, 6, 'accepted'],
    [0xffffffff, 0, 'accepted'],
    [0, 0xffffffff, 'repeated'],
    [0x80000003, 2, 'accepted'],
  ] as const)('%i, then %i: %s', (first, second, expected) => {
    expect(reasonOf(gate.check('a', command({ sequence: first }), 0, open))).toBe('accepted');
    expect(reasonOf(gate.check('a', command({ sequence: second }), 0, open))).toBe(expected);
  });

  test('after a newer request was refused for its content, an older one is not accepted', () => {
    expect(reasonOf(gate.check('a', command({ sequence: 3, deadMan: false }), 0, open))).toBe(
      'dead-man-released',
    );
    expect(reasonOf(gate.check('a', command({ sequence: 2 }), 0, open))).toBe('repeated');
  });

  test('a stale command does not use up its sequence number', () => {
    gate.check('a', command({ sequence: 1, timeMs: 1000 }), 1000, open);
    expect(reasonOf(gate.check('a', command({ sequence: 9, timeMs: 1000 }), 1200, open))).toBe('stale');
    expect(reasonOf(gate.check('a', command({ sequence: 2, timeMs: 1210 }), 1210, open))).toBe('accepted');
  });

  test('counts each operator separately', () => {
    gate.check('a', command({ sequence: 100 }), 0, open);
    expect(reasonOf(gate.check('b', command({ sequence: 1 }), 0, open))).toBe('accepted');
  });
});

describe('age', () => {
  test('accepts 150 ms of waiting, and no more', () => {
    gate.check('a', command({ sequence: 1, timeMs: 77_000 }), 0, open);
    expect(reasonOf(gate.check('a', command({ sequence: 2, timeMs: 77_010 }), 160, open))).toBe('accepted');
    const late = gate.check('a', command({ sequence: 3, timeMs: 77_020 }), 171, open);
    expect(late).toEqual({ accepted: false, reason: 'stale', detail: '151 ms late, 150 ms allowed' });
  });

  test('after a stall, refuses the old commands of the burst and accepts the fresh ones', () => {
    gate.check('a', command({ sequence: 0, timeMs: 0 }), 30, open);
    const verdicts: string[] = [];
    // Sent every 50 ms from 50 to 500, all delivered at 530.
    for (let i = 1; i <= 10; i++) {
      verdicts.push(reasonOf(gate.check('a', command({ sequence: i, timeMs: i * 50 }), 530, open)));
    }
    expect(verdicts).toEqual([...Array(6).fill('stale'), ...Array(4).fill('accepted')]);
  });

  test('a clock that jumps back locks out its own operator for one window', () => {
    const gate = new CommandGate(defaultDriveLimits, { delayWindowMs: 2000 });
    gate.check('a', command({ sequence: 1, timeMs: 1e9 }), 0, open);
    gate.check('b', command({ sequence: 1, timeMs: 500 }), 0, open);
    const reasons: string[] = [];
    for (let t = 100; t <= 2500; t += 100) {
      const sequence = 1 + t / 100;
      reasons.push(reasonOf(gate.check('a', command({ sequence, timeMs: t }), t, open)));
      expect(reasonOf(gate.check('b', command({ sequence, timeMs: 500 + t }), t, open))).toBe('accepted');
    }
    // Commands count as fresh again from here on; the hand held on all the while.
    expect(reasons.indexOf('let-go-first')).toBe(19);
    expect(reasons.slice(0, 19).every((r) => r === 'stale')).toBe(true);
    expect(reasons.slice(19).every((r) => r === 'let-go-first')).toBe(true);
  });

  test('a clock probe teaches the transit time before the first command', () => {
    gate.observeClock('a', 1000, 1040);
    expect(reasonOf(gate.check('a', command({ timeMs: 1100 }), 1400, open))).toBe('stale');
  });

  test('commands of an operator without the lease also teach the transit time', () => {
    gate.check('a', command({ timeMs: 0 }), 0, { ...open, holdsLease: false });
    expect(reasonOf(gate.check('a', command({ timeMs: 0 }), 200, open))).toBe('stale');
  });

  test('the configured age applies', () => {
    const gate = new CommandGate(defaultDriveLimits, { maxAgeMs: 20 });
    gate.check('a', command({ sequence: 1 }), 0, open);
    expect(reasonOf(gate.check('a', command({ sequence: 2 }), 21, open))).toBe('stale');
  });
});

describe('emergency stop', () => {
  test.each(['latched', 'let-go'] as const)(
    '%s: refuses motion, accepts zero as a sign of life',
    (answer) => {
      const context: GateContext = { ...open, meetEstop: () => answer };
      expect(reasonOf(gate.check('a', command({ sequence: 1 }), 0, context))).toBe('estop-latched');
      expect(reasonOf(gate.check('a', command({ sequence: 2 }, 0, 0), 0, context))).toBe('accepted');
    },
  );

  test('is asked about fresh commands only: a late zero does not count as letting go', () => {
    const asked: boolean[] = [];
    const context: GateContext = {
      ...open,
      meetEstop: (motion) => {
        asked.push(motion);
        return 'clear';
      },
    };
    gate.check('a', command({ sequence: 1 }), 0, context);
    gate.check('a', command({ sequence: 2 }, 0, 0), 1000, context);
    gate.check('a', command({ sequence: 1 }, 0, 0), 0, context);
    expect(asked).toEqual([true]);
  });
});

test('motion needs the grip, standing still does not', () => {
  expect(reasonOf(gate.check('a', command({ sequence: 1, deadMan: false }), 0, open))).toBe(
    'dead-man-released',
  );
  expect(reasonOf(gate.check('a', command({ sequence: 2, deadMan: false }, 0, 0), 0, open))).toBe('accepted');
});

describe('range', () => {
  const still = { x: 0, y: 0, z: 0 };

  test('is stated in words', () => {
    const verdict = gate.check('a', command({}, 3.2), 0, open);
    expect(verdict).toEqual({
      accepted: false,
      reason: 'out-of-range',
      detail: 'twist.linear.x 3.2 m/s is beyond ±1 m/s',
    });
  });

  test.each([
    [{ linear: { ...still, x: -1.01 }, angular: still }],
    [{ linear: still, angular: { ...still, z: 1.51 } }],
    [{ linear: still, angular: { ...still, z: -9 } }],
    [{ linear: { ...still, y: 1e-9 }, angular: still }],
    [{ linear: { ...still, z: 1 }, angular: still }],
    [{ linear: still, angular: { ...still, x: -1 } }],
    [{ linear: still, angular: { ...still, y: 1 } }],
    [{ linear: { ...still, x: Number.NaN }, angular: still }],
    [{ linear: still, angular: { ...still, z: Number.POSITIVE_INFINITY } }],
  ])('%j is refused, not clamped', (twist) => {
    expect(reasonOf(gate.check('a', command({ twist }), 0, open))).toBe('out-of-range');
  });

  test('accepts the limits themselves; cuts off what a float adds to them', () => {
    const gate = new CommandGate({ ...defaultDriveLimits, maxLinear: 0.7 });
    const verdict = gate.check('a', command({}, Math.fround(0.7), -1.5), 0, open);
    expect(verdict).toMatchObject({
      accepted: true,
      twist: { linear: { x: Math.fround(0.7) }, angular: { z: -1.5 } },
    });
    const over = gate.check('a', command({ sequence: 2 }, 0.7 + 5e-7, 0), 0, open);
    expect(over).toMatchObject({ accepted: true, twist: { linear: { x: 0.7 } } });
  });

  test('returns minus zero as zero', () => {
    const verdict = gate.check('a', command({}, -0, -0), 0, open);
    expect(verdict.accepted && Object.is(verdict.twist.linear.x, 0)).toBe(true);
  });
});

describe('rate', () => {
  test('cuts a flood to the limit before it checks anything else', () => {
    const gate = new CommandGate({ ...defaultDriveLimits, maxCommandsPerSecond: 10 });
    const context: GateContext = { ...open, holdsLease: false };
    const reasons: string[] = [];
    for (let i = 0; i < 12; i++) reasons.push(reasonOf(gate.check('a', command(), 0, context)));
    expect(reasons.slice(0, 10).every((r) => r === 'not-lease-holder')).toBe(true);
    expect(reasons.slice(10)).toEqual(['rate-limited', 'rate-limited']);
  });

  test('counts undecodable messages', () => {
    const gate = new CommandGate({ ...defaultDriveLimits, maxCommandsPerSecond: 10 });
    for (let i = 0; i < 10; i++) {
      expect(gate.malformed('a', 'not valid JSON', 0)).toEqual({
        accepted: false,
        reason: 'malformed',
        detail: 'not valid JSON',
      });
    }
    expect(gate.malformed('a', 'not valid JSON', 0).reason).toBe('rate-limited');
    expect(reasonOf(gate.check('a', command(), 0, open))).toBe('rate-limited');
    expect(reasonOf(gate.check('b', command(), 0, open))).toBe('accepted');
  });
});

test('beyond the limit, forgets the operator that was silent for longest', () => {
  gate.check('a', command({ sequence: 5 }), 0, open);
  gate.check('b', command({ sequence: 5 }), 0, open);
  for (let i = 0; i < 62; i++) gate.check(`other-${i}`, command(), 0, open);
  gate.check('a', command({ sequence: 6 }), 0, open);
  gate.check('one more', command(), 0, open);
  expect(reasonOf(gate.check('a', command({ sequence: 6 }), 0, open))).toBe('repeated');
  expect(reasonOf(gate.check('b', command({ sequence: 5 }), 0, open))).toBe('accepted');
});

test('a forgotten operator starts afresh', () => {
  gate.check('a', command({ sequence: 5 }), 0, open);
  gate.forget('a');
  expect(reasonOf(gate.check('a', command({ sequence: 1 }), 0, open))).toBe('accepted');
});

describe('a grip held through silence', () => {
  const at = (ms: number, change: Partial<Command> = {}, x = 0.5) =>
    reasonOf(gate.check('a', command({ sequence: ms + 1, timeMs: ms, ...change }, x, 0), ms, open));

  test('after a second without a command, refuses motion until the hand has let go', () => {
    expect(at(0)).toBe('accepted');
    expect(at(999)).toBe('accepted');
    expect([gate.mustLetGo('a', 1998), gate.mustLetGo('a', 1999)]).toEqual([false, true]);
    expect(at(1999)).toBe('let-go-first');
    expect(at(2020)).toBe('let-go-first');
    expect(at(9000)).toBe('let-go-first');
    expect(at(9020, {}, 0)).toBe('accepted');
    expect(at(9040)).toBe('accepted');
  });

  test('a released grip also counts as letting go', () => {
    expect(at(0)).toBe('accepted');
    expect(at(5000, { deadMan: false })).toBe('dead-man-released');
    expect(at(5020)).toBe('accepted');
  });

  test('a hand that was open before the silence drives at once', () => {
    expect(at(0)).toBe('accepted');
    expect(at(20, { deadMan: false }, 0)).toBe('accepted');
    expect(at(60_000)).toBe('accepted');
  });

  test('a burst of commands that the link held back is no sign of life', () => {
    expect(at(0)).toBe('accepted');
    expect(at(3000, { timeMs: 200 })).toBe('stale');
    expect(at(3001)).toBe('let-go-first');
  });
});

describe('wheels that are away', () => {
  const away = { ...open, wheelsFault: 'nobody listens' };
  const at = (ms: number, x: number, context: GateContext = open) =>
    gate.check('a', command({ sequence: ms + 1, timeMs: ms }, x, 0), ms, context);

  test('motion is refused, and says why; zero passes; a hand that held on must let go before they move again', () => {
    expect(reasonOf(at(0, 0, away))).toBe('accepted');
    expect(at(10, 0.5, away)).toEqual({ accepted: false, reason: 'no-wheels', detail: 'nobody listens' });
    const back = [at(20, 0.5), at(40, 0), at(60, 0.5)];
    expect(back.map(reasonOf)).toEqual(['let-go-first', 'accepted', 'accepted']);
  });

  test('a hand that was moving when they went must let go, even if no command came meanwhile', () => {
    expect(reasonOf(at(0, 0.5))).toBe('accepted');
    gate.requireLetGo('nothing moved');
    expect(reasonOf(at(20, 0.5))).toBe('let-go-first');
  });
});
