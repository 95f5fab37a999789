/** The fence keeps a robot in that goes to all sides. */
import { longProperty } from '@farpoint/network-sim/cases';
import type { Twist } from '@farpoint/protocol';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import type { Area, Place } from './area.ts';
import { clearance, type Fence } from './fence.ts';
import { defaultGeofenceOptions, type FencePose, Geofence } from './geofence.ts';

const OPTIONS = { ...defaultGeofenceOptions, radiusM: 0.3 };
const STEP_S = 0.01;
/** With the time between two commands it is the configured reaction time at most. */
const BASE_DELAY_MS = 150;

function go(x: number, y: number, z = 0): Twist {
  return { linear: { x, y, z: 0 }, angular: { x: 0, y: 0, z } };
}

const half = (side: number): Fence => {
  const square: Place[] = [
    [-side, -side],
    [side, -side],
    [side, side],
    [-side, side],
  ];
  return { allowed: [{ shape: 'polygon', rings: [square] }], forbidden: [], slow: [], radiusM: null };
};

/** A base whose axes speed up and brake by themselves, as hard as configured when it must and half as hard otherwise. */
class Base {
  x = 0;
  y = 0;
  yaw = 0;
  linear = 0;
  lateral = 0;
  angular = 0;

  step({ linear, angular }: Twist, isUrgent: boolean): void {
    this.linear = this.#led(this.linear, linear.x, isUrgent);
    this.lateral = this.#led(this.lateral, linear.y, isUrgent);
    this.angular += clamp(angular.z - this.angular, OPTIONS.turnBrakeRadps2 * STEP_S);
    const [cos, sin] = [Math.cos(this.yaw), Math.sin(this.yaw)];
    this.x += (this.linear * cos - this.lateral * sin) * STEP_S;
    this.y += (this.linear * sin + this.lateral * cos) * STEP_S;
    this.yaw += this.angular * STEP_S;
  }

  #led(now: number, to: number, isUrgent: boolean): number {
    const slower = Math.abs(to) < Math.abs(now) || to * now < 0;
    return now + clamp(to - now, OPTIONS.brakeMps2 * (isUrgent || !slower ? 1 : 0.5) * STEP_S);
  }
}

function clamp(value: number, most: number): number {
  return Math.min(most, Math.max(-most, value));
}

function scaled({ linear, angular }: Twist, factor: number): Twist {
  return go(linear.x * factor, linear.y * factor, angular.z * factor);
}

describe('a wish to the side', () => {
  const pose: FencePose = { x: 0, y: 0, yaw: 0, linear: 0, angular: 0, errorM: 0, atMs: 1000 };
  const ask = (at: Partial<FencePose>, wish: Twist) =>
    new Geofence(half(2), OPTIONS, () => ({ ...pose, ...at })).bound(wish, 1020);

  test('is slowed towards the edge there as one forwards towards the edge ahead', () => {
    for (const near of [0.5, 1, 1.3, 1.6]) {
      const ahead = ask({ x: near }, go(1, 0));
      const aside = ask({ y: near }, go(0, 1));
      expect(aside).toEqual({ ...ahead, factor: expect.closeTo(ahead.factor, 5) });
    }
  });

  test('is free along the edge and away from it', () => {
    expect(ask({ y: 1.5 }, go(0, -1)).factor).toBe(1);
    expect(ask({ y: 1.5 }, go(0.5, 0)).factor).toBe(1);
  });

  test('of a robot that rolls to the side towards the edge is stopped, whatever it asks for', () => {
    expect(ask({ y: 1.4, lateral: 1 }, go(1, 0))).toMatchObject({ factor: 0, reason: 'fence' });
    expect(ask({ y: 1.4, lateral: 1 }, go(0, 0, 1))).toMatchObject({ factor: 0, reason: 'fence' });
  });

  test('that slants across the base is slower than one along an axis in the same direction', () => {
    const [near, diagonal] = [1.2, Math.SQRT1_2];
    const along = ask({ x: near, yaw: Math.PI / 4 }, go(diagonal, -diagonal));
    const ahead = ask({ x: near }, go(1, 0));
    // Both go along the world's x axis.
    expect(ahead.factor).toBeGreaterThan(0);
    expect(along.factor).toBeLessThan(ahead.factor - 0.05);
  });

  test('of a robot that still moves in another direction is slower than one of a robot that moves in that', () => {
    const turns = ask({ x: 0.5, y: 0.5, linear: 0.4 }, go(0, 1));
    const keeps = ask({ x: 0.5, y: 0.5, lateral: 0.4 }, go(0, 1));
    expect(turns.factor).toBeLessThan(keeps.factor - 0.05);
  });

  test('leads a robot back in that stands outside, and only in', () => {
    expect(ask({ y: 2.5 }, go(0, -1))).toMatchObject({ factor: expect.closeTo(0.3), reason: 'fence-near' });
    expect(ask({ y: 2.5 }, go(0, 1)).factor).toBe(0);
    expect(ask({ y: 2.5 }, go(1, 0)).factor).toBe(0);
    // It still rolls along the edge.
    expect(ask({ y: 2.5, linear: 0.5 }, go(0, -1)).factor).toBe(0);
  });

  test('without a position it stands', () => {
    expect(ask({ lateral: Number.NaN }, go(0, 0.1)).factor).toBe(0);
    expect(ask({ atMs: 0 }, go(0, 0.1)).factor).toBe(0);
  });
});

const star = fc
  .array(fc.double({ min: 0.7, max: 4, noNaN: true }), { minLength: 3, maxLength: 12 })
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
    far: fc.double({ min: 1, max: 3, noNaN: true }),
    radiusM: fc.double({ min: 0.05, max: 0.4, noNaN: true }),
  })
  .map(({ angle, far, radiusM }): Area => {
    return { shape: 'circle', centre: [far * Math.cos(angle), far * Math.sin(angle)], radiusM };
  });
const fence = fc.record({
  allowed: fc.array(star, { maxLength: 1 }),
  forbidden: fc.array(hole, { maxLength: 3 }),
  slow: fc.array(fc.record({ area: hole, maxMps: fc.constantFrom(0.1, 0.3) }), { maxLength: 1 }),
  radiusM: fc.constantFrom(null, 1, 2),
});
const part = fc.oneof(fc.constantFrom(0, 1, -1), fc.double({ min: -1.2, max: 1.2, noNaN: true }));
const hand = fc.record({
  forS: fc.constantFrom(0.04, 0.2, 0.5, 1.5, 4),
  x: part,
  y: part,
  z: fc.oneof(fc.constantFrom(0, 0, 0, 1.5, -1.5), fc.double({ min: -1.5, max: 1.5, noNaN: true })),
});

test.each([true, false])(
  'whatever it is told, the base never leaves (yaw known: %s)',
  (knowsYaw) => {
    let way = 0;
    let runs = 0;
    const drives = fc.record({
      fence,
      hands: fc.array(hand, { minLength: 1, maxLength: 12 }),
      yaw: fc.double({ min: -3.2, max: 3.2, noNaN: true }),
      everyMs: fc.constantFrom(10, 20, 40),
      ageMs: fc.constantFrom(0, 20, 100),
    });
    fc.assert(
      fc.property(drives, ({ fence, hands, yaw, everyMs, ageMs }) => {
        if (clearance(fence, 0, 0) < OPTIONS.radiusM + 0.05) return;
        runs++;
        const base = new Base();
        base.yaw = yaw;
        const track: (Omit<FencePose, 'errorM'> & { yaw: number })[] = [];
        const told: { fromMs: number; twist: Twist; urgent: boolean }[] = [];
        let [now, nextMs] = [0, 0];
        const guard = new Geofence(fence, OPTIONS, () => {
          const old = track.findLast(({ atMs }) => atMs <= now - ageMs) ?? track[0];
          return old === undefined ? null : { ...old, yaw: knowsYaw ? old.yaw : null, errorM: 0 };
        });
        for (const { forS, x, y, z } of hands) {
          for (let s = 0; s < forS; s += STEP_S) {
            const { x: atX, y: atY, yaw: heading, linear, lateral, angular } = base;
            track.push({ x: atX, y: atY, yaw: heading, linear, lateral, angular, atMs: now });
            if (track.length > 100) track.shift();
            if (now >= nextMs) {
              nextMs = now + everyMs;
              const { factor, urgent } = guard.bound(go(x, y, z), now);
              told.push({ fromMs: now + BASE_DELAY_MS, twist: scaled(go(x, y, z), factor), urgent });
              if (told.length > 50) told.shift();
            }
            const newest = told.findLast(({ fromMs }) => fromMs <= now);
            base.step(newest?.twist ?? go(0, 0), newest?.urgent ?? true);
            way += Math.hypot(base.linear, base.lateral) * STEP_S;
            now += STEP_S * 1000;
            if (clearance(fence, base.x, base.y) < OPTIONS.radiusM)
              expect.fail(`at ${base.x} m, ${base.y} m after ${now} ms`);
          }
        }
      }),
      longProperty(37, 1500),
    );
    // Without this check, the property would hold for a robot that never moves.
    expect(way / runs).toBeGreaterThan(knowsYaw ? 0.7 : 0.3);
  },
  60_000,
);
