import type { RobotBody } from '@farpoint/protocol';
import type { BufferGeometry, LineSegments, Mesh } from 'three';
import { describe, expect, test } from 'vitest';
import { type DrivenPath, DrivePath } from './drive-path.ts';

const BODY: RobotBody = {
  footprint: [
    { x: 0.4, y: 0.2 },
    { x: -0.2, y: 0.2 },
    { x: -0.2, y: -0.2 },
    { x: 0.4, y: -0.2 },
  ],
  decelerationMps2: 1,
};
const AHEAD: DrivenPath = { linear: 1, angular: 0, loopMs: 100, tone: 'free' };
/** A loop of 0.1 s at 1 m/s, and then 1 m/s² of braking. */
const STOP_M = 0.6;

function shownOf(path: DrivePath) {
  const [ribbons, lines] = path.object.children as [Mesh<BufferGeometry>, LineSegments<BufferGeometry>];
  const points = ({ geometry }: Mesh<BufferGeometry> | LineSegments<BufferGeometry>) => {
    const { array, itemSize } = geometry.getAttribute('position');
    return Array.from({ length: array.length / itemSize }, (_, i) =>
      Array.from(array.slice(3 * i, 3 * i + 2), (metres) => Number(metres.toFixed(4)) + 0),
    );
  };
  const corners = points(lines).slice(0, lines.geometry.drawRange.count);
  const segments = Array.from({ length: corners.length / 2 }, (_, i) => corners.slice(2 * i, 2 * i + 2));
  const words = segments.map((ends) => ends.map((corner) => corner.join(' ')).join(' to '));
  const strengths = Array.from(lines.geometry.getAttribute('color').array).filter((_, i) => i % 4 === 3);
  return { ribbons: ribbons.visible ? points(ribbons) : null, segments, words, strengths };
}

function pathWith(driven: DrivenPath | null): DrivePath {
  const path = new DrivePath();
  path.body = BODY;
  path.show(driven);
  return path;
}

describe('what a robot takes of the floor', () => {
  test('its outline is closed, and nothing more is shown while it is not driven', () => {
    const path = pathWith(null);
    expect(shownOf(path).words).toEqual([
      ...['0.4 0.2 to -0.2 0.2', '-0.2 0.2 to -0.2 -0.2', '-0.2 -0.2 to 0.4 -0.2', '0.4 -0.2 to 0.4 0.2'],
    ]);
    expect(shownOf(path).ribbons).toBeNull();
    expect(path.shown).toBeNull();
    path.show({ ...AHEAD, linear: 0, angular: 1 });
    expect(path.shown).toBeNull();
    expect(shownOf(path).segments).toHaveLength(4);
  });

  test('nothing is shown of a robot that does not tell its outline', () => {
    const path = new DrivePath();
    path.show(AHEAD);
    expect([path.object.visible, path.shown]).toEqual([false, null]);
    path.body = BODY;
    expect(path.object.visible).toBe(true);
    expect(path.shown?.stopM).toBeCloseTo(STOP_M);
    path.body = null;
    expect(path.object.visible).toBe(false);
  });

  test('where it would stand, and a line in front of that', () => {
    const path = pathWith(AHEAD);
    expect(path.shown).toEqual({ stopM: expect.closeTo(STOP_M), tone: 'free' });
    const { words, strengths } = shownOf(path);
    expect(words.slice(4)).toEqual([
      ...['1 0.2 to 0.4 0.2', '0.4 0.2 to 0.4 -0.2', '0.4 -0.2 to 1 -0.2', '1 -0.2 to 1 0.2'],
      '1 0.2 to 1 -0.2',
    ]);
    expect(new Set(strengths.slice(0, 8))).toEqual(new Set([1]));
    expect(strengths[8]).toBeCloseTo(0.8);
    expect(strengths.at(-1)).toBe(1);
  });

  test('on an arc, the outline turns with the robot', () => {
    // A radius of 1 m: so many radians as metres.
    const { segments } = shownOf(pathWith({ ...AHEAD, angular: 1 }));
    const [from, to] = segments[4] as [number[], number[]];
    const [sin, cos] = [Math.sin(STOP_M), Math.cos(STOP_M)];
    expect(from).toEqual(
      [sin + 0.4 * cos - 0.2 * sin, 1 - cos + 0.4 * sin + 0.2 * cos].map((m) => expect.closeTo(m, 3)),
    );
    expect(Math.hypot((to[0] ?? 0) - (from[0] ?? 0), (to[1] ?? 0) - (from[1] ?? 0))).toBeCloseTo(0.6, 3);
  });

  test('the floor on its way: up to where it would stand, and farther', () => {
    const { ribbons } = shownOf(pathWith(AHEAD));
    expect(ribbons?.[0]).toEqual([0.4, 0.2]);
    expect(ribbons?.[49]).toEqual([1, -0.2]);
    expect(ribbons?.[50]).toEqual([1, 0.2]);
    expect(ribbons?.at(-1)).toEqual([2.4, -0.2]);
    const back = shownOf(pathWith({ ...AHEAD, linear: -1 })).ribbons;
    expect(back?.[0]).toEqual([-0.2, 0.2]);
    expect(back?.at(-1)).toEqual([-2.2, -0.2]);
    // However slow: 30 cm.
    expect(shownOf(pathWith({ ...AHEAD, linear: 0.05 })).ribbons?.at(-1)).toEqual([0.7, -0.2]);
  });

  test('what has not changed is not drawn again', () => {
    const path = pathWith(AHEAD);
    const [ribbons] = path.object.children as [Mesh<BufferGeometry>];
    const version = () =>
      (ribbons.geometry.getAttribute('position') as unknown as { version: number }).version;
    const before = version();
    path.show({ ...AHEAD });
    expect(version()).toBe(before);
    path.show({ ...AHEAD, angular: 0.1 });
    expect(version()).toBe(before + 1);
    path.show({ ...AHEAD, angular: 0.1, tone: 'held' });
    expect(path.shown?.tone).toBe('held');
    path.show(null);
    expect(shownOf(path).ribbons).toBeNull();
  });
});

describe('the way of a robot that goes sideways', () => {
  const ASIDE: DrivenPath = { linear: 0, lateral: 1, angular: 0, loopMs: 100, tone: 'free' };

  test('leads to its left, as wide as the robot is long, and it stands there unturned', () => {
    const path = pathWith(ASIDE);
    expect(path.shown?.stopM).toBeCloseTo(STOP_M);
    const [ribbons] = path.object.children as [Mesh<BufferGeometry>];
    expect(ribbons.rotation.z).toBeCloseTo(Math.PI / 2);
    const shown = shownOf(path);
    // In the direction of the motion: from its left side on, 0.6 m wide.
    expect(shown.ribbons?.slice(0, 2)).toEqual([
      [0.2, 0.2],
      [0.2, -0.4],
    ]);
    expect(shown.words.slice(4, 8)).toEqual([
      '0.4 0.8 to -0.2 0.8',
      '-0.2 0.8 to -0.2 0.4',
      '-0.2 0.4 to 0.4 0.4',
      '0.4 0.4 to 0.4 0.8',
    ]);
    expect(shown.words[8]).toBe('-0.2 0.8 to 0.4 0.8');
  });

  test('is drawn anew when only that changes, and forwards again', () => {
    const path = pathWith({ ...ASIDE, lateral: -1 });
    expect(shownOf(path).words[8]).toBe('0.4 -0.8 to -0.2 -0.8');
    path.show(AHEAD);
    expect(path.object.children[0]?.rotation.z).toBe(0);
    expect(shownOf(path).words).toEqual(shownOf(pathWith(AHEAD)).words);
  });
});
