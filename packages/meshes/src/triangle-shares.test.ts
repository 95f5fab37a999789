import fc from 'fast-check';
import { expect, test } from 'vitest';
import { triangleShares } from './triangle-shares.ts';

test('small meshes stay whole, and the others get equally many', () => {
  const wheel = { triangles: 100, drawn: 4 };
  expect(triangleShares([wheel, { triangles: 500, drawn: 1 }], 1000)).toEqual([100, 500]);
  expect(triangleShares([wheel, { triangles: 5000, drawn: 1 }, { triangles: 900, drawn: 1 }], 1000)).toEqual([
    100, 300, 300,
  ]);
  expect(triangleShares([], 1000)).toEqual([]);
});

test('they are never more than there may be', () => {
  const mesh = fc.record({
    triangles: fc.integer({ min: 1, max: 500_000 }),
    drawn: fc.integer({ min: 1, max: 8 }),
  });
  fc.assert(
    fc.property(fc.array(mesh, { minLength: 1, maxLength: 32 }), (meshes) => {
      const shares = triangleShares(meshes, 20_000);
      expect(shares.reduce((sum, share, i) => sum + share * meshes[i]!.drawn, 0)).toBeLessThanOrEqual(20_000);
      expect(Math.min(...shares)).toBeGreaterThanOrEqual(1);
    }),
    { seed: 3 },
  );
});
