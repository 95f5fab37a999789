import fc from 'fast-check';
import { expect, test } from 'vitest';
import { decodeJson, encodeJson } from './json.ts';
import {
  MAP_TILE,
  MAX_MAP_SIDE,
  type MapTiles,
  mapCells,
  tileCount,
  tileExtent,
  tileRuns,
  writeTile,
} from './map-tiles.ts';
import { telemetryCodec } from './telemetry.ts';

const side = fc.integer({ min: 1, max: 80 });
/** Maps of a few tiles, with long runs and with short ones. */
const map = fc
  .tuple(side, side, fc.integer({ min: 1, max: 200 }), fc.nat())
  .map(([width, height, run, seed]) => ({
    ...{ width, height },
    cells: Uint8Array.from(
      { length: width * height },
      (_, i) => (Math.floor(i / run) + seed) % mapCells.length,
    ),
  }));
const message = (size: { width: number; height: number }, tiles: MapTiles['tiles']): MapTiles => ({
  ...{ type: 'map', topic: '/map', number: 1, timeMs: 5, ageMs: 0, cellM: 0.05 },
  ...{ width: size.width, height: size.height },
  origin: { x: 0, y: 0, yaw: 0 },
  tiles,
});

test('the tiles of a map, each in a message of its own, make the map again', () => {
  fc.assert(
    fc.property(map, ({ cells, ...size }) => {
      const read = new Uint8Array(cells.length).fill(255);
      for (let index = 0; index < tileCount(size); index++) {
        const text = encodeJson(telemetryCodec, message(size, [[index, tileRuns(size, index, cells)]]));
        const told = decodeJson(telemetryCodec, text);
        if (told.type !== 'map') throw new Error(told.type);
        for (const [at, runs] of told.tiles) writeTile(told, at, runs, read);
      }
      expect(read).toEqual(cells);
    }),
    { seed: 1, numRuns: 100 },
  );
});

test('tiles cover each cell once', () => {
  fc.assert(
    fc.property(side, side, (width, height) => {
      const seen = new Uint8Array(width * height);
      for (let index = 0; index < tileCount({ width, height }); index++) {
        const tile = tileExtent({ width, height }, index);
        for (let y = tile.y; y < tile.y + tile.height; y++)
          for (let x = tile.x; x < tile.x + tile.width; x++) seen[y * width + x]!++;
      }
      expect(seen.every((times) => times === 1)).toBe(true);
    }),
    { seed: 2, numRuns: 50 },
  );
});

test('a tile of the worst cells fits a message, and one of equal cells takes 16 bytes', () => {
  const size = { width: MAX_MAP_SIDE, height: MAX_MAP_SIDE };
  const cells = Uint8Array.from({ length: MAX_MAP_SIDE ** 2 }, (_, i) => i % mapCells.length);
  const text = encodeJson(telemetryCodec, message(size, [[255, tileRuns(size, 255, cells)]]));
  expect(decodeJson(telemetryCodec, text)).toMatchObject({ type: 'map' });
  expect(atob(tileRuns(size, 0, cells)).length).toBe(MAP_TILE ** 2);
  expect(atob(tileRuns(size, 0, cells.fill(3))).length).toBe(16);
});

test('runs that do not have exactly the cells of their tile are refused', () => {
  const size = { width: 40, height: 33 };
  fc.assert(
    fc.property(fc.nat(5), fc.uint8Array({ maxLength: 40, size: 'max' }), (index, bytes) => {
      const runs = btoa(String.fromCharCode(...bytes));
      const read = () =>
        decodeJson(telemetryCodec, encodeJson(telemetryCodec, message(size, [[index, runs]])));
      const cells = bytes.reduce((sum, byte) => sum + (byte % 64) + 1, 0);
      const { width, height } = index < tileCount(size) ? tileExtent(size, index) : { width: 0, height: 1 };
      if (width > 0 && cells === width * height) read();
      else expect(read).toThrow('tiles');
    }),
    { seed: 3, numRuns: 500 },
  );
});
