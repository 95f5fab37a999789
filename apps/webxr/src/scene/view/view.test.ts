import { bodyYaw, opticalYaw, worldToThree } from '@farpoint/cloud-view';
import fc from 'fast-check';
import { Quaternion, Vector3 } from 'three';
import { describe, expect, test } from 'vitest';
import { PoseFollower } from '../pose-follower.ts';
import {
  DEFAULT_DISTANCE,
  DEFAULT_FOV,
  DEFAULT_REACH,
  Look,
  MAX_FOV,
  MAX_REACH,
  MIN_FOV,
  MIN_REACH,
} from './look.ts';

/** Optical frame (z forward, x right, y down) of a level camera with the given heading, in REP-103 axes. */
function opticalOrientation(yaw: number): Quaternion {
  const level = new Quaternion(-0.5, 0.5, -0.5, 0.5);
  return new Quaternion().setFromAxisAngle(new Vector3(0, 0, 1), yaw).multiply(level);
}

describe('axes', () => {
  test('maps forward into the screen, left to the left, up to up, and mirrors nothing', () => {
    const matrix = worldToThree();
    const at = (x: number, y: number, z: number) => new Vector3(x, y, z).applyMatrix4(matrix).toArray();
    expect(at(1, 0, 0).map((v) => v + 0)).toEqual([0, 0, -1]);
    expect(at(0, 1, 0).map((v) => v + 0)).toEqual([-1, 0, 0]);
    expect(at(0, 0, 1).map((v) => v + 0)).toEqual([0, 1, 0]);
    expect(matrix.determinant()).toBeCloseTo(1, 12);
  });

  test('headings of optical and body frames', () => {
    const angle = fc.double({ min: -3.1, max: 3.1, noNaN: true });
    fc.assert(
      fc.property(angle, (yaw) => {
        expect(opticalYaw(opticalOrientation(yaw), 0)).toBeCloseTo(yaw, 9);
        const body = new Quaternion().setFromAxisAngle(new Vector3(0, 0, 1), yaw);
        expect(bodyYaw(body)).toBeCloseTo(yaw, 9);
      }),
      { seed: 1 },
    );
  });

  test('keeps the last heading when the camera looks straight down', () => {
    const down = new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), new Vector3(0, 0, -1));
    expect(opticalYaw(down, 1.25)).toBe(1.25);
  });
});

describe('PoseFollower', () => {
  test('starts at the first pose, then follows 63 % of a step in one time constant', () => {
    const follower = new PoseFollower(100);
    follower.follow(5, 6, 7, 1, 0);
    expect([follower.x, follower.y, follower.z, follower.yaw]).toEqual([5, 6, 7, 1]);
    follower.follow(6, 6, 7, 1, 100);
    expect(follower.x).toBeCloseTo(5.632, 3);
  });

  test('turns the short way across ±π, and jumps to a distant place', () => {
    const follower = new PoseFollower(100);
    follower.follow(0, 0, 0, 3.1, 0);
    follower.follow(0, 0, 0, -3.1, 100);
    expect(follower.yaw).toBeGreaterThan(3.1);
    expect(follower.yaw).toBeLessThan(3.2);
    follower.follow(50, 0, 0, 0, 1);
    expect(follower.x).toBe(50);
  });

  test('placed, it stands there at once and follows the height; from there it follows again', () => {
    const follower = new PoseFollower(100);
    follower.place(1, 2, 1, 0.5, 16);
    expect([follower.x, follower.y, follower.z, follower.yaw]).toEqual([1, 2, 1, 0.5]);
    follower.place(3, 2, 1.1, 0.7, 100);
    expect([follower.x, follower.yaw]).toEqual([3, 0.7]);
    expect(follower.z).toBeCloseTo(1.0632, 4);
    follower.follow(3.1, 2, 1.1, 0.7, 100);
    expect(follower.x).toBeCloseTo(3.0632, 4);
  });
});

describe('Look', () => {
  test('drag and zoom stay within bounds; recentre undoes them', () => {
    const look = new Look();
    look.drag(100, 1e6, 0.01);
    expect(look.yaw).toBe(1);
    expect(look.pitch).toBeLessThan(Math.PI / 2);
    look.zoom(100);
    expect(look.fov).toBe(MAX_FOV);
    look.zoom(0.001);
    expect(look.fov).toBe(MIN_FOV);
    look.recentre();
    expect([look.yaw, look.pitch]).toEqual([0, 0]);
    look.switchMode();
    look.zoom(1000);
    expect(look.distance).toBe(15);
  });

  test('from above, a drag does nothing, zoom changes the reach, and the other view stays as it was', () => {
    const look = new Look();
    look.drag(10, 0, 0.01);
    look.zoom(0.9);
    const { yaw, fov } = look;
    look.fromAbove = true;
    look.drag(100, 100, 0.01);
    look.zoom(2);
    expect([look.yaw, look.pitch, look.fov, look.reach]).toEqual([yaw, 0, fov, 2 * DEFAULT_REACH]);
    look.zoom(1000);
    expect(look.reach).toBe(MAX_REACH);
    look.zoom(1e-6);
    expect(look.reach).toBe(MIN_REACH);
    look.recentre();
    expect([look.reach, look.fov]).toEqual([DEFAULT_REACH, fov]);
  });

  test('fits a narrow camera until the operator zooms, and again after recentring', () => {
    const look = new Look();
    look.fit(2);
    expect(look.fov).toBe(DEFAULT_FOV);
    look.fit(0.7);
    expect(look.fov).toBeCloseTo(44.4, 1);
    look.fit(0.72);
    expect(look.fov).toBeCloseTo(44.4, 1);
    look.zoom(1.5);
    look.fit(0.7);
    expect(look.fov).toBeCloseTo(66.6, 1);
    look.recentre();
    expect(look.fov).toBeCloseTo(44.4, 1);
  });

  test('fits the view from above to a cloud that reaches much farther, and to no other', () => {
    const look = new Look();
    look.fitExtent(null);
    for (const usual of [0.5, 2, 6, 14]) look.fitExtent(usual);
    expect([look.reach, look.distance]).toEqual([DEFAULT_REACH, DEFAULT_DISTANCE]);
    look.fitExtent(20);
    expect(look.reach).toBe(21);
    expect(look.distance).toBeCloseTo(DEFAULT_DISTANCE * Math.sqrt(3.5));
    // It is steady.
    look.fitExtent(23);
    expect(look.reach).toBe(21);
    look.fitExtent(16.5);
    expect(look.reach).toBe(21);
    look.fitExtent(13);
    expect(look.reach).toBe(13.65);
    look.fitExtent(11);
    expect(look.reach).toBe(DEFAULT_REACH);
    look.fitExtent(500);
    expect(look.reach).toBe(MAX_REACH);
  });

  test('the operator’s own zoom stays, until it is reset to what fits', () => {
    const look = new Look();
    look.fromAbove = true;
    look.zoom(0.5);
    look.fitExtent(20);
    expect(look.reach).toBe(DEFAULT_REACH / 2);
    look.recentre();
    expect(look.reach).toBe(21);
    look.fromAbove = false;
    look.switchMode();
    look.zoom(0.5);
    look.fitExtent(40);
    expect(look.distance).toBeCloseTo((DEFAULT_DISTANCE * Math.sqrt(3.5)) / 2);
    look.recentre();
    expect(look.distance).toBeCloseTo(DEFAULT_DISTANCE * Math.sqrt(7));
  });

  test('a view that is looked at does not zoom by itself, except when the extent becomes known', () => {
    const look = new Look();
    look.fromAbove = true;
    look.fitExtent(20);
    expect(look.reach).toBe(21);
    look.fitExtent(50);
    expect(look.reach).toBe(21);
    look.forgetExtent();
    look.fitExtent(6);
    expect(look.reach).toBe(DEFAULT_REACH);
    look.fromAbove = false;
    look.fitExtent(50);
    expect(look.reach).toBe(52.5);
  });
});
