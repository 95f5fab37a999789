import type { NearSector, RobotBody } from '@farpoint/protocol';
import type { BufferGeometry, Mesh } from 'three';
import { expect, test } from 'vitest';
import { hatchedStretch, hitColour, NEAR_COLOURS, NearRing } from './near-ring.ts';

const SQUARE: RobotBody = {
  footprint: [
    { x: 0.3, y: 0.3 },
    { x: -0.3, y: 0.3 },
    { x: -0.3, y: -0.3 },
    { x: 0.3, y: -0.3 },
  ],
  decelerationMps2: 2,
};
const OPEN: NearSector = { hit: null, unseen: null };

function view(changes: Record<number, Partial<NearSector>>, stale = false) {
  const sectors = Array.from({ length: 72 }, (_, i) => ({ ...OPEN, ...changes[i] }));
  return { sectors, stale, ageMs: stale ? 2000 : 0 };
}

/** Corners of the quadrangles that are drawn, in the order of drawing: hatching, bars, curtains. */
function quads(ring: NearRing): number[][][] {
  const { geometry } = ring.object.children[0] as Mesh<BufferGeometry>;
  const { array } = geometry.getAttribute('position');
  return Array.from({ length: geometry.drawRange.count / 6 }, (_, quad) =>
    Array.from({ length: 4 }, (_, i) => [
      ...(array as Float32Array).slice(12 * quad + 3 * i, 12 * quad + 3 * i + 3),
    ]),
  );
}

test('a thing’s bar stands where it is, with a curtain over it', () => {
  const ring = new NearRing();
  ring.body = SQUARE;
  ring.show(view({ 0: { hit: { kind: 'thing', metres: 0.3 } } }));
  expect(ring.shown).toEqual({ bars: 1, hatched: 0, stale: false });
  const [bar, curtain, ...more] = quads(ring) as [number[][], number[][]];
  const [near, , far] = bar as [number[], number[], number[]];
  expect(near[0]).toBeCloseTo(0.6, 2);
  expect(far[0]).toBeGreaterThan(near[0] as number);
  const top = curtain[2] as number[];
  expect([top[0], top[2]]).toEqual([expect.closeTo(0.6, 2), expect.closeTo(1)]);
  expect(more).toEqual([]);
});

test('unseen floor is hatched up to what hides it; what a thing hides is not hatched', () => {
  const thing = { kind: 'thing' as const, metres: 0.5 };
  const from = (fromM: number, toM: number) => hatchedStretch({ hit: thing, unseen: { fromM, toM } });
  expect(from(0.2, 2)).toEqual({ fromM: 0.2, toM: 0.5 });
  expect(from(0.2, 0.4)).toEqual({ fromM: 0.2, toM: 0.4 });
  expect(from(0.6, 2)).toBe(null);
  expect(hatchedStretch(OPEN)).toBe(null);
  const ring = new NearRing();
  ring.body = SQUARE;
  ring.show(view({ 18: { hit: thing, unseen: { fromM: 0.2, toM: 2 } } }));
  expect(quads(ring).length).toBe(3);
  const [near, , far] = quads(ring)[0] as [number[], number[], number[]];
  expect(near[1]).toBeCloseTo(0.5, 2);
  expect(far[1]).toBeCloseTo(0.8, 2);
});

test('nothing is shown without an outline or without data; what is old has no colours', () => {
  const ring = new NearRing();
  ring.show(view({}));
  expect(ring.shown).toBe(null);
  ring.body = SQUARE;
  ring.show(view({}, true));
  expect(ring.shown).toEqual({ bars: 0, hatched: 0, stale: true });
  ring.show(null);
  expect(ring.shown).toBe(null);
  const hit = { kind: 'thing' as const, metres: 0.1 };
  expect([hitColour(hit, false), hitColour(hit, true)]).toEqual([NEAR_COLOURS.veryNear, NEAR_COLOURS.stale]);
  expect(hitColour({ kind: 'drop', metres: 0.1 }, false)).toBe(NEAR_COLOURS.drop);
});
