import { describe, expect, test } from 'vitest';
import { FRAME_SLOTS, HIDDEN, TileMap } from './tile-map.ts';

const TILES = 8;

/** Shows tiles of a frame. */
function put(map: TileMap, frame: number, tiles: readonly number[], nowMs: number, empty = false): boolean[] {
  const slot = map.open(frame, (Math.max(...tiles) + 1) / TILES, nowMs);
  return slot === null ? [] : tiles.map((tile) => map.show(tile, slot, empty));
}

const all = Array.from({ length: TILES }, (_, tile) => tile);

describe('TileMap', () => {
  test('a tile stays until a newer frame replaces it', () => {
    const map = new TileMap(TILES);
    put(map, 5, all, 0);
    const before = map.newestSlot;
    put(map, 6, [0, 1, 2, 4], 20);
    expect(map.newestSlot).not.toBe(before);
    expect([...map.slots]).toEqual(
      all.map((tile) => ([0, 1, 2, 4].includes(tile) ? map.newestSlot : before)),
    );
    expect(map.shown).toBe(TILES);
  });

  test('a late packet fills what is older, and nothing else', () => {
    const map = new TileMap(TILES);
    put(map, 5, [0, 1], 0);
    put(map, 6, [0, 1, 2], 20);
    put(map, 7, [0], 40);
    expect(put(map, 6, [0, 1, 3], 45)).toEqual([false, true, true]);
    expect(map.slots[0]).toBe(map.newestSlot);
    expect(map.newestFrame).toBe(7);
    expect(put(map, 4, [0], 50)).toEqual([]);
  });

  test('frame numbers wrap', () => {
    const map = new TileMap(TILES);
    put(map, 0xffff_ffff, all, 0);
    put(map, 0, [0], 20);
    expect(map.newestFrame).toBe(0);
    expect(map.endedFrame).toBe(0xffff_ffff);
    put(map, 0, [7], 21);
    expect(map.endedFrame).toBe(0);
  });

  test('where nothing was seen, nothing is shown', () => {
    const map = new TileMap(TILES);
    put(map, 1, all, 0);
    put(map, 2, [3, 4], 20, true);
    expect(map.shown).toBe(TILES - 2);
    expect(map.slots[3]).toBe(HIDDEN);
    // Not even what was seen there before.
    expect(put(map, 1, [3], 25)).toEqual([false]);
  });

  test('once a frame is whole, tiles that it did not have are empty', () => {
    const map = new TileMap(TILES);
    put(map, 1, all, 0);
    put(map, 2, [0, 1, 2], 20);
    map.count(map.newestSlot, 300, 500);
    expect(map.shown).toBe(TILES);
    put(map, 2, [3, 4], 21);
    map.count(map.newestSlot, 200, 500);
    expect([...map.slots].map((slot) => slot === HIDDEN)).toEqual(all.map((tile) => tile > 4));
    // A frame with a lost packet is never whole: everything stays.
    put(map, 3, all, 40);
    put(map, 4, [0, 1], 60);
    map.count(map.newestSlot, 200, 500);
    put(map, 5, [0], 80);
    map.count(map.newestSlot, 100, 500);
    expect(map.shown).toBe(TILES);
  });

  test('what is far behind the newest frame is hidden, but not because no frame comes', () => {
    const map = new TileMap(TILES);
    put(map, 1, all, 0);
    put(map, 2, [0], 5000);
    expect(map.shown).toBe(TILES);
    for (const frame of [3, 4]) put(map, frame, [0], 5000 + frame);
    expect(map.shown).toBe(TILES);
    put(map, 5, [0], 5010);
    expect(map.shown).toBe(1);
  });

  test('no tile refers to a slot that has another frame', () => {
    const map = new TileMap(TILES);
    put(map, 0, all, 0);
    for (let frame = 1; frame <= FRAME_SLOTS; frame++) put(map, frame, [0], frame);
    expect(map.shown).toBe(1);
    map.reset();
    expect(map.shown).toBe(0);
    expect(map.endedFrame).toBeNull();
  });
});
