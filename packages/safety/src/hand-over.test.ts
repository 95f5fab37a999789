/** The drive goes from hand to hand: what moves the robot, and what does not. */
import { type Command, isZeroTwist, NO_LEASE } from '@farpoint/protocol';
import { expect, test } from 'vitest';
import { MotionSupervisor } from './motion/motion-supervisor.ts';
import { commandOf, makeGuard } from './testing/driven-guard.ts';

const ramps = {
  accelerationMps2: 1,
  decelerationMps2: 2,
  emergencyMps2: 4,
  turnRadps2: 3,
  emergencyTurnRadps2: 6,
};

/** Grace drives at 0.5 m/s, and Ada gets the drive at 2 s. */
function handedOver() {
  const guard = makeGuard();
  const motion = new MotionSupervisor(guard, { ramps });
  const sequences = new Map<string, number>();
  const send = (by: string, nowMs: number, x: number, change: Partial<Command> = {}) => {
    const sequence = (sequences.get(by) ?? 0) + 1;
    sequences.set(by, sequence);
    const lease = guard.leaseState(by).lease ?? NO_LEASE;
    const verdict = guard.onCommand(
      by,
      commandOf(x, 0, { sequence, timeMs: nowMs, lease, ...change }),
      nowMs,
    );
    return verdict.accepted ? 'accepted' : verdict.reason;
  };
  guard.onOpenHand('grace');
  // What Ada's hand has said before counts for nothing.
  guard.onOpenHand('ada');
  guard.requestLease('grace', false, 0);
  for (let nowMs = 0; nowMs < 2000; nowMs += 10) {
    send('grace', nowMs, 0.5);
    motion.velocityAt(nowMs);
  }
  expect(motion.velocityAt(2000).linear.x).toBe(0.5);
  expect(guard.handOver('grace', 'ada', 2000)).toBe(true);
  return { guard, motion, send };
}

test('the robot brakes, and a hand that was on the stick moves nothing', () => {
  const { guard, motion, send } = handedOver();
  let speed = 0.5;
  for (let nowMs = 2010; nowMs < 4000; nowMs += 30) {
    expect(send('grace', nowMs, 0.5)).toBe('not-lease-holder');
    expect(send('ada', nowMs, 0.5)).toBe('let-go-first');
    // Nor does a stick in its middle with the grip held count as open.
    expect(send('ada', nowMs, 0)).toBe('accepted');
    expect(guard.awaitsLetGo).toBe(true);
    const { x } = motion.velocityAt(nowMs).linear;
    expect(x).toBeLessThanOrEqual(speed);
    if (nowMs >= 2270) expect(x).toBe(0);
    speed = x;
  }
  expect(send('ada', 4000, 0, { deadMan: false })).toBe('accepted');
  expect(send('ada', 4010, 0.5)).toBe('accepted');
  motion.velocityAt(4010);
  expect(isZeroTwist(motion.velocityAt(4030))).toBe(false);
});

test('an open grip counts only once the robot stands', () => {
  const { motion, send } = handedOver();
  motion.velocityAt(2010);
  send('ada', 2010, 0, { deadMan: false });
  expect(send('ada', 2020, 0.5)).toBe('let-go-first');
  for (let nowMs = 2020; nowMs < 2300; nowMs += 10) motion.velocityAt(nowMs);
  expect(send('ada', 2300, 0.5)).toBe('let-go-first');
  expect(send('ada', 2310, 0.5, { deadMan: false })).toBe('dead-man-released');
  expect(send('ada', 2320, 0.5)).toBe('accepted');
});

test('whoever does not drive hands nothing over', () => {
  const { guard } = handedOver();
  expect(guard.handOver('grace', 'wim', 2100)).toBe(false);
  expect(guard.leaseHolder).toBe('ada');
});

test('who got the drive and gives it back drives again by the ordinary rule', () => {
  const { guard, motion, send } = handedOver();
  guard.releaseLease('ada');
  for (let nowMs = 2010; nowMs < 2400; nowMs += 10) motion.velocityAt(nowMs);
  expect(send('ada', 2400, 0)).toBe('not-lease-holder');
  guard.requestLease('ada', false, 2410);
  expect(guard.awaitsLetGo).toBe(false);
  expect(send('ada', 2420, 0.5)).toBe('accepted');
});

test('the robot says that the hand must let go', () => {
  const { guard, motion, send } = handedOver();
  expect(guard.mustLetGo(2000)).toBe(true);
  for (let nowMs = 2010; nowMs < 2300; nowMs += 10) motion.velocityAt(nowMs);
  send('ada', 2300, 0, { deadMan: false, unread: true });
  expect(guard.mustLetGo(2300)).toBe(true);
  send('ada', 2310, 0, { deadMan: false });
  expect(guard.mustLetGo(2310)).toBe(false);
});
