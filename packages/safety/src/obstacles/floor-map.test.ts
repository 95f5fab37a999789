import fc from 'fast-check';
import { expect, test } from 'vitest';
import { LAYER_SIDE } from './floor-layer.ts';
import { FloorMap } from './floor-map.ts';

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
