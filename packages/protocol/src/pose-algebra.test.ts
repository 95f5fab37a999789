import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { bodyYaw, compose, inverse, rotate, shortestTurn } from './pose-algebra.ts';

const component = fc.double({ min: -5, max: 5, noNaN: true });
const pose = fc
  .tuple(component, component, component, component, component, component, component)
  .filter(([, , , a, b, c, d]) => Math.hypot(a, b, c, d) > 0.1)
  .map(([x, y, z, a, b, c, d]) => {
    const norm = Math.hypot(a, b, c, d);
    return { position: { x, y, z }, orientation: { x: a / norm, y: b / norm, z: c / norm, w: d / norm } };
  });

describe('pose algebra', () => {
  it('a pose composed with its inverse is the identity', () => {
    fc.assert(
      fc.property(pose, (p) => {
        const { position, orientation } = compose(inverse(p), p);
        expect(Math.hypot(position.x, position.y, position.z)).toBeLessThan(1e-9);
        expect(Math.abs(orientation.w)).toBeCloseTo(1, 9);
      }),
      { seed: 10 },
    );
  });

  it('the yaw of a body is the heading of its x axis', () => {
    fc.assert(
      fc.property(pose, ({ orientation }) => {
        const ahead = rotate(orientation, { x: 1, y: 0, z: 0 });
        // Straight up or down, it has none.
        fc.pre(Math.hypot(ahead.x, ahead.y) > 1e-3);
        const yaw = bodyYaw(orientation);
        expect(Math.cos(yaw) * ahead.y - Math.sin(yaw) * ahead.x).toBeCloseTo(0, 9);
        expect(Math.cos(yaw) * ahead.x + Math.sin(yaw) * ahead.y).toBeGreaterThan(0);
      }),
      { seed: 11 },
    );
    expect(bodyYaw({ x: 0, y: 0, z: Math.SQRT1_2, w: Math.SQRT1_2 })).toBeCloseTo(Math.PI / 2, 12);
  });

  it('the shortest turn is at most half a circle, and leads to the same direction', () => {
    fc.assert(
      fc.property(fc.double({ min: -100, max: 100, noNaN: true }), (angle) => {
        const turn = shortestTurn(angle);
        expect(Math.abs(turn)).toBeLessThanOrEqual(Math.PI + 1e-9);
        expect(Math.cos(turn)).toBeCloseTo(Math.cos(angle), 6);
        expect(Math.sin(turn)).toBeCloseTo(Math.sin(angle), 6);
      }),
      { seed: 2 },
    );
  });
});
