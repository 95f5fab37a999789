import { MAX_PATH_POINTS, type Pose } from '@farpoint/protocol';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { placePath, readPath, tellingPoints } from './planned-path.ts';

const HERE: Pose = { position: { x: 0, y: 0, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } };
/** 2 m ahead, and turned to the left by 90°. */
const TURNED: Pose = {
  position: { x: 2, y: 0, z: 0.1 },
  orientation: { x: 0, y: 0, z: Math.SQRT1_2, w: Math.SQRT1_2 },
};
const TILTED: Pose = { ...HERE, orientation: { x: Math.SQRT1_2, y: 0, z: 0, w: Math.SQRT1_2 } };

const message = (points: readonly (readonly [number, number])[]) => ({
  header: { stamp: { sec: 7, nanosec: 5 }, frame_id: 'map' },
  poses: points.map(([x, y]) => ({
    header: { stamp: { sec: 0, nanosec: 0 }, frame_id: '' },
    pose: { position: { x, y, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } },
  })),
});

describe('a path', () => {
  it('is placed in the world, with the points that it needs', () => {
    const straight = Array.from({ length: 101 }, (_, i) => [i / 10, 0] as const);
    const path = readPath(message([...straight, [10, 3]]));
    expect(path).toMatchObject({ frameId: 'map', stampNs: 7_000_000_005n });
    expect(placePath(path, HERE)).toEqual({
      kind: 'path',
      points: [
        [0, 0],
        [10, 0],
        [10, 3],
      ],
    });
    expect(placePath(path, TURNED)).toEqual({
      kind: 'path',
      points: [
        [2, 0],
        [2, 10],
        [-1, 10],
      ],
    });
  });

  it('without a point is none, wherever its frame is', () => {
    expect(placePath(readPath(message([])), null)).toEqual({ kind: 'path', points: [] });
  });

  it('is refused with the reason', () => {
    const path = readPath(
      message([
        [0, 0],
        [1, 0],
      ]),
    );
    const refused = { kind: 'refused', of: 'path', frame: 'map' };
    expect(placePath(path, null)).toEqual({ ...refused, reason: 'unknown-frame' });
    expect(placePath(path, TILTED)).toEqual({ ...refused, reason: 'not-level' });
    expect(
      placePath(
        readPath(
          message([
            [0, 0],
            [2e6, 0],
          ]),
        ),
        HERE,
      ),
    ).toEqual({ ...refused, reason: 'out-of-range' });
  });

  it('with anything but numbers is not read', () => {
    expect(() => readPath(message([[0, Number.NaN]]))).toThrow();
    expect(() => readPath({ poses: [] })).toThrow();
  });
});

describe('telling points', () => {
  const point = fc.record({ x: fc.integer({ min: -99, max: 99 }), y: fc.integer({ min: -99, max: 99 }) });

  it('keep the ends and the order, are few, and stay near all others unless they are too few', () => {
    fc.assert(
      fc.property(fc.array(point, { maxLength: 60 }), fc.integer({ min: 2, max: 20 }), (points, most) => {
        const chosen = tellingPoints(points, most, 2);
        expect(chosen.length).toBeLessThanOrEqual(Math.max(most, Math.min(points.length, 2)));
        expect(chosen[0]).toBe(points[0]);
        expect(chosen.at(-1)).toBe(points.at(-1));
        const places = chosen.map((one) => points.indexOf(one));
        expect(places).toEqual([...places].sort((a, b) => a - b));
        if (chosen.length === most) return;
        for (const each of points) expect(distanceTo(chosen, each)).toBeLessThanOrEqual(2 + 1e-9);
      }),
      { seed: 1, numRuns: 300 },
    );
  });

  it('of a long path are as many as a message has', () => {
    const spiral = Array.from({ length: 20_000 }, (_, i) => ({
      x: (i / 1000) * Math.cos(i / 50),
      y: (i / 1000) * Math.sin(i / 50),
    }));
    expect(tellingPoints(spiral, MAX_PATH_POINTS, 0.02)).toHaveLength(MAX_PATH_POINTS);
  });
});

/** From a point to the line through others. */
function distanceTo(line: readonly { x: number; y: number }[], { x, y }: { x: number; y: number }): number {
  const [only] = line;
  if (line.length === 1 && only !== undefined) return Math.hypot(x - only.x, y - only.y);
  return Math.min(
    ...line.slice(1).map((b, i) => {
      const a = line[i] as { x: number; y: number };
      const [dx, dy] = [b.x - a.x, b.y - a.y];
      const squared = dx * dx + dy * dy;
      const along = squared > 0 ? ((x - a.x) * dx + (y - a.y) * dy) / squared : 0;
      const share = Math.min(Math.max(along, 0), 1);
      return Math.hypot(a.x + share * dx - x, a.y + share * dy - y);
    }),
  );
}
