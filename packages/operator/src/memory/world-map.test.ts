import { describe, expect, test } from 'vitest';
import { MemoryPages, PAGES_BYTES } from './memory-pages.ts';
import { readPly, writePly } from './ply.ts';
import { type RememberedPlace, rememberedPlaces } from './testing/remembered-places.ts';
import { cameraAt, frameOfRoom, ROOM, type RoomBox } from './testing/room.ts';
import { MAX_RANGE_M, WorldMap } from './world-map.ts';

const PAGES = 512;
const CAMERA = cameraAt(1, 0, 0);
/** 1.5 m before the camera. */
const BOX: RoomBox = { from: { x: 2.5, y: -0.3, z: 0 }, to: { x: 3, y: 0.3, z: 1.6 } };

function roomMap(): WorldMap {
  return new WorldMap({ pages: PAGES, limits: { linear: 1, angular: 1 } });
}

/** Looks at the room every 250 ms. @returns when it looked last, ms */
function look(map: WorldMap, fromMs: number, frames: number, boxes: readonly RoomBox[] = []): number {
  for (let i = 0; i < frames; i++) map.take(frameOfRoom(CAMERA, fromMs + i * 250, boxes));
  return fromMs + (frames - 1) * 250;
}

/** From the nearest side of the room. */
function distanceFromRoom({ x, y, z }: RememberedPlace): number {
  const { from, to } = ROOM;
  return Math.min(...[x - from.x, to.x - x, y - from.y, to.y - y, z - from.z, to.z - z].map(Math.abs));
}

function inBox({ x, y, z }: RememberedPlace): boolean {
  return x > 2.3 && x < 3.2 && Math.abs(y) < 0.5 && z > 0.1 && z < 1.8;
}

describe('WorldMap', () => {
  test('remembers where the walls are, with noise too', () => {
    const map = roomMap();
    let seed = 1;
    const noise = () => {
      seed = (Math.imul(seed, 1_664_525) + 1_013_904_223) >>> 0;
      return (seed / 2 ** 32 - 0.5) * 0.006;
    };
    for (let i = 0; i < 10; i++) map.take(frameOfRoom(CAMERA, i * 250, [], noise));
    const places = rememberedPlaces(map.store);
    expect(places.length).toBeGreaterThan(4000);
    const distances = places.map(distanceFromRoom).sort((a, b) => a - b);
    expect(distances[Math.floor(distances.length / 2)]).toBeLessThan(0.02);
    expect(distances[Math.floor(distances.length * 0.95)]).toBeLessThan(0.1);
    for (const { x, y, z } of places) expect(Math.hypot(x - 1, y, z - 1)).toBeLessThan(MAX_RANGE_M + 0.1);
  });

  test('does not remember what was there for an instant', () => {
    const map = roomMap();
    const lastMs = look(map, 0, 8);
    map.take(frameOfRoom(CAMERA, lastMs + 250, [BOX]));
    expect(rememberedPlaces(map.store).filter(inBox)).toEqual([]);
    // Nor is it kept until it comes again: it is seen through.
    look(map, lastMs + 500, 2);
    map.take(frameOfRoom(CAMERA, lastMs + 1250, [BOX]));
    expect(rememberedPlaces(map.store).filter(inBox)).toEqual([]);
  });

  test('forgets what has gone within a second of seeing through it, and keeps what is behind', () => {
    const map = roomMap();
    const lastMs = look(map, 0, 12, [BOX]);
    expect(rememberedPlaces(map.store).filter(inBox).length).toBeGreaterThan(200);
    look(map, lastMs + 250, 4);
    expect(rememberedPlaces(map.store).filter(inBox)).toEqual([]);
    expect(rememberedPlaces(map.store).length).toBeGreaterThan(4000);
  });

  test('keeps what is hidden now, and what is out of view', () => {
    const map = roomMap();
    const lastMs = look(map, 0, 8);
    const behind = ({ x, y }: RememberedPlace) => x > 5.9 && Math.abs(y) < 0.3;
    const before = rememberedPlaces(map.store).filter(behind).length;
    expect(before).toBeGreaterThan(20);
    look(map, lastMs + 250, 8, [BOX]);
    expect(rememberedPlaces(map.store).filter(behind).length).toBe(before);
    // The robot turns round, no faster than it can.
    for (let i = 1; i <= 12; i++) map.take(frameOfRoom(cameraAt(1, 0, i * 0.25), lastMs + 2250 + i * 250));
    expect(rememberedPlaces(map.store).filter(behind).length).toBe(before);
  });

  test('forgets everything when the pose jumps, and goes on from there', () => {
    const map = roomMap();
    const lastMs = look(map, 0, 8);
    expect(map.take(frameOfRoom(cameraAt(1.2, 0, 0), lastMs + 250)).jumped).toBe(false);
    expect(map.take(frameOfRoom(cameraAt(3.5, 0, 0), lastMs + 500)).jumped).toBe(true);
    expect(rememberedPlaces(map.store)).toEqual([]);
    map.take(frameOfRoom(cameraAt(3.5, 0, 0), lastMs + 1500));
    expect(rememberedPlaces(map.store).length).toBeGreaterThan(1000);
  });

  test('takes no more than its pages: the oldest and farthest goes first', () => {
    const map = new WorldMap({ pages: 40 });
    for (let i = 0; i < 20; i++) {
      const pose = cameraAt(1 + i * 0.2, 0, 0);
      map.take(frameOfRoom(pose, i * 1000));
      map.take(frameOfRoom(pose, i * 1000 + 700));
      expect(map.store.usedPages).toBeLessThanOrEqual(40);
    }
    // What the robot has just seen is there.
    const last = rememberedPlaces(map.store).filter(({ x }) => x > 5.5);
    expect(last.length).toBeGreaterThan(100);
  });

  test('hands on what it remembers, and nothing else', () => {
    const map = roomMap();
    const shown = new Map<number, number>();
    const pages = new MemoryPages(new ArrayBuffer(PAGES_BYTES));
    const handOn = () => {
      do {
        pages.fill(map.store);
        for (let i = 0; i < pages.count; i++) shown.set(pages.page(i), pages.surfels(i));
      } while (pages.count > 0);
    };
    for (const [i, boxes] of [[], [BOX], [BOX], [BOX], [BOX], [BOX], [], [], []].entries()) {
      map.take(frameOfRoom(CAMERA, i * 250, boxes));
      handOn();
      const sum = [...shown.values()].reduce((total, surfels) => total + surfels, 0);
      expect(sum).toBe(rememberedPlaces(map.store).length);
    }
  });

  test('is the same after it was saved and loaded', () => {
    const map = roomMap();
    look(map, 0, 8, [BOX]);
    const file = readPly(new Uint8Array(writePly(map.store, 1_400_000, '2026-01-02T03:04:05.000Z')));
    expect(file.savedAt).toBe('2026-01-02T03:04:05.000Z');
    const loaded = roomMap();
    for (let i = 0; i < file.count; i++) {
      const [x, y, z] = [...file.places.subarray(i * 3, i * 3 + 3)] as [number, number, number];
      expect(loaded.restore(x, y, z, file.colours[i] as number, 1)).toBe(true);
    }
    const sorted = (places: RememberedPlace[]) => places.sort((a, b) => a.x - b.x || a.y - b.y || a.z - b.z);
    const [before, after] = [sorted(rememberedPlaces(map.store)), sorted(rememberedPlaces(loaded.store))];
    expect(after.length).toBe(before.length);
    for (const [i, place] of after.entries()) expect(place.colour).toBe(before[i]?.colour);
  });
});
