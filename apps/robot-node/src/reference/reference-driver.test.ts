import { type Twist, zeroTwist } from '@farpoint/protocol';
import { DriveGuard } from '@farpoint/safety';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { ReferenceDriver } from './reference-driver.ts';

const limits = { maxLinear: 1, maxAngular: 1.5, watchdogMs: 150, maxCommandsPerSecond: 100 };

function setUp() {
  const guard = new DriveGuard({ limits, randomBytes: (count) => new Uint8Array(count).fill(7) });
  return { guard, driver: new ReferenceDriver('reference:1', guard) };
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
    expect(driver.tick(2019, true)).toBe(false);
    expect(driver.tick(2020, true)).toBe(true);
    expect(guard.leaseHolder).toBeNull();
  });

  it('is refused while another drives, beyond the limits, and while the emergency stop is latched', () => {
    const { guard, driver } = setUp();
    guard.requestLease('operator', false, 0);
    expect(driver.onTwist(forward(0.5), 0)).toMatchObject({ accepted: false, reason: 'not-lease-holder' });
    guard.releaseLease('operator');
    expect(driver.onTwist(forward(2), 20)).toMatchObject({ accepted: false, reason: 'out-of-range' });
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
    for (let t = 0; t <= 100; t += 20) driver.onTwist(forward(0.5), t);
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

  it('after 1 s of silence, needs an open hand once: a zero, or 2 s without a request on a live path', () => {
    const refused = { accepted: false, reason: 'let-go-first' };
    const { driver } = setUp();
    driver.onTwist(forward(0.5), 0);
    expect(driver.onTwist(forward(0.5), 1500)).toMatchObject(refused);
    driver.onTwist(zeroTwist(), 1520);
    expect(driver.onTwist(forward(0.5), 1540)).toMatchObject({ accepted: true });
    // No zero was sent, but everything else kept arriving.
    expect(driver.tick(4000, true)).toBe(true);
    expect(driver.onTwist(forward(0.5), 4020)).toMatchObject({ accepted: true });
    // The path was lost, so the hand may still hold the stick.
    driver.tick(5000, false);
    expect(driver.tick(7000, true)).toBe(true);
    expect(driver.onTwist(forward(0.5), 7020)).toMatchObject(refused);
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
          driver.tick(now, true);
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
