import { longProperty, shareInEachRun } from '@farpoint/network-sim/cases';
import { type Twist, zeroTwist } from '@farpoint/protocol';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { Footprint } from './footprint.ts';
import { ObstacleGuard } from './obstacle-guard.ts';
import { floorClasses } from './sensor-grid.ts';
import { PaintedGrid } from './testing/painted-grid.ts';

const DISC = Footprint.disc(0.25);
const LONG = new Footprint([
  { x: 0.6, y: 0.2 },
  { x: -0.2, y: 0.2 },
  { x: -0.2, y: -0.2 },
  { x: 0.6, y: -0.2 },
]);

function go(linear: number, angular = 0): Twist {
  const twist = zeroTwist();
  twist.linear.x = linear;
  twist.angular.z = angular;
  return twist;
}

/** A guard that stands at the origin and has seen this. */
function standing(grid: PaintedGrid, footprint = DISC, twist = zeroTwist()): ObstacleGuard {
  const guard = new ObstacleGuard(footprint, 1);
  guard.moved({ x: 0, y: 0, yaw: 0 }, twist, 1000);
  guard.see(0, grid);
  return guard;
}

const floor = () => new PaintedGrid(1000);
/** From 1.0 m ahead on. */
const wall = (x = 1) => floor().paint('occupied', x, 4, -2, 2);

describe('the obstacle guard', () => {
  test('lets the robot go where the floor is free', () => {
    const guard = standing(floor());
    for (const wish of [go(1), go(-1), go(0, 1.5), go(0.8, -1), go(0)]) {
      expect(guard.bound(wish, 1010)).toEqual({ factor: 1, reason: null, urgent: false });
    }
  });

  test.each([
    [0.3, 'stops'],
    [-0.1, 'goes'],
    [-0.5, 'goes'],
  ])('beside a post that may touch the robot, heading %f rad towards it, it %s', (yaw, expected) => {
    const guard = new ObstacleGuard(DISC, 1);
    guard.moved({ x: 0, y: 0, yaw }, zeroTwist(), 1000);
    guard.see(0, floor().paint('occupied', -0.05, 0, 0.25, 0.3));
    expect(guard.bound(go(0.1), 1010).factor > 0 ? 'goes' : 'stops').toBe(expected);
  });

  test('slows the robot down before an obstacle, by the way that is left', () => {
    let last = 0;
    for (const x of [0.45, 0.5, 0.6, 0.7, 0.8]) {
      const { factor, reason, urgent } = standing(wall(x)).bound(go(1), 1010);
      expect([reason, urgent]).toEqual(['obstacle-near', false]);
      // It could stop in what is left: reaction, braking distance, margin.
      const left = x - 0.25 - 0.04;
      expect(factor * 0.1 + factor ** 2 / 2).toBeLessThanOrEqual(left);
      expect(factor).toBeGreaterThan(last);
      last = factor;
    }
    expect(standing(wall(1.5)).bound(go(1), 1010).factor).toBe(1);
    // Slowly, it may come nearer.
    expect(standing(wall(0.9)).bound(go(0.3), 1010).factor).toBe(1);
  });

  test('brakes as hard as it can if something is suddenly near, until it has become slow', () => {
    const guard = standing(wall(0.55), DISC, go(1));
    expect(guard.bound(go(1), 1010)).toEqual({ factor: 0, reason: 'obstacle', urgent: true });
    // From 0.55 m/s it could stop within three quarters of the way: it need not begin to brake, and must not end.
    expect(standing(wall(0.55), DISC, go(0.55)).bound(go(1), 1010).urgent).toBe(false);
    guard.moved({ x: 0, y: 0, yaw: 0 }, go(0.55), 1020);
    expect(guard.bound(go(1), 1020).factor).toBe(0);
    // From 0.5 m/s, within two thirds.
    guard.moved({ x: 0, y: 0, yaw: 0 }, go(0.5), 1030);
    expect(guard.bound(go(1), 1030)).toMatchObject({ reason: 'obstacle-near', urgent: false });
  });

  test('stops before an obstacle, lets the robot turn and back out', () => {
    const guard = standing(wall(0.32));
    expect(guard.bound(go(1), 1010)).toEqual({ factor: 0, reason: 'obstacle', urgent: true });
    expect(guard.bound(go(0.05), 1010).factor).toBe(0);
    expect(guard.bound(go(0, 1), 1010).factor).toBe(1);
    expect(guard.bound(go(-0.5), 1010).factor).toBe(1);
    expect(guard.bound(go(-0.5, 0.4), 1010).factor).toBe(1);
  });

  test('lets a stopped robot go again where it may go at 0.1 m/s, not because of a centimetre', () => {
    const at = (guard: ObstacleGuard, x: number, ms: number) => {
      guard.moved({ x, y: 0, yaw: 0 }, zeroTwist(), ms);
      return guard.bound(go(1), ms).factor;
    };
    const guard = standing(wall(0.3));
    expect(guard.bound(go(1), 1010).factor).toBe(0);
    // Where another robot would go at 0.06 m/s, it stays.
    expect(at(standing(wall(0.3)), -0.1, 1020)).toBeCloseTo(0.06);
    expect([at(guard, -0.1, 1020), at(guard, 0.01, 1030), at(guard, -0.12, 1040)]).toEqual([0, 0, 0]);
    expect(at(guard, -0.14, 1050)).toBeCloseTo(0.12);
  });

  test.each([0.2, 0.25, 0.8])(
    'goes at 0.2 m/s into a door that leaves 13 cm at each side, asked for %f',
    (asked) => {
      const door = floor().paint('occupied', 0.15, 0.25, 0.38, 2).paint('occupied', 0.15, 0.25, -2, -0.38);
      expect(standing(door).bound(go(asked), 1010).factor * asked).toBeCloseTo(0.2);
    },
  );

  test.each([
    [0.015, 'stops', { kind: 'thing', metres: 0 }],
    [0.035, 'goes', null],
  ])(
    'what is 5 cm inside its outline is the robot itself: with an edge %f m farther, it %s',
    (x, expected, hit) => {
      const guard = new ObstacleGuard(LONG, 1);
      guard.moved({ x, y: 0, yaw: 0 }, zeroTwist(), 1000);
      // Its middle is at 0.575 m, the outline's edge at 0.6 m and x.
      guard.see(0, floor().paint('occupied', 0.55, 0.6, 0, 0.05));
      expect(guard.bound(go(0.5), 1010).factor > 0 ? 'goes' : 'stops').toBe(expected);
      expect(guard.nearField(1010)?.[0]?.hit).toEqual(hit);
    },
  );

  test('lets the robot go along a wall, and out of a narrow passage', () => {
    const beside = floor().paint('occupied', -4, 4, 0.3, 1).paint('occupied', -4, 4, -1, -0.3);
    const guard = standing(beside);
    expect(guard.bound(go(0.2), 1010).factor).toBeGreaterThan(0.9);
    expect(guard.bound(go(-0.2), 1010).factor).toBeGreaterThan(0.9);
    const passage = standing(floor().paint('occupied', -4, 4, 0.45, 1).paint('occupied', -4, 4, -1, -0.45));
    expect(passage.bound(go(0.8), 1010).factor).toBe(1);
  });

  test('follows the arc', () => {
    // Something ahead on the left.
    const guard = standing(floor().paint('occupied', 0.45, 0.8, 0.4, 0.8));
    expect(guard.bound(go(0.6), 1010).factor).toBe(1);
    expect(guard.bound(go(0.6, -1), 1010).factor).toBe(1);
    expect(guard.bound(go(0.6, 0.9), 1010).reason).toBe('obstacle-near');
  });

  test('sweeps a long robot’s corners as it turns on the spot', () => {
    const guard = standing(floor().paint('occupied', 0.3, 0.7, 0.5, 0.9), LONG);
    expect(guard.bound(go(0, 1.5), 1010).reason).toBe('obstacle-near');
    expect(guard.bound(go(0, -1.5), 1010).factor).toBe(1);
    const beside = standing(floor().paint('occupied', 0.3, 0.7, 0.25, 0.9), LONG);
    expect(beside.bound(go(0, 1), 1010)).toMatchObject({ factor: 0, reason: 'obstacle' });
    expect(beside.bound(go(0, -1), 1010).factor).toBe(1);
  });

  test('keeps the whole margin to a missing floor also when it creeps, and only lets the robot go away from it', () => {
    // Nearer than the margin, straight ahead and beside.
    const ahead = standing(floor().paint('dropOff', 0.38, 0.8, -1, 1));
    expect(ahead.bound(go(0.15), 1010)).toMatchObject({ factor: 0, reason: 'drop-off' });
    expect(standing(wall(0.38)).bound(go(0.15), 1010).factor).toBeGreaterThan(0);
    for (const wish of [go(-0.3), go(0, 1), go(0, -1)]) expect(ahead.bound(wish, 1010).factor).toBe(1);
    const beside = standing(floor().paint('dropOff', -4, 4, 0.36, 1));
    expect(beside.bound(go(0.3, 0.3), 1010)).toMatchObject({ factor: 0, reason: 'drop-off' });
    expect(beside.bound(go(0.2, -1), 1010).factor).toBeGreaterThan(0);
  });

  test('is slow towards where nobody sees, and lets the robot come there at a fitting speed', () => {
    const near = standing(floor().paint('unknown', 0.4, 4, -2, 2)).bound(go(1), 1010);
    expect(near).toEqual({ factor: 0.3, reason: 'unseen-space', urgent: false });
    const far = standing(floor().paint('unknown', 0.9, 4, -2, 2)).bound(go(1), 1010);
    expect(far.reason).toBe('unseen-space');
    expect(far.factor).toBeGreaterThan(0.3);
    expect(standing(floor().paint('unknown', 0.4, 4, -2, 2)).bound(go(0.2), 1010).factor).toBe(1);
  });

  test('is slow when a sensor or odometry falls silent, and before the first cloud', () => {
    const guard = standing(floor());
    expect(guard.bound(go(1), 1200).factor).toBe(1);
    guard.moved({ x: 0, y: 0, yaw: 0 }, zeroTwist(), 1400);
    expect(guard.bound(go(1), 1401)).toEqual({ factor: 0.3, reason: 'sensor-silent', urgent: false });
    expect([guard.blind(1400), guard.blind(1401)]).toEqual([false, true]);
    const still = new PaintedGrid(1800);
    guard.see(0, still);
    expect(guard.bound(go(1), 1810).reason).toBe('sensor-silent');
    const none = new ObstacleGuard(DISC, 1);
    expect(none.blind(0)).toBe(true);
    expect(none.bound(go(1), 0)).toMatchObject({ factor: 0.3, urgent: false });
  });

  test('one silent sensor of two is enough to be slow', () => {
    const guard = new ObstacleGuard(DISC, 2);
    guard.moved({ x: 0, y: 0, yaw: 0 }, zeroTwist(), 1000);
    guard.see(0, floor());
    expect(guard.bound(go(1), 1010).reason).toBe('sensor-silent');
    guard.see(1, new PaintedGrid(1001).paint('unknown', -4, 4, -4, 4));
    expect(guard.bound(go(1), 1010).factor).toBe(1);
    expect(guard.blind(1010)).toBe(false);
  });

  test('of clouds of the same age, the obstacle counts; otherwise the newer one', () => {
    for (const grids of [
      [floor(), wall(0.32)],
      [wall(0.32), floor()],
    ] as const) {
      const guard = new ObstacleGuard(DISC, 2);
      guard.moved({ x: 0, y: 0, yaw: 0 }, zeroTwist(), 1000);
      for (const [sensor, grid] of grids.entries()) guard.see(sensor, grid);
      expect(guard.bound(go(1), 1010).factor).toBe(0);
      guard.see(0, new PaintedGrid(1005));
      guard.see(1, new PaintedGrid(1001).paint('occupied', 0.32, 4, -2, 2));
      expect(guard.bound(go(1), 1010).factor).toBe(1);
    }
  });

  test('remembers what came too near to be seen, where it was', () => {
    const guard = standing(floor().paint('occupied', 0.8, 0.9, -0.3, 0.3));
    const see = (ms: number, x: number) => {
      guard.moved({ x, y: 0, yaw: 0 }, zeroTwist(), ms);
      guard.see(0, new PaintedGrid(ms, x).paint('unknown', x - 4, x + 0.75, -4, 4));
    };
    see(1100, 0.2);
    see(2100, 0.48);
    expect(guard.bound(go(0.5), 2110)).toMatchObject({ factor: 0, reason: 'obstacle' });
    expect(guard.bound(go(-0.5), 2110).reason).not.toBe('obstacle');
    // Not for ever: then it is a place that nobody sees.
    see(21_100, 0.48);
    expect(guard.bound(go(0.5), 21_110)).toEqual({ factor: 0.6, reason: 'unseen-space', urgent: false });
  });

  describe('with a laser scanner beside the camera', () => {
    const nothing = (ms: number) => new PaintedGrid(ms).paint('unknown', -4, 4, -4, 4);
    const withScanner = (options = {}) => {
      const guard = new ObstacleGuard(DISC, 2, { planes: 1, ...options });
      guard.moved({ x: 0, y: 0, yaw: 0 }, zeroTwist(), 1000);
      return guard;
    };

    test('either of them stops the robot, whatever the other says, and however new that is', () => {
      for (const sensor of [0, 1]) {
        const guard = withScanner();
        guard.see(sensor, wall(0.32));
        guard.see(1 - sensor, new PaintedGrid(1050));
        expect(guard.bound(go(1), 1060)).toMatchObject({ factor: 0, reason: 'obstacle' });
        // Each takes away what it has itself seen.
        guard.see(sensor, new PaintedGrid(1100));
        guard.moved({ x: 0, y: 0, yaw: 0 }, zeroTwist(), 1100);
        expect(guard.bound(go(1), 1110).factor).toBe(1);
      }
    });

    test('a hole that the camera sees stays one', () => {
      const guard = withScanner({ planesShowFloor: true });
      guard.see(0, floor().paint('dropOff', 0.32, 0.6, -1, 1));
      guard.see(1, new PaintedGrid(1050));
      expect(guard.bound(go(0.5), 1060)).toMatchObject({ factor: 0, reason: 'drop-off' });
    });

    test('what the scanner passes over is unseen floor, unless it is configured to be trusted', () => {
      for (const trusted of [false, true]) {
        const guard = withScanner({ planesShowFloor: trusted });
        guard.see(0, nothing(1000));
        guard.see(1, floor());
        const bound = guard.bound(go(1), 1010);
        expect([bound.factor, bound.reason]).toEqual(trusted ? [1, null] : [0.3, 'unseen-space']);
      }
    });

    test('a scanner in another frame than the clouds is silent, and takes nothing away', () => {
      const guard = withScanner();
      guard.see(0, wall(0.32));
      const scan = new PaintedGrid(1010);
      scan.placed = false;
      guard.see(1, scan);
      expect(guard.bound(go(1), 1020)).toMatchObject({ factor: 0, reason: 'obstacle' });
      expect(guard.sensors(1020)[1]?.silent).toBe(true);
      // Without clouds, it is all that there is.
      scan.capturedAtMs = 1500;
      guard.see(1, scan);
      expect(guard.sensors(1510)[1]?.silent).toBe(false);
    });

    test('its silence is that of a sensor', () => {
      const guard = withScanner();
      guard.see(0, new PaintedGrid(1400));
      guard.see(1, floor());
      guard.moved({ x: 0, y: 0, yaw: 0 }, zeroTwist(), 1400);
      expect(guard.bound(go(1), 1401)).toMatchObject({ factor: 0.3, reason: 'sensor-silent' });
      expect(guard.sensors(1401)).toEqual([
        { ageMs: 1, silent: false },
        { ageMs: 401, silent: true },
      ]);
      expect(guard.odometryAgeMs(1401)).toBe(1);
    });
  });

  test('without odometry, the age of what it knows counts as travel', () => {
    const guard = new ObstacleGuard(DISC, 1);
    const seen = wall(0.6);
    seen.placed = false;
    for (let ms = 0; ms <= 1000; ms += 20) guard.bound(zeroTwist(), ms);
    guard.see(0, seen);
    const first = guard.bound(go(1), 1010);
    const later = guard.bound(go(1), 1200);
    expect([first.reason, later.reason]).toEqual(['obstacle-near', 'obstacle-near']);
    expect(later.factor).toBeLessThan(first.factor - 0.05);
  });

  test('without odometry, a floor that was seen more than 0.1 m ago is not known any more', () => {
    const guard = new ObstacleGuard(DISC, 1);
    const seen = floor();
    seen.placed = false;
    guard.see(0, seen);
    expect(guard.bound(go(1), 1010).factor).toBe(1);
    expect(guard.bound(go(1), 1200)).toEqual({ factor: 0.3, reason: 'unseen-space', urgent: false });
  });

  test('looks where the robot is by now', () => {
    const guard = standing(wall(1.05), DISC, go(1));
    expect(guard.bound(go(1), 1000).factor).toBe(1);
    expect(guard.bound(go(1), 1290).factor).toBeLessThan(1);
  });

  test('stops for a wish that is no number', () => {
    expect(standing(floor()).bound(go(Number.NaN), 1010).factor).toBe(0);
    expect(standing(floor()).bound(go(Number.POSITIVE_INFINITY), 1010).factor).toBe(0);
  });
});

describe('whatever it has seen', () => {
  const speed = fc.double({ min: -2, max: 2, noNaN: true });
  const rectangle = fc.record({
    kind: fc.constantFrom('unknown', 'occupied', 'dropOff', 'free'),
    x: fc.double({ min: -3, max: 3, noNaN: true }),
    y: fc.double({ min: -3, max: 3, noNaN: true }),
    size: fc.double({ min: 0.05, max: 2, noNaN: true }),
  });
  const cases = fc.record({
    rectangles: fc.array(rectangle, { maxLength: 6 }),
    wishes: fc.array(fc.tuple(speed, speed), { minLength: 1, maxLength: 6 }),
    now: fc.tuple(speed, speed),
    footprint: fc.constantFrom(DISC, LONG),
    ms: fc.integer({ min: 0, max: 2000 }),
  });
  const painted = (rectangles: readonly { kind: string; x: number; y: number; size: number }[]) => {
    const grid = floor();
    for (const { kind, x, y, size } of rectangles) {
      grid.paint(kind as keyof typeof floorClasses, x, x + size, y, y + size);
    }
    return grid;
  };

  test('it answers with a share, and with a reason if and only if it takes something away', () => {
    fc.assert(
      fc.property(cases, ({ rectangles, wishes, now, footprint, ms }) => {
        const guard = standing(painted(rectangles), footprint, go(...now));
        for (const wish of wishes) {
          const { factor, reason, urgent } = guard.bound(go(...wish), 1000 + ms);
          expect(factor).toBeGreaterThanOrEqual(0);
          expect(factor).toBeLessThanOrEqual(1);
          expect(reason === null).toBe(factor === 1);
          expect(urgent).toBe(factor === 0);
        }
      }),
      longProperty(11, 400),
    );
  });

  test('however it is driven for a while, the robot keeps away from a missing floor', () => {
    const arc = fc.tuple(fc.double({ min: -1, max: 1, noNaN: true }), speed);
    const holes = fc.array(rectangle, { minLength: 1, maxLength: 3 });
    fc.assert(
      fc.property(holes, fc.array(arc, { minLength: 4, maxLength: 8 }), (rectangles, arcs) => {
        const edges = rectangles.map((each) => ({ ...each, kind: 'dropOff' }));
        const grid = painted(edges).paint('free', -0.6, 0.6, -0.6, 0.6);
        const guard = standing(grid);
        let [x, y, yaw] = [0, 0, 0];
        let nearest = Number.POSITIVE_INFINITY;
        const missing: [number, number][] = [];
        grid.classes.forEach((known, at) => {
          if (known === floorClasses.dropOff)
            missing.push([((at % 160) - 79.5) * 0.05, (Math.floor(at / 160) - 79.5) * 0.05]);
        });
        arcs.forEach(([v, w], i) => {
          for (let k = 0; k < 50; k++) {
            const ms = 1000 + (i * 50 + k) * 20;
            guard.moved({ x, y, yaw }, zeroTwist(), ms);
            grid.capturedAtMs = ms;
            guard.see(0, grid);
            const { factor } = guard.bound(go(v, w), ms);
            x += v * factor * 0.02 * Math.cos(yaw);
            y += v * factor * 0.02 * Math.sin(yaw);
            yaw += w * factor * 0.02;
          }
          for (const [dx, dy] of missing) nearest = Math.min(nearest, Math.hypot(dx - x, dy - y) - 0.25);
        });
        // To the middle of a cell, which is up to 3.5 cm from its edge.
        expect(nearest).toBeGreaterThan(0.12);
      }),
      longProperty(13, 60, { share: shareInEachRun(1 / 6) }),
    );
  });

  test('what it allows ends before an obstacle: reaction and braking bring the robot nowhere it must not be', () => {
    fc.assert(
      fc.property(cases, ({ rectangles, wishes: [wish = [0, 0] as [number, number]], footprint }) => {
        // Nothing within the margin at the start: there, only the direction counts.
        const grid = painted(rectangles).paint('free', -0.9, 0.9, -0.9, 0.9);
        const { factor } = standing(grid, footprint).bound(go(...wish), 1000);
        const [v, w] = wish.map((part) => part * factor) as [number, number];
        // 0.1 s at that velocity, then braking at 1 m/s² and 2 rad/s², on the same arc.
        const scaleS = 0.1 + Math.max(Math.abs(v), Math.abs(w) / 2) / 2;
        let [x, y, yaw] = [0, 0, 0];
        for (let k = 0; k < 200; k++) {
          x += ((v * scaleS) / 200) * Math.cos(yaw);
          y += ((v * scaleS) / 200) * Math.sin(yaw);
          yaw += (w * scaleS) / 200;
        }
        const hit = grid.classes.findIndex((known, at) => {
          if (known < floorClasses.occupied) return false;
          const [dx, dy] = [((at % 160) - 79.5) * 0.05 - x, (Math.floor(at / 160) - 79.5) * 0.05 - y];
          const [px, py] = [dx * Math.cos(yaw) + dy * Math.sin(yaw), dy * Math.cos(yaw) - dx * Math.sin(yaw)];
          return footprint.nearness(px, py, { distance: 0, x: 0, y: 0 }).distance < 0;
        });
        expect(hit).toBe(-1);
      }),
      longProperty(12, 300),
    );
  });
});
