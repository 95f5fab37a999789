import { describe, expect, test } from 'vitest';
import { TransformTree } from './transform-tree.ts';

const at = (x: number) => ({ position: { x, y: 0, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } });

function tree(...edges: [parent: string, child: string, timeMs: number, x: number, fixed?: boolean][]) {
  const made = new TransformTree();
  for (const [parent, child, timeMs, x, fixed = false] of edges)
    made.set(parent, child, timeMs, at(x), fixed);
  return made;
}
const xOf = (made: TransformTree, frame: string, timeMs: number) =>
  made.poseInRoot(frame, timeMs)?.pose.position.x;

describe('a moving transform', () => {
  test('is interpolated, and says how far a time is from what is known', () => {
    const made = tree(['odom', 'base', 100, 1], ['odom', 'base', 200, 2], ['base', 'lidar', 0, 10, true]);
    expect(xOf(made, 'lidar', 150)).toBeCloseTo(11.5);
    expect(made.poseInRoot('lidar', 150)).toMatchObject({ root: 'odom', offMs: 0 });
    expect(made.poseInRoot('lidar', 450)).toMatchObject({ pose: at(12), offMs: 250 });
    expect(made.poseInRoot('lidar', 70)).toMatchObject({ pose: at(11), offMs: 30 });
  });

  test('takes what was overtaken in its place, and of two at one time the first', () => {
    const made = tree(['odom', 'base', 200, 2], ['odom', 'base', 100, 1], ['odom', 'base', 200, 9]);
    expect([xOf(made, 'base', 150), xOf(made, 'base', 500)]).toEqual([1.5, 2]);
  });

  test('whose clock steps back begins anew, as old as it is', () => {
    const made = tree(['odom', 'base', 100_000, 1], ['odom', 'base', 40_000, 2], ['odom', 'base', 40_100, 3]);
    expect([xOf(made, 'base', 100_000), made.newestMs('base')]).toEqual([3, 40_100]);
    expect(made.poseInRoot('base', 100_000)?.offMs).toBe(59_900);
  });
});

describe('what is told about a frame', () => {
  test('is as old as that of what moves it which was told longest ago', () => {
    const made = tree(['odom', 'foot', 100, 1], ['foot', 'base', 300, 0], ['base', 'lidar', 0, 0, true]);
    expect(made.newestMs('lidar')).toBe(100);
    expect(tree(['base', 'lidar', 0, 0, true]).newestMs('lidar')).toBeNull();
    expect(tree().newestMs('lidar')).toBeNull();
  });

  test('does not age with localisation, which may be told rarely', () => {
    const made = tree(['map', 'odom', 0, 5], ['odom', 'base', 900, 1]);
    expect([made.newestMs('base'), made.poseInRoot('base', 900)?.offMs, xOf(made, 'base', 900)]).toEqual([
      900, 0, 6,
    ]);
    const named = tree(['map', 'robot1/odom', 0, 5], ['robot1/odom', 'robot1/base', 900, 1]);
    expect(named.newestMs('robot1/base')).toBe(900);
  });
});

test('a transform of another source begins anew, if it is kept', () => {
  const made = tree(['odom', 'base', 100, 1], ['base', 'lidar', 0, 0]);
  expect(made.set('lidar', 'base', 200, at(2), false, true)).toBe('loop');
  expect(xOf(made, 'base', 200)).toBe(1);
  expect(made.set('odom', 'base', 200, at(2), false, true)).toBe('kept');
  expect(xOf(made, 'base', 100)).toBe(2);
});

test('no frame can be above itself', () => {
  const made = tree(['odom', 'base', 0, 1], ['base', 'lidar', 0, 1]);
  expect(made.set('lidar', 'odom', 0, at(1), false)).toBe('loop');
  expect(made.set('base', 'base', 0, at(1), false)).toBe('loop');
  expect(made.set('lidar', 'base', 0, at(1), true)).toBe('loop');
  expect(made.poseInRoot('lidar', 0)?.root).toBe('odom');
});

test('memory is bounded', () => {
  const made = tree();
  for (let i = 0; i < 2000; i++) made.set('odom', `frame ${i}`, 0, at(0), false);
  expect(made.set('odom', 'one more', 0, at(0), false)).toBe('too-many');
  expect(made.set('odom', 'frame 3', 10, at(1), false)).toBe('kept');
});
