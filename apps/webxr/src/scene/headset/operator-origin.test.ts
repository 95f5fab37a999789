import fc from 'fast-check';
import { Euler, Group, Quaternion, Vector3 } from 'three';
import { describe, expect, test } from 'vitest';
import { headYaw, OperatorOrigin } from './operator-origin.ts';

const number = fc.double({ min: -3, max: 3, noNaN: true });
const head = (pitch: number, yaw: number, roll = 0) =>
  new Quaternion().setFromEuler(new Euler(pitch, yaw, roll, 'YXZ'));

describe('headYaw', () => {
  test('is where the face points, however far it looks up or down', () => {
    fc.assert(
      fc.property(fc.double({ min: -1.57, max: 1.57, noNaN: true }), number, (pitch, yaw) => {
        const found = headYaw(head(pitch, yaw));
        expect(Math.cos(found - yaw)).toBeCloseTo(1, 6);
      }),
      { seed: 12 },
    );
  });

  test('a head that is tilted sideways still looks ahead', () => {
    expect(headYaw(head(0, 0.7, 0.5))).toBeCloseTo(0.7, 9);
    expect(headYaw(new Quaternion())).toBe(0);
  });
});

describe('OperatorOrigin', () => {
  test('converts places as a group at the origin does', () => {
    const origin = new OperatorOrigin();
    origin.recentre({ x: 0.4, y: 1.5, z: -0.2 }, head(0, 1.1));
    const group = new Group();
    group.position.set(origin.x, origin.y, origin.z);
    group.rotation.y = origin.yaw;
    const local = group.worldToLocal(new Vector3(1, 2, 3));
    expect(origin.rightOf(1, 3)).toBeCloseTo(local.x, 9);
    expect(origin.above(2)).toBeCloseTo(local.y, 9);
    expect(origin.behind(1, 3)).toBeCloseTo(local.z, 9);
    origin.reset();
    expect(origin.rightOf(1, 3)).toBe(1);
  });
});
