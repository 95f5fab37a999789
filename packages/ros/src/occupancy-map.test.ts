import { MAX_MAP_SIDE, type Pose } from '@farpoint/protocol';
import { describe, expect, it } from 'vitest';
import { placeMap, readMap } from './occupancy-map.ts';

const HERE: Pose = { position: { x: 0, y: 0, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } };
const TURN = { x: 0, y: 0, z: Math.SQRT1_2, w: Math.SQRT1_2 };

function message(width: number, height: number, data: ArrayLike<number>, origin: Pose = HERE) {
  return {
    header: { stamp: { sec: 7, nsec: 0 }, frame_id: '/map' },
    info: { map_load_time: { sec: 0, nsec: 0 }, resolution: 0.05, width, height, origin },
    data: Int8Array.from(data),
  };
}

describe('a map', () => {
  it('has states for probabilities', () => {
    const { cells } = readMap(message(4, 2, [-1, 0, 25, 26, 64, 65, 100, 101]));
    expect([...cells]).toEqual([0, 1, 1, 2, 2, 3, 3, 0]);
  });

  it('is placed by its origin and its frame', () => {
    const map = readMap(message(2, 1, [0, 100], { ...HERE, position: { x: -1, y: 2, z: 0 } }));
    const news = placeMap(map, { position: { x: 10, y: 0, z: 0 }, orientation: TURN });
    if (news.kind !== 'map') throw new Error(news.kind);
    const { origin, ...others } = news.map;
    expect(others).toMatchObject({ width: 2, height: 1, cellM: 0.05 });
    expect(origin.x).toBeCloseTo(8);
    expect(origin.y).toBeCloseTo(-1);
    expect(origin.yaw).toBeCloseTo(Math.PI / 2);
  });

  it('with too many cells becomes coarser, and a coarse cell is free only if all of it is', () => {
    const [width, height] = [MAX_MAP_SIDE + 1, 3];
    const data = new Int8Array(width * height);
    [data[0], data[3], data[4], data[2 * width + 8]] = [100, -1, 50, -1];
    const { cells, cellM, ...size } = readMap(message(width, height, data));
    expect(size).toMatchObject({ width: 257, height: 2 });
    expect(cellM).toBeCloseTo(0.1);
    expect([...cells.subarray(0, 4)]).toEqual([3, 0, 2, 1]);
    expect(cells[257 + 4]).toBe(0);
  });

  it('is refused with the reason', () => {
    const refused = { kind: 'refused', of: 'map', frame: '/map' };
    const map = readMap(message(1, 1, [0]));
    expect(placeMap(map, null)).toEqual({ ...refused, reason: 'unknown-frame' });
    const tilted = { ...HERE, orientation: { x: Math.SQRT1_2, y: 0, z: 0, w: Math.SQRT1_2 } };
    expect(placeMap(map, tilted)).toEqual({ ...refused, reason: 'not-level' });
    const far = { ...HERE, position: { x: 0, y: -2e6, z: 0 } };
    expect(placeMap(map, far)).toEqual({ ...refused, reason: 'out-of-range' });
  });

  it.each([
    ['without cells', message(0, 5, [])],
    ['with too few cells', message(2, 2, [0, 0, 0])],
    [
      'whose origin has no orientation',
      message(1, 1, [0], { ...HERE, orientation: { x: 0, y: 0, z: 0, w: 0 } }),
    ],
    ['whose origin is nowhere', message(1, 1, [0], { ...HERE, position: { x: Number.NaN, y: 0, z: 0 } })],
    ['without cells’ size', { ...message(1, 1, [0]), info: { ...message(1, 1, [0]).info, resolution: 0 } }],
  ])('%s is not read', (_, given) => {
    expect(() => readMap(given)).toThrow();
  });
});
