import { longProperty } from '@farpoint/network-sim/cases';
import { type Command, isZeroTwist, type Twist } from '@farpoint/protocol';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { DriveGuard } from './drive-guard.ts';
import { defaultDriveLimits } from './limits.ts';

const operators = ['a', 'b', 'c'] as const;
const operator = fc.constantFrom(...operators);
const speed = fc.oneof(
  fc.constantFrom(0, 0, 0.3, -0.3, 1, -1, 1.0000001, 1.5, 1e9, Number.NaN, Number.POSITIVE_INFINITY),
  fc.double({ min: -2, max: 2, noNaN: true }),
);
const mostly = (usual: number, others: fc.Arbitrary<number>) =>
  fc.oneof({ weight: 6, arbitrary: fc.constant(usual) }, { weight: 1, arbitrary: others });

const step = fc.oneof(
  {
    weight: 16,
    arbitrary: fc.record({
      kind: fc.constant('command' as const),
      by: operator,
      lease: fc.constantFrom('own', 'own', 'own', 'holders', 'guess'),
      sequenceStep: mostly(1, fc.constantFrom(0, -1, 7, 2 ** 31, -(2 ** 31) + 1)),
      lateMs: mostly(0, fc.integer({ min: -500, max: 500 })),
      deadMan: fc.constantFrom(true, true, true, false),
      x: speed,
      y: mostly(0, speed),
      yaw: speed,
    }),
  },
  {
    weight: 5,
    arbitrary: fc.record({ kind: fc.constant('request' as const), by: operator, take: fc.boolean() }),
  },
  {
    weight: 1,
    arbitrary: fc.record({ kind: fc.constantFrom('release', 'gone', 'malformed'), by: operator }),
  },
  {
    weight: 1,
    arbitrary: fc.record({ kind: fc.constant('latch' as const), by: fc.constantFrom('operator', 'robot') }),
  },
  { weight: 2, arbitrary: fc.record({ kind: fc.constant('unlatch' as const), by: operator }) },
  { weight: 10, arbitrary: fc.record({ kind: fc.constant('open' as const), by: operator }) },
  {
    weight: 1,
    arbitrary: fc.record({ kind: fc.constant('handOver' as const), by: operator, to: operator }),
  },
);
const timedStep = fc.record({
  waitMs: fc.constantFrom(0, 1, 5, 10, 20, 20, 20, 50, 149, 150, 151, 1000, 6000, 20_000),
  step,
});

describe.each([
  ['after a gap of a second', undefined],
  ['after any gap that stopped the robot', defaultDriveLimits.watchdogMs],
])('a hand must let go %s', (_, letGoAfterMs) => {
  test('whatever is sent: moves only within limits, for fresh commands of a holder who let go, never while stopped', () => {
    checkAnything(letGoAfterMs);
  });
});

function checkAnything(letGoAfterMs: number | undefined): void {
  let moved = 0;
  let checked = 0;
  let letGo = 0;
  let handedOver = 0;
  fc.assert(
    fc.property(fc.array(timedStep, { minLength: 1, maxLength: 80, size: 'max' }), (steps) => {
      let handles = 0;
      const guard = new DriveGuard({
        limits: defaultDriveLimits,
        randomBytes: (count) => new Uint8Array(count).fill(++handles),
        ...(letGoAfterMs === undefined ? {} : { letGoAfterMs }),
      });
      // What the robot's owner would write down, from the answers alone.
      let nowMs = 0;
      let holder: string | null = null;
      let latched = false;
      let last: { by: string; atMs: number; twist: Twist } | null = null;
      const leases = new Map<string, string>();
      const sequences = new Map<string, number>();
      /** When a hand that has not let go since was last obeyed. */
      const held = new Map<string, number>();
      /** Whose hand said last that it is open. */
      const open = new Set<string>();
      /** Who has been seen with an open hand since it drives, or when it began to; and since the emergency stop was released. */
      const mayMove = new Set<string>();
      /** Who got the drive from another's hand and has not shown an open grip since. */
      const mustOpen = new Set<string>();

      const check = (atMs: number) => {
        checked++;
        const velocity = guard.velocityAt(atMs);
        expect(Math.abs(velocity.linear.x)).toBeLessThanOrEqual(1);
        expect(Math.abs(velocity.angular.z)).toBeLessThanOrEqual(1.5);
        expect([velocity.linear.y, velocity.linear.z, velocity.angular.x, velocity.angular.y]).toEqual([
          0, 0, 0, 0,
        ]);
        expect(guard.limits).toEqual(defaultDriveLimits);
        if (isZeroTwist(velocity)) return;
        moved++;
        expect(latched).toBe(false);
        expect(last?.by).toBe(holder);
        expect(atMs - (last?.atMs ?? 0)).toBeLessThan(150);
        expect(velocity).toEqual(last?.twist);
        expect(guard.nextDeadlineMs).toBe((last?.atMs ?? 0) + 150);
      };

      for (const { waitMs, step } of steps) {
        check(nowMs + waitMs);
        nowMs += waitMs;
        const { by } = step;
        if (step.kind === 'command') {
          const sequence = ((sequences.get(by) ?? 0) + step.sequenceStep) >>> 0;
          sequences.set(by, sequence);
          const lease = { own: leases.get(by), holders: leases.get(holder ?? ''), guess: 'guess' }[
            step.lease
          ];
          const command: Command = {
            type: 'command',
            sequence,
            timeMs: nowMs - step.lateMs,
            lease: lease ?? 'none',
            deadMan: step.deadMan,
            twist: { linear: { x: step.x, y: step.y, z: 0 }, angular: { x: 0, y: 0, z: step.yaw } },
          };
          const verdict = guard.onCommand(by, command, nowMs);
          const isNeutral = isZeroTwist(command.twist) || !step.deadMan;
          const unheard = ['rate-limited', 'repeated', 'stale'];
          const isHeard = verdict.accepted || !unheard.includes(verdict.reason);
          const drives = isHeard && (verdict.accepted || verdict.reason !== 'not-lease-holder');
          if (drives && isNeutral) mayMove.add(by);
          if (drives && !step.deadMan) mustOpen.delete(by);
          if (drives) open.delete(by);
          // Of those who do not drive, too.
          if (isHeard && isNeutral) open.add(by);
          if (verdict.accepted) {
            expect(by).toBe(holder);
            expect(step.y).toBe(0);
            expect(Math.abs(step.x)).toBeLessThan(1.001);
            if (isZeroTwist(command.twist)) held.delete(by);
            else {
              expect(step.deadMan && !latched).toBe(true);
              expect(mayMove.has(by)).toBe(true);
              expect(mustOpen.has(by)).toBe(false);
              expect(nowMs - (held.get(by) ?? nowMs)).toBeLessThan(letGoAfterMs ?? 1000);
              held.set(by, nowMs - verdict.spentMs);
            }
            last = { by, atMs: nowMs - verdict.spentMs, twist: verdict.twist };
          } else {
            expect(verdict.detail).not.toBe('');
            if (verdict.reason === 'dead-man-released') last = null;
            // These do not express the operator's present request.
            const passedOver = ['malformed', 'rate-limited', 'not-lease-holder', 'repeated', 'stale'];
            if (!step.deadMan && !passedOver.includes(verdict.reason)) held.delete(by);
            if (verdict.reason === 'let-go-first') letGo++;
          }
        } else if (step.kind === 'request') {
          const outcome = guard.requestLease(by, step.take, nowMs);
          if (outcome.granted) {
            if (holder !== by) last = null;
            if (holder !== by && !open.has(by)) mayMove.delete(by);
            if (holder !== by && open.has(by)) mayMove.add(by);
            if (holder !== by) mustOpen.delete(by);
            holder = by;
            leases.set(by, outcome.lease);
          } else open.delete(by);
        } else if (step.kind === 'release' || step.kind === 'gone') {
          const free = step.kind === 'release' ? guard.releaseLease(by) : guard.operatorGone(by);
          expect(free).toBe(holder === by);
          if (free) holder = null;
          if (free) last = null;
          if (step.kind === 'gone') {
            held.delete(by);
            open.delete(by);
            mustOpen.delete(by);
          }
        } else if (step.kind === 'open') {
          guard.onOpenHand(by);
          held.delete(by);
          open.add(by);
          if (holder === by) mayMove.add(by);
        } else if (step.kind === 'latch') {
          guard.latchEstop(by === 'robot' ? 'robot' : 'operator');
          latched = true;
          last = null;
        } else if (step.kind === 'unlatch') {
          const outcome = guard.releaseEstop(by);
          expect(outcome.released).toBe(latched && holder === by);
          if (outcome.released) {
            latched = false;
            mayMove.delete(by);
          }
        } else if (step.kind === 'handOver') {
          const { to } = step;
          const isDriver = holder === by && to !== by;
          expect(guard.handOver(by, to, nowMs)).toBe(isDriver);
          if (isDriver) {
            handedOver++;
            holder = to;
            last = null;
            mustOpen.add(to);
            // Whatever it has said before.
            mayMove.add(to);
            leases.set(to, guard.leaseState(to).lease ?? '');
          }
        } else {
          guard.onMalformed(by, 'not valid JSON', nowMs);
        }
        expect(guard.leaseHolder).toBe(holder);
        check(nowMs);
      }
      check(nowMs + 149.9);
      check(nowMs + 150);
    }),
    longProperty(20_240, 400),
  );
  // Without this check, the property would hold for a robot that never moves.
  expect(moved / checked).toBeGreaterThan(0.015);
  expect(letGo).toBeGreaterThan(0);
  expect(handedOver).toBeGreaterThan(0);
}
