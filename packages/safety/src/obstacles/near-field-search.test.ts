import { longProperty } from '@farpoint/network-sim/cases';
import { NEAR_REACH_M, NEAR_SECTORS, NEAR_UNSEEN_M, type NearSector, zeroTwist } from '@farpoint/protocol';
import fc from 'fast-check';
import { expect, test } from 'vitest';
import { Footprint, type Nearness } from './footprint.ts';
import { ObstacleGuard } from './obstacle-guard.ts';
import { PaintedGrid } from './testing/painted-grid.ts';

const DISC = Footprint.disc(0.25);
const CELL_M = 0.05;

/** The near field of a robot that stands there and has seen this. */
function around(grid: PaintedGrid, { x = 0, y = 0, yaw = 0 } = {}, footprint = DISC): NearSector[] {
  const guard = new ObstacleGuard(footprint, 1);
  guard.moved({ x, y, yaw }, zeroTwist(), 1000);
  guard.see(0, grid);
  const sectors = guard.nearField(1010);
  expect(sectors).toHaveLength(NEAR_SECTORS);
  return sectors ?? [];
}

const floor = (x = 0, y = 0) => new PaintedGrid(1000, x, y);
/** The middle of the cell in which a coordinate lies. */
const middleOf = (metres: number) => (Math.floor(metres / CELL_M) + 0.5) * CELL_M;
const named = (degrees: number) => (Math.round(degrees / 5) + NEAR_SECTORS) % NEAR_SECTORS;

test('where the floor is free all around, nothing is near and nothing unseen', () => {
  for (const sector of around(floor())) expect(sector).toEqual({ hit: null, unseen: null });
});

test('a thing is in its direction, and as far from the footprint’s edge as it is', () => {
  const sectors = around(floor().paint('occupied', 0.55, 0.65, -0.05, 0.05));
  // A cell is as wide as a sector or wider: the thing is in those into which it reaches.
  const hit = sectors.flatMap(({ hit }, i) => (hit === null ? [] : [i]));
  expect(hit).toEqual([0, 1, 71]);
  expect(sectors[0]?.hit?.kind).toBe('thing');
  expect(sectors[0]?.hit?.metres).toBeCloseTo(0.3, 1.5);
  expect(sectors.every(({ unseen }) => unseen === null)).toBe(true);
});

test('directions are those of the robot, wherever it stands and looks', () => {
  // It looks along +y: what lies at -x is to its left.
  const sectors = around(floor(5, 2).paint('dropOff', 4, 4.2, 1.9, 2.1), { x: 5, y: 2, yaw: Math.PI / 2 });
  expect(sectors[named(90)]?.hit?.kind).toBe('drop');
  expect(sectors[named(90)]?.hit?.metres).toBeCloseTo(0.55, 1.5);
  expect(sectors[named(0)]?.hit).toBe(null);
});

test('a long robot’s distances are those from its edge', () => {
  const long = new Footprint([
    { x: 0.6, y: 0.2 },
    { x: -0.2, y: 0.2 },
    { x: -0.2, y: -0.2 },
    { x: 0.6, y: -0.2 },
  ]);
  const wall = floor().paint('occupied', 0.9, 1, -4, 4).paint('occupied', -4, 4, 0.8, 0.9);
  const sectors = around(wall, {}, long);
  expect(sectors[named(0)]?.hit?.metres).toBeCloseTo(0.3, 1.5);
  expect(sectors[named(90)]?.hit?.metres).toBeCloseTo(0.6, 1.5);
});

/** A stretch that is told is as long as the true one, or a cell longer at either end. */
function expectAbout(told: NearSector['unseen'] | undefined, fromM: number, toM: number): void {
  expect(told?.fromM).toBeLessThan(fromM + 0.001);
  expect(told?.fromM).toBeGreaterThan(fromM - 1.2 * CELL_M);
  expect(told?.toM).toBeGreaterThan(toM - 0.01);
  expect(told?.toM).toBeLessThan(toM + 1.2 * CELL_M);
}

test('unseen floor is told from where to where it is, also before a thing, but not under the robot', () => {
  const sectors = around(
    floor()
      .paint('unknown', -0.2, 0.2, -0.2, 0.2)
      .paint('unknown', 0.4, 1, -1, 1)
      .paint('occupied', 1.4, 1.6, -1, 1),
  );
  expectAbout(sectors[0]?.unseen, 0.15, 0.75);
  expect(sectors[0]?.hit?.metres).toBeCloseTo(1.15, 1.5);
  expect(sectors[named(180)]).toEqual({ hit: null, unseen: null });
});

test('gaps in an unseen stretch do not end it; what is seen for longer does', () => {
  const striped = (gapM: number) =>
    around(
      floor()
        .paint('unknown', 0.5, 0.8, -3, 3)
        .paint('unknown', 0.8 + gapM, 1.2, -3, 3),
    )[0]?.unseen;
  expectAbout(striped(0.1), 0.25, 0.95);
  expectAbout(striped(0.35), 0.25, 0.55);
});

test('where nothing is seen, all of it is told as far as unseen floor is told', () => {
  const [sector] = around(floor().paint('unknown', -4, 4, -4, 4).paint('free', -4, -3.9, -4, -3.9));
  expect(sector).toEqual({ hit: null, unseen: { fromM: 0, toM: NEAR_UNSEEN_M } });
});

test('nothing is told while no sensor sees, and while odometry is silent', () => {
  const guard = new ObstacleGuard(DISC, 1);
  expect(guard.nearField(1000)).toBe(null);
  guard.moved({ x: 0, y: 0, yaw: 0 }, zeroTwist(), 1000);
  expect(guard.nearField(1000)).toBe(null);
  guard.see(0, floor());
  expect(guard.nearField(1010)).not.toBe(null);
  expect(guard.nearField(1301)).toBe(null);
  guard.moved({ x: 0, y: 0, yaw: 0 }, zeroTwist(), 1400);
  expect(guard.nearField(1401)).toBe(null);
});

test('without odometry, a thing may be nearer by as much as the robot has gone', () => {
  const guard = new ObstacleGuard(DISC, 1);
  const grid = floor().paint('occupied', 1, 1.2, -1, 1);
  grid.placed = false;
  guard.see(0, grid);
  const wish = zeroTwist();
  wish.linear.x = 0.2;
  guard.bound(wish, 1000);
  const metres = (nowMs: number) => guard.nearField(nowMs)?.[0]?.hit?.metres ?? Number.NaN;
  const before = metres(1000);
  expect(before).toBeCloseTo(0.75, 1.5);
  expect(before - metres(1300)).toBeCloseTo(0.06, 2);
});

test('asking for it changes no decision', () => {
  const made = () => {
    const guard = new ObstacleGuard(DISC, 1);
    guard.moved({ x: 0, y: 0, yaw: 0 }, zeroTwist(), 1000);
    guard.see(0, floor().paint('occupied', 0.7, 4, -2, 2));
    return guard;
  };
  const [asked, other] = [made(), made()];
  const wish = zeroTwist();
  wish.linear.x = 1;
  for (let ms = 1000; ms < 1300; ms += 20) {
    asked.nearField(ms);
    expect(asked.bound(wish, ms)).toEqual(other.bound(wish, ms));
  }
});

test('any lone cell is told in its direction, within a cell of its distance; none is missed', () => {
  const near: Nearness = { distance: 0, x: 0, y: 0 };
  const place = fc.double({ min: -2.2, max: 2.2, noNaN: true });
  fc.assert(
    fc.property(
      place,
      place,
      fc.constantFrom('occupied', 'dropOff', 'unknown'),
      fc.double({ min: -3, max: 3, noNaN: true }),
      (px, py, kind, yaw) => {
        const [x, y] = [middleOf(px), middleOf(py)];
        const { distance } = DISC.nearness(x, y, near);
        fc.pre(distance > CELL_M && distance < NEAR_UNSEEN_M - CELL_M);
        const grid = floor().paint(kind, x - 0.01, x + 0.01, y - 0.01, y + 0.01);
        const sectors = around(grid, { yaw });
        const degrees = ((Math.atan2(y, x) - yaw) * 180) / Math.PI;
        const { hit, unseen } = sectors[named((degrees + 720) % 360)] as NearSector;
        const told = (kind === 'unknown' ? unseen?.fromM : hit?.metres) ?? Number.NaN;
        expect(Math.abs(told - distance)).toBeLessThan(2 * CELL_M);
        expect(hit?.kind).toBe({ occupied: 'thing', dropOff: 'drop', unknown: undefined }[kind]);
      },
    ),
    longProperty(1, 60),
  );
});

test('nothing beyond the reach is told', () => {
  const far = 0.25 + NEAR_REACH_M + 0.2;
  const sectors = around(floor().paint('occupied', far, 4, -4, 4));
  expect(sectors[0]).toEqual({ hit: null, unseen: null });
});
