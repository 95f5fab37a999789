import { longProperty, shareInEachRun } from '@farpoint/network-sim/cases';
import type { Twist } from '@farpoint/protocol';
import fc from 'fast-check';
import { expect, test } from 'vitest';
import type { Area, Place } from './area.ts';
import { clearance, type Fence } from './fence.ts';
import { defaultGeofenceOptions, Geofence } from './geofence.ts';

const OPTIONS = { ...defaultGeofenceOptions, radiusM: 0.3 };
const STEP_S = 0.01;
/** With the time between two commands it is the configured reaction time at most. */
const BASE_DELAY_MS = 150;

/** A base that brakes as configured when it must, and half as hard otherwise. Starts as hard as it brakes. */
class Base {
  x = 0;
  y = 0;
  yaw = 0;
  linear = 0;
  angular = 0;

  step(linear: number, angular: number, isUrgent: boolean): void {
    const slower = Math.abs(linear) < Math.abs(this.linear) || linear * this.linear < 0;
    const rate = OPTIONS.brakeMps2 * (isUrgent || !slower ? 1 : 0.5);
    this.linear += clamp(linear - this.linear, rate * STEP_S);
    this.angular += clamp(angular - this.angular, OPTIONS.turnBrakeRadps2 * STEP_S);
    this.x += this.linear * Math.cos(this.yaw) * STEP_S;
    this.y += this.linear * Math.sin(this.yaw) * STEP_S;
    this.yaw += this.angular * STEP_S;
  }
}

function clamp(value: number, most: number): number {
  return Math.min(most, Math.max(-most, value));
}

/** A star around the origin, of any outline that leaves the robot room. */
const star = fc
  .array(fc.double({ min: 0.7, max: 5, noNaN: true }), { minLength: 3, maxLength: 12 })
  .map((reaches): Area => {
    const ring = reaches.map((reach, i): Place => {
      const angle = (2 * Math.PI * i) / reaches.length;
      return [reach * Math.cos(angle), reach * Math.sin(angle)];
    });
    return { shape: 'polygon', rings: [ring] };
  });
const hole = fc
  .record({
    angle: fc.double({ min: 0, max: 6.3, noNaN: true }),
    far: fc.double({ min: 1, max: 4, noNaN: true }),
    radiusM: fc.double({ min: 0.05, max: 0.4, noNaN: true }),
  })
  .map(({ angle, far, radiusM }): Area => {
    return { shape: 'circle', centre: [far * Math.cos(angle), far * Math.sin(angle)], radiusM };
  });
const fence = fc.record({
  allowed: fc.array(star, { maxLength: 2 }),
  forbidden: fc.array(hole, { maxLength: 3 }),
  slow: fc.array(fc.record({ area: hole, maxMps: fc.constantFrom(0.1, 0.3) }), { maxLength: 1 }),
  radiusM: fc.constantFrom(null, 1, 3),
});
const hand = fc.record({
  forS: fc.constantFrom(0.04, 0.2, 0.5, 1.5, 4),
  linear: fc.oneof(fc.constantFrom(0, 1, -1, 1.5), fc.double({ min: -1.5, max: 1.5, noNaN: true })),
  angular: fc.oneof(fc.constantFrom(0, 0, 1.5, -1.5), fc.double({ min: -1.5, max: 1.5, noNaN: true })),
});

interface Drive {
  fence: Fence;
  hands: { forS: number; linear: number; angular: number }[];
  yaw: number;
  /** Between two commands, ms. */
  everyMs: number;
  /** Age of a position when it is used, ms. */
  ageMs: number;
  knowsYaw: boolean;
}

/** Drives as the hands say. Calls back at each step. @returns how far the robot went, m */
function drive({ fence, hands, yaw, everyMs, ageMs, knowsYaw }: Drive, onStep: (base: Base) => void): number {
  const base = new Base();
  base.yaw = yaw;
  const track: { x: number; y: number; yaw: number; linear: number; angular: number; atMs: number }[] = [];
  let nowMs = 0;
  let way = 0;
  const guard = new Geofence(fence, OPTIONS, () => {
    const old = track.findLast(({ atMs }) => atMs <= nowMs - ageMs) ?? track[0];
    return old === undefined ? null : { ...old, yaw: knowsYaw ? old.yaw : null, errorM: 0 };
  });
  let nextMs = 0;
  /** What the base has been told, and when it follows. */
  const told: { fromMs: number; linear: number; angular: number; urgent: boolean }[] = [];
  for (const { forS, linear, angular } of hands) {
    for (let s = 0; s < forS; s += STEP_S) {
      const { x, y, yaw, linear: v, angular: w } = base;
      track.push({ x, y, yaw, linear: v, angular: w, atMs: nowMs });
      if (track.length > 100) track.shift();
      if (nowMs >= nextMs) {
        nextMs = nowMs + everyMs;
        const { factor, urgent } = guard.bound(twist(linear, angular), nowMs);
        const fromMs = nowMs + BASE_DELAY_MS;
        told.push({ fromMs, linear: linear * factor, angular: angular * factor, urgent });
        if (told.length > 50) told.shift();
      }
      const now = told.findLast(({ fromMs }) => fromMs <= nowMs);
      base.step(now?.linear ?? 0, now?.angular ?? 0, now?.urgent ?? true);
      way += Math.abs(base.linear) * STEP_S;
      nowMs += STEP_S * 1000;
      onStep(base);
    }
  }
  return way;
}

function twist(x: number, z: number): Twist {
  return { linear: { x, y: 0, z: 0 }, angular: { x: 0, y: 0, z } };
}

test.each([true, false])(
  'whatever the fence, the speeds and the commands, the base never leaves (yaw known: %s)',
  (knowsYaw) => {
    let way = 0;
    let runs = 0;
    fc.assert(
      fc.property(
        fc.record({
          fence,
          hands: fc.array(hand, { minLength: 1, maxLength: 12 }),
          yaw: fc.double({ min: -3.2, max: 3.2, noNaN: true }),
          everyMs: fc.constantFrom(10, 20, 40),
          ageMs: fc.constantFrom(0, 20, 100),
        }),
        (given) => {
          if (clearance(given.fence, 0, 0) < OPTIONS.radiusM + 0.05) return;
          runs++;
          let least = Number.POSITIVE_INFINITY;
          way += drive({ ...given, knowsYaw }, ({ x, y }) => {
            least = Math.min(least, clearance(given.fence, x, y));
          });
          expect(least).toBeGreaterThanOrEqual(OPTIONS.radiusM);
        },
      ),
      longProperty(19, 2000, { share: shareInEachRun(1 / 8) }),
    );
    // Without this check, the property would hold for a robot that never moves.
    expect(way / runs).toBeGreaterThan(knowsYaw ? 1 : 0.3);
  },
  30_000,
);

test.each([true, false])('a hand that creeps for minutes gets no farther (yaw known: %s)', (knowsYaw) => {
  const fence: Fence = { allowed: [], forbidden: [], slow: [], radiusM: 1 };
  for (const linear of [0.02, 0.0099, 0.001]) {
    const hands = [1.5, linear].map((each, i) => ({ forS: i === 0 ? 4 : 120, linear: each, angular: 0 }));
    drive({ fence, hands, yaw: 0, everyMs: 40, ageMs: 100, knowsYaw }, ({ x, y }) => {
      if (clearance(fence, x, y) < OPTIONS.radiusM) expect.fail(`at ${x} m, by ${linear} m/s`);
    });
  }
});

test('a robot that was put outside comes back in, and no farther out', () => {
  const room: Fence = {
    allowed: [
      {
        shape: 'polygon',
        rings: [
          [
            [-2, -2],
            [2, -2],
            [2, 2],
            [-2, 2],
          ],
        ],
      },
    ],
    ...{ forbidden: [], slow: [], radiusM: null },
  };
  fc.assert(
    fc.property(
      fc.double({ min: -Math.PI, max: Math.PI, noNaN: true }),
      fc.double({ min: -1, max: 1, noNaN: true }),
      fc.double({ min: -1, max: 1, noNaN: true }),
      (yaw, linear, angular) => {
        const base = new Base();
        Object.assign(base, { x: 3, y: 0.5, yaw });
        let nowMs = 0;
        const guard = new Geofence(room, OPTIONS, () => ({ ...base, errorM: 0, atMs: nowMs }));
        let before = clearance(room, base.x, base.y);
        for (let i = 0; i < 1000; i++) {
          const { factor, urgent } = guard.bound(twist(linear, angular), nowMs);
          base.step(linear * factor, angular * factor, urgent);
          const now = clearance(room, base.x, base.y);
          if (now < OPTIONS.radiusM) expect(now).toBeGreaterThan(before - 0.002);
          before = Math.max(before, Math.min(now, OPTIONS.radiusM));
          nowMs += 10;
        }
      },
    ),
    longProperty(4, 200),
  );
});
