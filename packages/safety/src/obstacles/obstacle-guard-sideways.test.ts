/** What stands beside a robot that goes sideways bounds its speed as what stands ahead does. */
import { longProperty } from '@farpoint/network-sim/cases';
import { type Twist, zeroTwist } from '@farpoint/protocol';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { VelocityRamp } from '../motion/velocity-ramp.ts';
import { Footprint } from './footprint.ts';
import { ObstacleGuard } from './obstacle-guard.ts';
import { floorClasses } from './sensor-grid.ts';
import { PaintedGrid } from './testing/painted-grid.ts';

const DISC = Footprint.disc(0.25);
/** Longer than wide: what it sweeps depends on the direction. */
const LONG = new Footprint([
  { x: 0.6, y: 0.2 },
  { x: -0.2, y: 0.2 },
  { x: -0.2, y: -0.2 },
  { x: 0.6, y: -0.2 },
]);

function go(x: number, y: number, z = 0): Twist {
  const twist = zeroTwist();
  [twist.linear.x, twist.linear.y, twist.angular.z] = [x, y, z];
  return twist;
}

function standing(grid: PaintedGrid, footprint = DISC, twist = zeroTwist()): ObstacleGuard {
  const guard = new ObstacleGuard(footprint, 1);
  guard.moved({ x: 0, y: 0, yaw: 0 }, twist, 1000);
  guard.see(0, grid);
  return guard;
}

const floor = () => new PaintedGrid(1000);
/** To the left, from `y` on. */
const wall = (y: number) => floor().paint('occupied', -2, 2, y, 4);

describe('the obstacle guard beside the robot', () => {
  test('slows a motion to the side before a wall there as one forwards before a wall ahead', () => {
    for (const distance of [0.32, 0.45, 0.5, 0.6, 0.8]) {
      const ahead = standing(floor().paint('occupied', distance, 4, -2, 2)).bound(go(1, 0), 1010);
      const aside = standing(wall(distance)).bound(go(0, 1), 1010);
      expect(aside).toEqual({ ...ahead, factor: expect.closeTo(ahead.factor, 3) });
    }
  });

  test('looks to the side to which the robot goes, and only there', () => {
    const guard = standing(wall(0.32));
    expect(guard.bound(go(0, 1), 1010)).toEqual({ factor: 0, reason: 'obstacle', urgent: true });
    for (const wish of [go(0, -1), go(0.5, -0.5), go(1, 0), go(0, 0, 1)])
      expect(guard.bound(wish, 1010).factor).toBeGreaterThan(0.9);
  });

  test('takes the whole of a slanting velocity, not its parts', () => {
    const post = () => floor().paint('occupied', 0.5, 0.6, 0.5, 0.6);
    // Neither straight ahead nor to the side is it met.
    for (const wish of [go(0.7, 0), go(0, 0.7)]) expect(standing(post()).bound(wish, 1010).factor).toBe(1);
    const { factor, reason } = standing(post()).bound(go(0.7, 0.7), 1010);
    expect(reason).toBe('obstacle-near');
    expect(factor).toBeLessThan(0.7);
  });

  test('looks with the whole side that leads, also with what lies behind its middle', () => {
    const post = floor().paint('occupied', -0.15, -0.1, 0.68, 0.73);
    expect(standing(post).bound(go(0.2, 0.95), 1010)).toMatchObject({ reason: 'obstacle-near' });
    expect(standing(post).bound(go(0.7, 0.7), 1010).factor).toBe(1);
  });

  test('sweeps the outline in the direction of the motion', () => {
    // Beside the long nose, behind which a narrower robot would pass.
    const beside = floor().paint('occupied', 0.5, 0.6, 0.3, 0.4);
    expect(standing(beside, LONG).bound(go(0, 0.5), 1010).factor).toBe(0);
    expect(standing(floor().paint('occupied', 0.9, 1, 0.3, 0.4), LONG).bound(go(0, 0.5), 1010).factor).toBe(
      1,
    );
  });

  test('brakes as hard as it can for what is suddenly near at the side', () => {
    const guard = standing(wall(0.55), DISC, go(0, 1));
    expect(guard.bound(go(0, 1), 1010)).toEqual({ factor: 0, reason: 'obstacle', urgent: true });
  });

  test('a missing floor at the side stops it', () => {
    const guard = standing(floor().paint('dropOff', -2, 2, -4, -0.4));
    expect(guard.bound(go(0, -1), 1010)).toMatchObject({ factor: 0, reason: 'drop-off' });
  });

  test('where no sensor sees to the side, it goes no faster there than anywhere unseen', () => {
    // A camera that looks ahead.
    const ahead = () => floor().paint('unknown', -4, 4, 0.5, 4).paint('unknown', -4, 4, -4, -0.5);
    expect(standing(ahead()).bound(go(1, 0), 1010).factor).toBe(1);
    for (const wish of [go(0, 1), go(0, -1), go(0.6, 0.8), go(-0.6, -0.8)]) {
      const { factor, reason } = standing(ahead()).bound(wish, 1010);
      expect(reason).toBe('unseen-space');
      expect(factor).toBeLessThanOrEqual(0.3 + 1e-9);
    }
  });

  test('without odometry, a way to the side uses up what it knows as a way ahead does', () => {
    const guard = new ObstacleGuard(DISC, 1);
    const seen = floor();
    seen.placed = false;
    guard.see(0, seen);
    expect(guard.bound(go(0, 1), 1010).factor).toBe(1);
    expect(guard.bound(go(0, 1), 1200)).toEqual({ factor: 0.3, reason: 'unseen-space', urgent: false });
  });

  test('a wish to the side that is no number stops it', () => {
    for (const y of [Number.NaN, Number.POSITIVE_INFINITY])
      expect(standing(floor()).bound(go(0, y), 1010).factor).toBe(0);
  });
});

describe('however a robot is driven to all sides', () => {
  const part = fc.oneof(fc.constantFrom(0, 0, 1, -1), fc.double({ min: -1, max: 1, noNaN: true }));
  const hand = fc.record({
    x: part,
    y: part,
    z: fc.constantFrom(0, 0, 0, 1, -1),
    forMs: fc.integer({ min: 100, max: 1500 }),
  });
  const things = fc.array(
    fc.record({
      kind: fc.constantFrom('occupied' as const, 'occupied' as const, 'dropOff' as const),
      x: fc.double({ min: -2.2, max: 2, noNaN: true }),
      y: fc.double({ min: -2.2, max: 2, noNaN: true }),
      size: fc.double({ min: 0.1, max: 1, noNaN: true }),
    }),
    { minLength: 3, maxLength: 8 },
  );
  /** As a robot is configured by default: it brakes twice as hard as its guard plans (docs/obstacle-guard.md). */
  const ramps = {
    accelerationMps2: 1,
    decelerationMps2: 2,
    emergencyMps2: 4,
    turnRadps2: 3,
    emergencyTurnRadps2: 6,
  };
  /** From a command to the wheels, ms. */
  const DELAY_MS = 40;
  const TICK_MS = 20;
  /** Between two clouds, ms. */
  const CLOUDS_MS = 100;

  test.each([
    ['round', DISC],
    ['long', LONG],
  ])(
    'a %s one touches nothing and drives over no edge',
    (_, footprint) => {
      let way = 0;
      let met = 0;
      fc.assert(
        fc.property(things, fc.array(hand, { minLength: 3, maxLength: 7 }), (rectangles, hands) => {
          const grid = floor();
          for (const { kind, x, y, size } of rectangles) grid.paint(kind, x, x + size, y, y + size);
          grid.paint('free', -0.9, 0.9, -0.9, 0.9);
          const solid = cellsOf(grid);
          grid.capturedAtMs = 900;
          const guard = new ObstacleGuard(footprint, 1);
          const ramp = new VelocityRamp(ramps, 150);
          const told: Twist[] = Array.from({ length: DELAY_MS / TICK_MS }, zeroTwist);
          let now = 1000;
          const pose = { x: 0, y: 0, yaw: 0 };
          let moves = zeroTwist();
          for (const { x, y, z, forMs } of hands) {
            for (const untilMs = now + forMs; now < untilMs; now += TICK_MS) {
              guard.moved({ ...pose }, moves, now);
              if (now - grid.capturedAtMs >= CLOUDS_MS) {
                grid.capturedAtMs = now;
                guard.see(0, grid);
              }
              const wish = go(x, y, z);
              const { factor, urgent } = guard.bound(wish, now);
              if (factor < 1) met++;
              told.push(ramp.step(go(x * factor, y * factor, z * factor), urgent, now));
              moves = told.shift() ?? zeroTwist();
              const s = TICK_MS / 1000;
              const heading = pose.yaw + (moves.angular.z * s) / 2;
              const [cos, sin] = [Math.cos(heading), Math.sin(heading)];
              pose.x += (moves.linear.x * cos - moves.linear.y * sin) * s;
              pose.y += (moves.linear.x * sin + moves.linear.y * cos) * s;
              pose.yaw += moves.angular.z * s;
              way += Math.hypot(moves.linear.x, moves.linear.y) * s;
              if (touches(solid, pose, footprint)) expect.fail(`at ${pose.x}, ${pose.y}, ${pose.yaw}`);
            }
          }
        }),
        longProperty(31, 100),
      );
      expect(way).toBeGreaterThan(8);
      expect(met).toBeGreaterThan(200);
    },
    60_000,
  );
});

function cellsOf(grid: PaintedGrid): [number, number][] {
  const cells: [number, number][] = [];
  grid.classes.forEach((known, at) => {
    if (known === floorClasses.occupied || known === floorClasses.dropOff)
      cells.push([((at % 160) - 79.5) * 0.05, (Math.floor(at / 160) - 79.5) * 0.05]);
  });
  return cells;
}

/** Whether the middle of a cell lies under the robot. */
function touches(
  cells: readonly [number, number][],
  { x, y, yaw }: { x: number; y: number; yaw: number },
  footprint: Footprint,
): boolean {
  const [cos, sin] = [Math.cos(yaw), Math.sin(yaw)];
  return cells.some(([cx, cy]) => {
    const [dx, dy] = [cx - x, cy - y];
    if (dx * dx + dy * dy > 0.5) return false;
    const [px, py] = [dx * cos + dy * sin, dy * cos - dx * sin];
    return footprint.nearness(px, py, { distance: 0, x: 0, y: 0 }).distance < 0;
  });
}
