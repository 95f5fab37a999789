import fc from 'fast-check';
import { expect, test } from 'vitest';
import type { FloorPoint } from '../../ground/near-field/around-footprint.ts';
import { poseOnArc, stoppingDistance, sweptWidth, writeRibbon } from './swept-path.ts';

const box: FloorPoint[] = [
  { x: 0.35, y: -0.28 },
  { x: 0.35, y: 0.28 },
  { x: -0.25, y: 0.28 },
  { x: -0.25, y: -0.28 },
];

test('straight on, the robot sweeps its own width', () => {
  expect(sweptWidth(box, 0)).toEqual({ left: 0.28, right: 0.28 });
  const ribbon = new Float32Array(12).fill(9);
  writeRibbon(0, { left: 0.3, right: 0.2 }, 0.5, 1, ribbon);
  expect([...ribbon].map((value) => Math.round(value * 100) / 100)).toEqual([
    ...[0.5, 0.3, 9, 0.5, -0.2, 9],
    ...[1, 0.3, 9, 1, -0.2, 9],
  ]);
});

test('in a turn to the left its front sweeps more on the right, and mirrored to the right', () => {
  const { left, right } = sweptWidth(box, 1);
  expect(left).toBeCloseTo(0.28);
  expect(right).toBeCloseTo(Math.hypot(0.35, 1.28) - 1);
  expect(sweptWidth(box, -1)).toEqual({ left: right, right: left });
});

test('around a point within its footprint it sweeps that point, too', () => {
  expect(sweptWidth(box, 10).left).toBeCloseTo(0.1);
});

test('whatever the arc, no corner of the robot leaves the ribbon', () => {
  fc.assert(
    fc.property(
      fc.double({ min: -3, max: 3, noNaN: true }),
      fc.double({ min: -2, max: 2, noNaN: true }),
      (curvature, metres) => {
        const { left, right } = sweptWidth(box, curvature);
        const { x, y, yaw } = poseOnArc(curvature, metres);
        for (const corner of box) {
          const at = {
            x: x + corner.x * Math.cos(yaw) - corner.y * Math.sin(yaw),
            y: y + corner.x * Math.sin(yaw) + corner.y * Math.cos(yaw),
          };
          // Its place across the way: by its distance from the point around which everything turns.
          const across =
            Math.abs(curvature) < 1e-4
              ? at.y
              : Math.sign(curvature) * (1 / Math.abs(curvature) - Math.hypot(at.x, at.y - 1 / curvature));
          expect(across).toBeLessThanOrEqual(left + 1e-3);
          expect(across).toBeGreaterThanOrEqual(-right - 1e-3);
        }
      },
    ),
    { seed: 20 },
  );
});

test('the way to standing still is what is gone blind, and the way to brake', () => {
  expect(stoppingDistance(1, 200, 2)).toBeCloseTo(0.45);
  expect(stoppingDistance(-1, 200, 2)).toBeCloseTo(0.45);
  expect(stoppingDistance(0, 200, 2)).toBe(0);
});
