import { type Twist, zeroTwist } from '@farpoint/protocol';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { Odometry } from './odometry.ts';

const LIMITS = { maxLinear: 0.6, maxAngular: 1 };
const STEP_MS = 50;

function go(linear: number, angular = 0): Twist {
  const twist = zeroTwist();
  twist.linear.x = linear;
  twist.angular.z = angular;
  return twist;
}

/** A robot that was at the origin a moment ago. */
function begun(twist: Twist | null = go(0)) {
  const odometry = new Odometry(LIMITS);
  odometry.measured({ x: 0, y: 0, yaw: 0 }, twist, 0);
  return odometry;
}

describe('a pose', () => {
  test('that is not newer, or is none, changes nothing', () => {
    const odometry = begun();
    odometry.measured({ x: 1, y: 0, yaw: 0 }, go(0), 0);
    odometry.measured({ x: 2, y: 0, yaw: 0 }, go(0), -60_000);
    odometry.measured({ x: Number.NaN, y: 0, yaw: 0 }, go(0), 100);
    odometry.measured({ x: 3, y: 0, yaw: 0 }, go(0), null);
    expect(odometry.newest).toMatchObject({ pose: { x: 0 }, measuredMs: 0 });
    expect(odometry.jumps.count).toBe(0);
  });

  test('has jumped where no speed of the robot explains it', () => {
    const odometry = begun();
    odometry.measured({ x: 0.12, y: 0, yaw: 0.12 }, go(0.6), 50);
    expect(odometry.jumps.count).toBe(0);
    odometry.measured({ x: 1.32, y: 0, yaw: 0.12 }, go(0.6), 100);
    expect(odometry.jumps).toEqual({ count: 1, lastMs: 100 });
    odometry.measured({ x: 1.35, y: 0, yaw: 0.9 }, go(0.6), 150);
    expect(odometry.jumps).toEqual({ count: 2, lastMs: 150 });
    // After a silence in which it may have been anywhere.
    odometry.measured({ x: 1.4, y: 0, yaw: 0.9 }, go(0), 10_000);
    expect(odometry.jumps).toEqual({ count: 3, lastMs: 10_000 });
  });
});

// At most 0.6 m/s and 1 rad/s.
test.each([
  { x: 0.14, yaw: 0, afterMs: 50, count: 0 },
  { x: 0.15, yaw: 0, afterMs: 50, count: 1 },
  { x: 0.99, yaw: 0, afterMs: 1000, count: 0 },
  { x: 1.01, yaw: 0, afterMs: 1000, count: 1 },
  { x: 0, yaw: 1.59, afterMs: 1000, count: 0 },
  { x: 0, yaw: -1.61, afterMs: 1000, count: 1 },
  { x: 0.5, yaw: 0, afterMs: 2000, count: 0 },
  { x: 0.02, yaw: 0, afterMs: 2001, count: 1 },
  { x: 0, yaw: 0, afterMs: 2001, count: 0 },
])(
  'jumps by 10 cm or 0.1 rad more than at one and a half times its speed, or at all after 2 s: $x m, $yaw rad, $afterMs ms',
  ({ x, yaw, afterMs, count }) => {
    const odometry = begun();
    odometry.measured({ x, y: 0, yaw }, go(0), afterMs);
    expect(odometry.jumps.count).toBe(count);
  },
);

describe('a pose that does not move although the robot is told to', () => {
  /** Told, with the same pose in every step. @returns how far it was told to go before the pose was given up, m */
  function toldUntilStuck(odometry: Odometry, speed: number, twist: Twist, fromMs: number): number {
    let metres = 0;
    let nowMs = fromMs;
    for (; !odometry.isStuck && nowMs < fromMs + 60_000; nowMs += STEP_MS) {
      odometry.measured({ x: 0, y: 0, yaw: 0 }, twist, nowMs);
      odometry.told(go(speed), nowMs);
      metres += (speed * STEP_MS) / 1000;
    }
    return metres;
  }

  test.each([0.05, 0.15, 0.6])('is given up soon, at %s m/s', (speed) => {
    const odometry = begun();
    expect(toldUntilStuck(odometry, speed, go(0), 50)).toBeLessThan(0.1 + 0.55 * speed + 0.06);
    expect([odometry.newest, odometry.isStuck]).toEqual([null, true]);
    odometry.measured({ x: 0.02, y: 0, yaw: 0 }, go(0), 100_000);
    expect(odometry.newest?.pose.x).toBe(0.02);
  });

  test('may be tried again after the robot stood, a little less far each time', () => {
    const odometry = begun();
    let nowMs = 50;
    let metres = 0;
    for (let tries = 0; tries < 20; tries++) {
      const gone = toldUntilStuck(odometry, 0.6, go(0), nowMs);
      metres += gone;
      nowMs += Math.round((gone / 0.6) * 1000) + 100;
      odometry.told(go(0), nowMs);
      odometry.told(go(0), nowMs + 900);
      expect([tries, odometry.isStuck]).toEqual([tries, true]);
      nowMs += 1000;
      odometry.told(go(0), nowMs);
    }
    expect(odometry.isStuck).toBe(true);
    expect(metres).toBeLessThan(1);
  });

  test('and says that it does, is not tried again', () => {
    const odometry = begun();
    toldUntilStuck(odometry, 0.6, go(0.5), 50);
    odometry.told(go(0), 2000);
    odometry.told(go(0), 9000);
    expect(odometry.isStuck).toBe(true);
  });

  test('is no matter for a robot that turns or goes as it is told', () => {
    for (const [linear, angular] of [
      [0.05, 0],
      [0, 0.1],
      [-0.6, 1],
    ] as const) {
      const odometry = begun();
      for (let nowMs = 50; nowMs < 20_000; nowMs += STEP_MS) {
        const s = nowMs / 1000;
        odometry.measured({ x: linear * s, y: 0, yaw: angular * s }, null, nowMs);
        odometry.told(go(linear, angular), nowMs);
        expect(odometry.isStuck).toBe(false);
      }
      expect(odometry.jumps.count).toBe(0);
    }
  });
});

test('a velocity that nobody measures is estimated from the poses', () => {
  fc.assert(
    fc.property(
      fc.double({ min: -0.6, max: 0.6, noNaN: true }),
      fc.double({ min: -1, max: 1, noNaN: true }),
      fc.double({ min: -Math.PI, max: Math.PI, noNaN: true }),
      (linear, angular, start) => {
        const odometry = new Odometry(LIMITS);
        let [x, y, yaw] = [0, 0, start];
        for (let nowMs = 0; nowMs <= 500; nowMs += 20) {
          odometry.measured({ x, y, yaw }, null, nowMs);
          yaw += angular * 0.01;
          x += linear * Math.cos(yaw) * 0.02;
          y += linear * Math.sin(yaw) * 0.02;
          yaw += angular * 0.01;
        }
        const twist = odometry.newest?.twist;
        expect(twist?.linear.x).toBeCloseTo(linear, 2);
        expect(twist?.linear.y).toBeCloseTo(0, 2);
        expect(twist?.angular.z).toBeCloseTo(angular, 5);
      },
    ),
    { seed: 3 },
  );
  expect(begun(null).newest?.twist).toBeNull();
});

describe('of a base that goes sideways', () => {
  const aside = (y: number): Twist => ({ ...zeroTwist(), linear: { x: 0, y, z: 0 } });

  test('a pose jumps only where the greater of its limits does not explain it', () => {
    const poseAfter = (limits: { maxLinear: number; maxLateral?: number; maxAngular: number }) => {
      const odometry = new Odometry(limits);
      odometry.measured({ x: 0, y: 0, yaw: 0 }, aside(1), 0);
      odometry.measured({ x: 0, y: 1.4, yaw: 0 }, aside(1), 1000);
      return odometry.jumps.count;
    };
    expect(poseAfter(LIMITS)).toBe(1);
    expect(poseAfter({ ...LIMITS, maxLateral: 1 })).toBe(0);
    expect(poseAfter({ ...LIMITS, maxLateral: 0.2 })).toBe(1);
  });

  test('a pose that does not move although the robot is told to go sideways is not believed', () => {
    const odometry = new Odometry({ ...LIMITS, maxLateral: 0.5 });
    odometry.measured({ x: 0, y: 0, yaw: 0 }, aside(0), 0);
    for (let ms = 0; ms <= 2000; ms += STEP_MS) {
      odometry.told(aside(0.5), ms);
      odometry.measured({ x: 0, y: 0, yaw: 0 }, aside(0), ms + 1);
    }
    expect(odometry.isStuck).toBe(true);
  });

  test('a velocity that nobody measures is estimated to the side, too', () => {
    const odometry = new Odometry({ ...LIMITS, maxLateral: 0.5 });
    for (let ms = 0; ms <= 200; ms += STEP_MS)
      odometry.measured({ x: (-0.4 * ms) / 1000, y: 0, yaw: Math.PI / 2 }, null, ms);
    expect(odometry.newest?.twist?.linear).toMatchObject({ x: expect.closeTo(0), y: expect.closeTo(0.4) });
  });
});
