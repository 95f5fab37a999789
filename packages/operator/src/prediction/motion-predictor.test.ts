import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { standingAt } from './base-model.ts';
import { MotionPredictor } from './motion-predictor.ts';
import type { PredictionLimits, ReportedMotion } from './reported-motion.ts';

const LIMITS = { maxLinear: 1, maxAngular: 1.5, watchdogMs: 150 };
const ROBOT_CLOCK_MS = 5_000_000;
const WAY_MS = 75;

function newPredictor(): MotionPredictor {
  const predictor = new MotionPredictor();
  predictor.setLimits(LIMITS);
  predictor.setClock(ROBOT_CLOCK_MS, 2 * WAY_MS);
  predictor.driving = true;
  return predictor;
}

/** A report of a pose at `measuredMs` of the operator's clock. */
function reported(measuredMs: number, x: number, other: Partial<ReportedMotion> = {}): ReportedMotion {
  return {
    ...{ robotMs: measuredMs + ROBOT_CLOCK_MS, arrivedMs: measuredMs + WAY_MS, x, y: 0, yaw: 0 },
    ...{ held: false, factor: 1, mostLinear: 1, ...other },
  };
}

/** Drives straight on for so long: a base that needs 0.5 s to 1 m/s, 75 ms after each command. @returns where it is */
function drive(predictor: MotionPredictor, untilMs: number, linear = 1): (ms: number) => number {
  const whereAt = (ms: number) => {
    const s = Math.max(0, (ms - WAY_MS) / 1000);
    return s < 0.5 ? linear * s * s : linear * (0.25 + (s - 0.5));
  };
  for (let ms = 0; ms <= untilMs; ms += 25) {
    predictor.onCommand(ms, linear, 0);
    const measuredMs = ms - WAY_MS;
    if (ms % 50 === 0) predictor.onReport(reported(measuredMs, whereAt(measuredMs)));
  }
  return whereAt;
}

const xAt = (predictor: MotionPredictor, atMs: number) => {
  const into = standingAt();
  predictor.poseAt(atMs, into);
  return into.x;
};

describe('a predicted pose', () => {
  test('is where the robot is by now, not where it was reported', () => {
    const predictor = newPredictor();
    const whereAt = drive(predictor, 2000);
    expect(predictor.stateAt(2016)).toBe('predicted');
    expect(Math.abs(xAt(predictor, 2016) - whereAt(2016))).toBeLessThan(0.03);
    expect(whereAt(2016) - whereAt(2000 - WAY_MS)).toBeGreaterThan(0.09);
    expect(predictor.aheadMs(2016)).toBeCloseTo(WAY_MS + 16, 0);
  });

  test('moves with the hand’s wish at once, before a command carries it, but by a little only', () => {
    const predictor = newPredictor();
    for (let ms = 0; ms <= 1000; ms += 50) predictor.onReport(reported(ms - WAY_MS, 0));
    predictor.wish(1000, 1, 0);
    const first = xAt(predictor, 1017);
    expect(first).toBeGreaterThan(2e-5);
    predictor.onCommand(1010, 1, 0);
    for (let ms = 1017; ms < 1060; ms += 17)
      expect(xAt(predictor, ms + 17)).toBeGreaterThan(xAt(predictor, ms));
    // What the robot cannot have heard of yet leads by 1.5 cm at the most.
    expect(xAt(predictor, 1070)).toBeLessThan(0.015);
  });

  test('needs no clock answers', () => {
    const predictor = newPredictor();
    predictor.setClock(null, null);
    const whereAt = drive(predictor, 2000);
    expect(Math.abs(xAt(predictor, 2016) - whereAt(2016))).toBeLessThan(0.06);
  });

  test('is as reported while the robot is held, at once, and while it is silent', () => {
    const predictor = newPredictor();
    drive(predictor, 2000);
    predictor.onReport(reported(1950, 1.7, { held: true }));
    expect(predictor.stateAt(2030)).toBe('held');
    expect(xAt(predictor, 2030)).toBe(1.7);
    predictor.onReport(reported(2000, 1.72));
    expect(predictor.stateAt(2080)).toBe('predicted');
    expect(xAt(predictor, 2080)).toBeGreaterThan(1.72);
    expect(predictor.stateAt(2900)).toBe('stale');
    expect([xAt(predictor, 2900), predictor.aheadMs(2900)]).toEqual([1.72, 0]);
  });

  test('is as reported as soon as a stop is latched or on its way, or the path is lost', () => {
    const predictor = newPredictor();
    const reportedAt = drive(predictor, 2000)(1925);
    predictor.stopped = true;
    expect([predictor.stateAt(2016), xAt(predictor, 2016)]).toEqual(['held', reportedAt]);
    predictor.stopped = false;
    predictor.silent = true;
    expect([predictor.stateAt(2016), xAt(predictor, 2016)]).toEqual(['stale', reportedAt]);
    predictor.silent = false;
    expect(predictor.stateAt(2016)).toBe('predicted');
  });

  test('is as reported where the pose is old although messages come', () => {
    const predictor = newPredictor();
    drive(predictor, 2000);
    for (let ms = 2050; ms < 2900; ms += 50) predictor.onReport({ ...reported(1950, 1.7), arrivedMs: ms });
    expect(predictor.stateAt(2900)).toBe('stale');
  });

  test('is as reported for those who do not drive', () => {
    const predictor = newPredictor();
    expect(predictor.stateAt(0)).toBe('no-pose');
    drive(predictor, 1000);
    predictor.driving = false;
    expect(predictor.stateAt(1010)).toBe('not-driving');
    expect(predictor.aheadMs(1010)).toBe(0);
  });

  test('keeps to the share and the speed that the robot lets through now', () => {
    const free = newPredictor();
    const slowed = newPredictor();
    const creeping = newPredictor();
    for (const predictor of [free, slowed, creeping]) drive(predictor, 2000, 0.5);
    const at = drive(newPredictor(), 0, 0.5)(1950);
    free.onReport(reported(1950, at));
    slowed.onReport(reported(1950, at, { factor: 0.2 }));
    creeping.onReport(reported(1950, at, { mostLinear: 0.1 }));
    const whole = xAt(free, 2100) - at;
    expect(whole).toBeCloseTo(0.5 * 0.15, 1);
    expect(xAt(slowed, 2100) - at).toBeLessThan(whole - 0.005);
    expect(xAt(creeping, 2100) - at).toBeLessThan(whole - 0.005);
  });

  test('never leaves what the robot’s limits allow, whatever it is told', () => {
    const value = fc.double({ min: -3, max: 3, noNaN: true });
    const step = fc.record({ linear: value, angular: value, x: value, yaw: value, held: fc.boolean() });
    fc.assert(
      fc.property(fc.array(step, { minLength: 1, maxLength: 40 }), (steps) => {
        const predictor = newPredictor();
        let ms = 0;
        for (const { linear, angular, x, yaw, held } of steps) {
          ms += 50;
          predictor.onCommand(ms, linear, angular);
          predictor.onReport({ ...reported(ms - WAY_MS, x), yaw, held });
          const into = standingAt();
          predictor.poseAt(ms + 17, into);
          // By the newest report's age; the lead of what is still on its way comes on top.
          const seconds = (WAY_MS + 17) / 1000;
          expect(Math.hypot(into.x - x, into.y)).toBeLessThanOrEqual(LIMITS.maxLinear * seconds + 0.0151);
          const turn = into.yaw - yaw - 2 * Math.PI * Math.round((into.yaw - yaw) / (2 * Math.PI));
          expect(Math.abs(turn)).toBeLessThanOrEqual(LIMITS.maxAngular * seconds + 0.0106);
        }
      }),
      { seed: 1 },
    );
  });

  test('a robot that is put somewhere else has jumped', () => {
    const predictor = newPredictor();
    drive(predictor, 1000, 0);
    const { jumps } = predictor;
    predictor.onReport(reported(950, 7));
    expect(predictor.jumps).toBe(jumps + 1);
    expect(xAt(predictor, 1030)).toBeCloseTo(7, 2);
    predictor.reset();
    expect(predictor.stateAt(1030)).toBe('no-pose');
  });
});

test('the first motion is predicted by the ramps that the welcome tells, which another session forgets', () => {
  const predictor = newPredictor();
  const slow = structuredClone(predictor.model);
  predictor.setLimits({ ...LIMITS, accelerationMps2: 2, decelerationMps2: 2, turnRadps2: 3 });
  predictor.setClock(ROBOT_CLOCK_MS, 2 * WAY_MS);
  expect(predictor.model.angular).toMatchObject({ rise: 3, fall: 3 });
  const whereAt = drive(predictor, 350);
  expect(Math.abs(xAt(predictor, 366) - whereAt(366))).toBeLessThan(0.02);
  predictor.reset();
  predictor.setLimits(LIMITS);
  predictor.setClock(ROBOT_CLOCK_MS, 2 * WAY_MS);
  expect(predictor.model).toEqual(slow);
});

test('standing still for long spoils nothing that was learnt', () => {
  const predictor = newPredictor();
  const whereAt = drive(predictor, 4000);
  const learnt = structuredClone(predictor.model);
  for (let ms = 4025; ms < 6000; ms += 25) predictor.onCommand(ms, 0, 0);
  const stoodAt = whereAt(4000) + 0.2;
  for (let ms = 6500; ms < 600_000; ms += 50)
    predictor.onReport(reported(ms, stoodAt + 0.001 * Math.sin(ms)));
  expect(predictor.model).toEqual(learnt);
});

describe('sideways', () => {
  const placeAt = (predictor: MotionPredictor, atMs: number) => {
    const into = standingAt();
    predictor.poseAt(atMs, into);
    return into;
  };
  /** Goes to its left for two seconds, at once as fast as it was told. */
  const slides = (limits: PredictionLimits) => {
    const predictor = newPredictor();
    predictor.setLimits(limits);
    for (let ms = 0; ms <= 2000; ms += 25) {
      predictor.onCommand(ms, 0, 0, 0.4);
      const measuredMs = ms - WAY_MS;
      const y = 0.4 * Math.max(0, (measuredMs - WAY_MS) / 1000);
      if (ms % 50 === 0) predictor.onReport(reported(measuredMs, 0, { y }));
    }
    return placeAt(predictor, 2016);
  };

  test('the pose is where a robot is by now that goes to its left', () => {
    const { x, y, lateral } = slides({ ...LIMITS, maxLateral: 0.5 });
    expect(Math.abs(y - 0.4 * (2.016 - WAY_MS / 1000))).toBeLessThan(0.02);
    expect(Math.abs(x)).toBeLessThan(1e-9);
    expect(lateral).toBeGreaterThan(0.35);
  });

  test('of one that cannot, nothing is expected there', () => {
    expect(slides(LIMITS)).toMatchObject({
      y: expect.closeTo(0.4 * (1.925 - WAY_MS / 1000), 2),
      lateral: expect.closeTo(0),
    });
  });
});
