import { type Twist, zeroTwist } from '@farpoint/protocol';
import { DriveGuard } from '@farpoint/safety';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { ReferenceDriver } from './reference-driver.ts';

const limits = { maxLinear: 1, maxAngular: 1.5, watchdogMs: 150, maxCommandsPerSecond: 100 };

function setUp(mayHold = true) {
  const guard = new DriveGuard({ limits, randomBytes: (count) => new Uint8Array(count).fill(7) });
  const driver = new ReferenceDriver('reference:1', guard, () => mayHold);
  return {
    ...{ guard, driver },
    /** As often as the robot does. @returns whether the lease was released */
    wait(fromMs: number, toMs: number, pathLives: boolean): boolean {
      let released = false;
      for (let t = fromMs; t <= toMs; t += 20) released = driver.checkQuiet(t, pathLives) || released;
      return released;
    },
  };
}

function forward(x: number, z = 0): Twist {
  return { ...zeroTwist(), linear: { x, y: 0, z } };
}

describe('ReferenceDriver', () => {
  it('takes a free lease at the first request for motion, and releases it after 2 s without one', () => {
    const { guard, driver } = setUp();
    expect(driver.onTwist(zeroTwist(), 0)).toBe('ignored');
    expect(guard.leaseHolder).toBeNull();
    expect(driver.onTwist(forward(0.5), 20)).toMatchObject({ accepted: true });
    expect(guard.velocityAt(20).linear.x).toBe(0.5);
    expect(driver.checkQuiet(2019, true)).toBe(false);
    expect(driver.checkQuiet(2020, true)).toBe(true);
    expect(guard.leaseHolder).toBeNull();
  });

  it('is refused while another drives, beyond the limits, and while the emergency stop is latched', () => {
    const { guard, driver } = setUp();
    guard.requestLease('operator', false, 0);
    driver.onTwist(zeroTwist(), 0);
    expect(driver.onTwist(forward(0.5), 10)).toMatchObject({ accepted: false, reason: 'not-lease-holder' });
    guard.releaseLease('operator');
    // It held on while the other one drove.
    expect(driver.onTwist(forward(0.5), 20)).toMatchObject({ accepted: false, reason: 'let-go-first' });
    driver.onTwist(zeroTwist(), 30);
    expect(driver.onTwist(forward(2), 35)).toMatchObject({ accepted: false, reason: 'out-of-range' });
    guard.latchEstop('operator');
    expect(driver.onTwist(forward(0.5), 40)).toMatchObject({ accepted: false, reason: 'estop-latched' });
    expect(guard.velocityAt(40)).toEqual(zeroTwist());
  });

  it('requests a green frame through linear.z, without motion or lease, but not while another drives', () => {
    const { guard, driver } = setUp();
    expect(driver.onTwist(forward(0.5, 1), 0)).toBe('latency-test');
    expect(guard.leaseHolder).toBeNull();
    for (let i = 0; i < 9; i++) expect(driver.onTwist(forward(0, 1), 1)).toBe('latency-test');
    expect(driver.onTwist(forward(0, 1), 1)).toBe('too-many-tests');
    guard.requestLease('operator', false, 0);
    expect(driver.onTwist(forward(0, 1), 1000)).toBe('too-many-tests');
  });

  it('treats a burst after a stall as a stop, and obeys commands sent after it', () => {
    const { guard, driver } = setUp();
    for (let t = 0; t <= 100; t += 20) driver.onTwist(t === 0 ? zeroTwist() : forward(0.5), t);
    expect(guard.velocityAt(300)).toEqual(zeroTwist());
    // 15 commands from the last 300 ms, all at once.
    for (let i = 0; i < 15; i++) driver.onTwist(forward(0.5), 400 + i * 0.1);
    expect(driver.bursts).toBe(14);
    expect(guard.velocityAt(402)).toEqual(zeroTwist());
    driver.onTwist(forward(0.5), 420);
    expect(guard.velocityAt(420).linear.x).toBe(0.5);
    // Messages that a busy moment brought together are not a stall.
    for (const t of [440, 440.5, 460])
      expect(driver.onTwist(forward(0.5), t)).toMatchObject({ accepted: true });
  });

  it('obeys no hand that it does not know to be open: a zero, or 2 s without a request on a live path', () => {
    const refused = { accepted: false, reason: 'let-go-first' };
    const { driver, wait } = setUp();
    // A stick that is held when the session begins.
    expect(driver.onTwist(forward(0.5), 0)).toMatchObject(refused);
    driver.onTwist(zeroTwist(), 20);
    expect(driver.onTwist(forward(0.5), 40)).toMatchObject({ accepted: true });
    // One that is held through a silence.
    expect(driver.onTwist(forward(0.5), 1500)).toMatchObject(refused);
    driver.onTwist(zeroTwist(), 1520);
    expect(driver.onTwist(forward(0.5), 1540)).toMatchObject({ accepted: true });
    // No zero was sent, but everything else kept arriving.
    expect(wait(1560, 4000, true)).toBe(true);
    expect(driver.onTwist(forward(0.5), 4020)).toMatchObject({ accepted: true });
    // The path was lost, so the hand may still hold the stick.
    expect(wait(4040, 6000, false)).toBe(false);
    expect(wait(6020, 7000, true)).toBe(true);
    expect(driver.onTwist(forward(0.5), 7020)).toMatchObject(refused);
    wait(7040, 9100, true);
    expect(driver.onTwist(forward(0.5), 9120)).toMatchObject({ accepted: true });
  });

  it('presumes the hand open in a session before which none was held, and says when it may hold on', () => {
    const { driver, wait } = setUp(false);
    expect(driver.holds(0)).toBe(false);
    expect(driver.onTwist(forward(0.5), 20)).toMatchObject({ accepted: true });
    expect(driver.holds(100)).toBe(true);
    wait(40, 1900, true);
    expect(driver.holds(1900)).toBe(true);
    wait(1920, 2100, true);
    expect(driver.holds(2100)).toBe(false);
    driver.onTwist(forward(0.5), 2120);
    driver.onTwist(zeroTwist(), 2140);
    expect(driver.holds(2160)).toBe(false);
  });

  it('takes what stood in a queue for no open hand', () => {
    const { guard, driver } = setUp();
    driver.onTwist(zeroTwist(), 0);
    driver.onTwist(forward(0.5), 20);
    guard.latchEstop('operator');
    guard.onOpenHand('supervisor');
    expect(guard.releaseEstop('supervisor', true)).toEqual({ released: true });
    // Commands of a stick that was held all the time, all at once, after a stall.
    for (let i = 0; i < 10; i++) driver.onTwist(forward(0.5), 400 + i * 0.1);
    expect(driver.onTwist(forward(0.5), 420)).toMatchObject({ accepted: false, reason: 'estop-latched' });
    driver.onTwist(zeroTwist(), 440);
    expect(driver.onTwist(forward(0.5), 460)).toMatchObject({ accepted: true });
  });

  it('stays within the limits and stops after the watchdog time, whatever arrives and when', () => {
    const component = fc.oneof(fc.constant(0), fc.double({ min: -3, max: 3, noNaN: true }));
    const step = fc.record({
      waitMs: fc.double({ min: 0, max: 400, noNaN: true }),
      x: component,
      z: component,
      turn: component,
    });
    fc.assert(
      fc.property(fc.array(step, { maxLength: 60 }), (steps) => {
        const { guard, driver } = setUp();
        let now = 0;
        for (const { waitMs, x, z, turn } of steps) {
          now += waitMs;
          driver.checkQuiet(now, true);
          driver.onTwist({ linear: { x, y: 0, z }, angular: { x: 0, y: 0, z: turn } }, now);
          const { linear, angular } = guard.velocityAt(now);
          expect(Math.abs(linear.x)).toBeLessThanOrEqual(limits.maxLinear);
          expect(Math.abs(angular.z)).toBeLessThanOrEqual(limits.maxAngular);
          expect(guard.velocityAt(now + limits.watchdogMs + 0.001)).toEqual(zeroTwist());
        }
      }),
      { seed: 3, numRuns: 200 },
    );
  });
});
