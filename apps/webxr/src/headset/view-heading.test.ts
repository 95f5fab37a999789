import fc from 'fast-check';
import { Vector3 } from 'three';
import { describe, expect, test } from 'vitest';
import { ViewHeading } from './view-heading.ts';

const UP = new Vector3(0, 1, 0);

describe('ViewHeading', () => {
  test('fixed in the world: begins at the robot’s heading and stays there while the robot turns', () => {
    const heading = new ViewHeading();
    heading.follow(0.5);
    heading.follow(2);
    expect(heading.yaw).toBe(0.5);
    heading.turn(-0.1);
    heading.follow(3);
    expect(heading.yaw).toBeCloseTo(0.4, 12);
    heading.align();
    heading.follow(3);
    expect(heading.yaw).toBe(3);
  });

  test('with the robot: turns as it does, and keeps the operator’s own turn', () => {
    const heading = new ViewHeading();
    heading.followsRobot = true;
    heading.follow(0.5);
    heading.follow(2);
    expect(heading.yaw).toBe(2);
    heading.turn(1);
    heading.follow(2.5);
    expect(heading.yaw).toBeCloseTo(3.5, 12);
  });

  test('a turn about the head leaves the head where it is', () => {
    const number = fc.double({ min: -3, max: 3, noNaN: true });
    fc.assert(
      fc.property(
        number,
        number,
        fc.array(fc.tuple(number, number, number), { maxLength: 4 }),
        (x, z, turns) => {
          const heading = new ViewHeading();
          heading.follow(x);
          const head = (at: Vector3) =>
            at
              .clone()
              .applyAxisAngle(UP, heading.yaw)
              .add(new Vector3(heading.shiftX, 0, heading.shiftZ));
          for (const [by, dx, dz] of turns) {
            const at = new Vector3(x + dx, 0, z + dz);
            const before = head(at);
            heading.turnAbout(by, at.x, at.z);
            expect(head(at).distanceTo(before)).toBeLessThan(1e-9);
          }
          heading.align();
          expect([heading.shiftX, heading.shiftZ]).toEqual([0, 0]);
        },
      ),
      { seed: 5 },
    );
  });
});
