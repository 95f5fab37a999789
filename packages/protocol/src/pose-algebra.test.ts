import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { compose, inverse } from './pose-algebra.ts';

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
});
