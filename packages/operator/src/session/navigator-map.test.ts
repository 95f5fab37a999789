import { type MapTiles, tileCount, tileRuns } from '@farpoint/protocol';
import { beforeEach, expect, test } from 'vitest';
import { NavigatorMap } from './navigator-map.ts';

const SIZE = { width: 40, height: 33 };
const cells = (state: number) => new Uint8Array(SIZE.width * SIZE.height).fill(state);

/** The tiles of a map whose cells are all in one state. */
function tiles(state: number, indices: number[], change: Partial<MapTiles> = {}): MapTiles {
  return {
    ...{ type: 'map', topic: '/map', number: 1, timeMs: 100, ageMs: 0, ...SIZE, cellM: 0.1 },
    origin: { x: 0, y: 0, yaw: 0 },
    tiles: indices.map((index) => [index, tileRuns(SIZE, index, cells(state))]),
    ...change,
  };
}

let map: NavigatorMap;
beforeEach(() => {
  map = new NavigatorMap();
});

test('tiles come one by one; what is not told yet is unknown', () => {
  expect(tileCount(SIZE)).toBe(4);
  expect(map.ageMs(0)).toBe(null);
  expect(map.take(tiles(3, [0]), 10)).toBe(true);
  expect(map.cells[0]).toBe(3);
  expect(map.cells[39]).toBe(0);
  expect(map.take(tiles(3, [1, 2, 3]), 20)).toBe(true);
  expect(map.cells).toEqual(cells(3));
  expect(map.changes).toBe(2);
});

test('a tile that is repeated or was overtaken changes nothing', () => {
  map.take(tiles(3, [0, 1, 2, 3], { timeMs: 200 }), 10);
  expect(map.take(tiles(3, [0], { timeMs: 200 }), 1010)).toBe(false);
  expect(map.take(tiles(1, [0], { timeMs: 100 }), 1020)).toBe(false);
  expect(map.cells).toEqual(cells(3));
  expect(map.take(tiles(1, [0], { timeMs: 300 }), 1030)).toBe(true);
  expect(map.cells[0]).toBe(1);
  expect(map.changes).toBe(2);
});

test('another map takes its place; tiles of the one before are ignored, also across the wrap', () => {
  map.take(tiles(3, [0], { number: 0xffffffff }), 10);
  const { place } = map;
  expect(map.take(tiles(1, [0], { number: 0, timeMs: 50 }), 20)).toBe(true);
  expect(map.place).not.toBe(place);
  expect(map.cells[0]).toBe(1);
  expect(map.take(tiles(3, [1], { number: 0xffffffff, timeMs: 900 }), 30)).toBe(false);
  expect(map.cells[32]).toBe(0);
});

test('it says how old it is, and for how long the robot has said nothing of it', () => {
  map.take(tiles(3, [0], { ageMs: 5000 }), 10_000);
  map.take(tiles(3, [1], { ageMs: 5900 }), 11_000);
  // The second message was 100 ms longer on its way.
  expect(map.ageMs(12_000)).toBe(7000);
  expect(map.silentMs(12_000)).toBe(1000);
  map.take(tiles(3, [1], { timeMs: 200, ageMs: 20 }), 13_000);
  expect(map.ageMs(13_000)).toBe(20);
});
