import type { Telemetry } from '@farpoint/protocol';
import { describe, expect, test } from 'vitest';
import { Travel } from './travel.ts';

interface Said {
  readonly timeMs: number;
  readonly x?: number;
  readonly y?: number;
  readonly speed?: number;
  readonly turn?: number;
  readonly motion?: { factor: number; reasons: readonly string[] };
}

function telemetry({ timeMs, x = 0, y = 0, speed = 0, turn = 0, motion }: Said): Telemetry {
  const twist = { linear: { x: speed, y: 0, z: 0 }, angular: { x: 0, y: 0, z: turn } };
  return { timeMs, pose: { position: { x, y, z: 0 } }, twist, motion } as unknown as Telemetry;
}

/** A robot whose limit is 1 m/s, and that tells where it is every 50 ms. */
function drive(steps: number, at: (i: number) => Omit<Said, 'timeMs'>): Travel {
  const travel = new Travel(1);
  for (let i = 0; i <= steps; i++) travel.observe(telemetry({ ...at(i), timeMs: 1000 + i * 50 }));
  return travel;
}

describe('how far a robot has driven', () => {
  test('along a circle of 2 m', () => {
    const travel = drive(2000, (i) => ({ x: 2 * Math.cos(i / 100), y: 2 * Math.sin(i / 100), speed: 0.4 }));
    expect(travel.distanceM).toBeGreaterThan(39.8);
    expect(travel.distanceM).toBeLessThanOrEqual(40);
    expect(travel.drivingS).toBeCloseTo(100, 6);
    expect(travel.topSpeedMps).toBe(0.4);
  });

  test('an odometry that trembles where it stands drives nowhere', () => {
    const travel = drive(2000, (i) => ({ x: i % 2 === 0 ? 0.02 : -0.02, speed: 0.019, turn: 0.019 }));
    expect(travel).toMatchObject({ distanceM: 0, jumps: 0, drivingS: 0 });
    expect(travel.standingS).toBeCloseTo(100, 6);
  });

  test('a jump of the localisation is no drive', () => {
    const travel = drive(40, (i) => ({ x: i * 0.04 + (i > 20 ? 5 : 0), speed: 0.8 }));
    expect(travel.jumps).toBe(1);
    expect(travel.distanceM).toBeGreaterThan(1.4);
    expect(travel.distanceM).toBeLessThan(1.6);
  });

  test('turning on the spot is driving', () => {
    expect(drive(20, () => ({ turn: -0.5 })).drivingS).toBeCloseTo(1, 6);
  });

  test('a gap is time of which nothing is known, and what it drove meanwhile counts if it could', () => {
    const travel = new Travel(1);
    travel.observe(telemetry({ timeMs: 0 }));
    travel.observe(telemetry({ timeMs: 10_000, x: 8 }));
    expect(travel).toMatchObject({ unknownS: 10, drivingS: 0, standingS: 0, distanceM: 8 });
    travel.observe(telemetry({ timeMs: 9000, x: 100 }));
    expect(travel).toMatchObject({ unknownS: 10, jumps: 0, distanceM: 8 });
  });

  test('for how long it was held and slowed', () => {
    const held = { factor: 0, reasons: ['obstacle'] };
    const slowed = { factor: 0.5, reasons: ['view-late'] };
    const travel = drive(40, (i) => (i > 20 ? { motion: held } : i > 10 ? { motion: slowed } : {}));
    expect([travel.heldS, travel.slowedS]).toEqual([expect.closeTo(1, 6), expect.closeTo(0.5, 6)]);
  });
});
