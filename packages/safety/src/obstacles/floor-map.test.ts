import fc from 'fast-check';
import { expect, test } from 'vitest';
import { LAYER_SIDE } from './floor-layer.ts';
import { FloorMap } from './floor-map.ts';
import { floorClasses } from './sensor-grid.ts';
import { PaintedGrid } from './testing/painted-grid.ts';

const SIDE = 12;
const MEMORY = { freeMemoryMs: 800, occupiedMemoryMs: 2000, freeMemoryM: 0.3 };

const grid = fc.record({
  classes: fc.uint8Array({ minLength: SIDE * SIDE, maxLength: SIDE * SIDE, max: 3 }),
  firstX: fc.integer({ min: -10, max: 10 }),
  firstY: fc.integer({ min: -10, max: 10 }),
  capturedAtMs: fc.integer({ min: 0, max: 1000 }),
  plane: fc.constantFrom(null, 0, 1),
});

test('a rectangle that is read at once says of each cell what the cell says', () => {
  fc.assert(
    fc.property(
      fc.array(grid, { maxLength: 5 }),
      fc.record({
        left: fc.oneof(fc.integer({ min: -12, max: 4 }), fc.constant(LAYER_SIDE / 2 - 5)),
        low: fc.integer({ min: -12, max: 4 }),
        width: fc.integer({ min: 1, max: 15 }),
        height: fc.integer({ min: 1, max: 15 }),
      }),
      fc.record({ planes: fc.constantFrom(0, 2), planesShowFloor: fc.boolean() }),
      fc.boolean(),
      fc.integer({ min: 0, max: 2500 }),
      (grids, cells, options, placed, nowMs) => {
        const map = new FloorMap({ ...MEMORY, ...options, cellM: 0.05 });
        for (const { plane, ...each } of grids)
          map.merge({ ...each, side: SIDE, cellM: 0.05, placed }, 0.2, plane);
        const travel = 0.4;
        const read = new Uint8Array(cells.width * cells.height);
        map.read(cells, nowMs, travel, read);
        for (let row = 0; row < cells.height; row++) {
          for (let column = 0; column < cells.width; column++) {
            const cell = map.classAt(cells.left + column, cells.low + row, nowMs, travel);
            expect(read[row * cells.width + column]).toBe(cell);
          }
        }
      },
    ),
  );
});

test('a grid says the same wherever it lies in memory, also where little of it is known', () => {
  const side = LAYER_SIDE + 8;
  const cells = fc.array(fc.record({ at: fc.nat(side * side - 1), known: fc.constantFrom(1, 2, 3) }));
  fc.assert(
    fc.property(
      cells,
      fc.integer({ min: -9, max: 9 }),
      fc.nat(3),
      fc.nat(3),
      (known, first, offset, other) => {
        const [one, two] = [offset, other].map((byteOffset) => {
          const classes = new Uint8Array(new ArrayBuffer(side * side + 4), byteOffset, side * side);
          for (const cell of known) classes[cell.at] = cell.known;
          const map = new FloorMap({ ...MEMORY, cellM: 0.05 });
          const at = { firstX: first - side / 2, firstY: -first - side / 2 };
          map.merge({ classes, ...at, side, cellM: 0.05, placed: true, capturedAtMs: 0 }, 0);
          return known.map(({ at: cell }) =>
            map.classAt(at.firstX + (cell % side), at.firstY + Math.floor(cell / side), 0, 0),
          );
        }) as [number[], number[]];
        expect(one).toEqual(two);
        const last = new Map(known.map((cell) => [cell.at, cell.known]));
        const isKept = (cell: number) => {
          const [x, y] = [first - side / 2 + (cell % side), -first - side / 2 + Math.floor(cell / side)];
          return Math.min(x, y) >= -LAYER_SIDE / 2 && Math.max(x, y) < LAYER_SIDE / 2;
        };
        expect(one).toEqual(known.map(({ at }) => (isKept(at) ? last.get(at) : floorClasses.unknown)));
      },
    ),
  );
});

test.each([
  ['the floor below it', 10, 'occupied'],
  ['as much as stood there', 40, 'free'],
  ['more', 60, 'free'],
])('what stands in a cell stays there until a sensor sees it gone: %s', (_, seen, expected) => {
  const map = new FloorMap({ ...MEMORY, cellM: 0.05 });
  map.merge(new PaintedGrid(1000).high(40).paint('occupied', 1, 2, -1, 1), 0);
  map.merge(new PaintedGrid(1050).high(seen), 0);
  const classAt = (nowMs: number) => map.classAt(map.cellOf(1.5), map.cellOf(0), nowMs, 0);
  expect(classAt(1100)).toBe(floorClasses[expected as keyof typeof floorClasses]);
  // It is remembered since it was seen, not since its floor was.
  if (expected === 'occupied') expect(classAt(1000 + MEMORY.occupiedMemoryMs + 1)).toBe(floorClasses.unknown);
});

test('what stands in a cell counts as low as it was ever seen to stand, and a sensor without heights sees all of it', () => {
  const map = new FloorMap({ ...MEMORY, cellM: 0.05 });
  const stands = (atMs: number, height: number) =>
    map.merge(new PaintedGrid(atMs).high(height).paint('occupied', 1, 2, -1, 1), 0);
  const classAt = (nowMs: number) => map.classAt(map.cellOf(1.5), map.cellOf(0), nowMs, 0);
  stands(1000, 12);
  stands(1010, 40);
  map.merge(new PaintedGrid(1020).high(12), 0);
  expect(classAt(1030)).toBe(floorClasses.free);
  // What came later is something else.
  stands(1040, 40);
  map.merge(new PaintedGrid(1050).high(12), 0);
  expect(classAt(1060)).toBe(floorClasses.occupied);
  map.merge(new PaintedGrid(1070), 0);
  expect(classAt(1080)).toBe(floorClasses.free);
});
