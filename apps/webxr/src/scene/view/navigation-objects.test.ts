/** What of the navigator's path and map is drawn, and where. */
import type { NavigatorMap } from '@farpoint/operator';
import { type DataTexture, type Mesh, Vector3 } from 'three';
import { expect, test } from 'vitest';
import type { MapView } from '../../ground/navigation/navigation-view.ts';
import { FloorMap } from './floor-map.ts';
import { PlannedPathLine } from './planned-path-line.ts';

const place: NonNullable<NavigatorMap['place']> = {
  ...{ width: 3, height: 2, cellM: 0.5 },
  origin: { x: 10, y: 20, yaw: Math.PI / 2 },
};
const view = (cells: number[], change: Partial<MapView> = {}): MapView => ({
  ...{ place, cells: Uint8Array.from(cells), changes: 1, stale: false, ageMs: 0, silentMs: 0 },
  ...change,
});

/** Where a corner of the map lies in the world. */
function cornerOf({ object }: FloorMap, x: number, y: number): number[] {
  object.updateMatrixWorld(true);
  return new Vector3(x, y, 0)
    .applyMatrix4(object.matrixWorld)
    .toArray()
    .map((n) => Math.round(n * 100) / 100);
}

test('a map lies at its place, below the floor, with its first cell at the origin', () => {
  const map = new FloorMap();
  expect(map.shown).toBe(0);
  map.show(view([3, 1, 0, 0, 0, 0]), 1);
  expect(cornerOf(map, 0, 0)).toEqual([10, 20, 0.97]);
  expect(cornerOf(map, 1, 0)).toEqual([10, 21.5, 0.97]);
  expect(cornerOf(map, 0, 1)).toEqual([9, 20, 0.97]);
  expect(map.shown).toBe(2);
  const data = (map.object.material.map as DataTexture).image.data as Uint8Array;
  expect(data.slice(8, 12)[3]).toBe(0);
  expect(data[3]).toBeGreaterThan(data[7] as number);
});

test('a map is painted anew when it has changed, and is gone when it no longer holds', () => {
  const map = new FloorMap();
  map.show(view([1, 1, 1, 1, 1, 1]), 0);
  const version = map.object.material.map?.version;
  map.show(view([3, 3, 3, 3, 3, 3]), 0);
  expect(map.object.material.map?.version).toBe(version);
  map.show(view([3, 3, 0, 0, 0, 0], { changes: 2 }), 0);
  expect(map.shown).toBe(2);
  map.show(null, 0);
  expect([map.object.visible, map.shown]).toEqual([false, 0]);
  map.show(view([1, 0], { place: { ...place, width: 1 }, changes: 2 }), 0);
  expect(map.shown).toBe(1);
});

test('a path lies above the floor and ends in a ring', () => {
  const line = new PlannedPathLine();
  expect(line.shown).toBe(0);
  line.show(
    [
      [0, 0],
      [2, 0],
      [2, 3],
    ],
    0.5,
  );
  expect(line.shown).toBe(3);
  expect(line.object.position.z).toBeGreaterThan(0.5);
  const [ribbon, goal] = line.object.children as [Mesh, Mesh];
  expect(ribbon.geometry.drawRange.count).toBe(12);
  expect(goal.position.toArray()).toEqual([2, 3, 0]);
  line.show(null, 0.5);
  expect(line.shown).toBe(0);
});
