import { readFileSync } from 'node:fs';
import fc from 'fast-check';
import { expect, test } from 'vitest';
import { ProtocolError } from './errors.ts';
import {
  decodeModelMeshes,
  encodeModelMeshes,
  type GridMesh,
  MAX_DRAWN_TRIANGLES,
  MESH_STEPS,
  type ModelMeshes,
} from './mesh-coding.ts';
import { MAX_MODEL_MESH_BYTES } from './model-meshes.ts';

const TRIANGLE: GridMesh = {
  ...{ min: [-0.5, 0, 0.25], step: 0.0009765625 },
  vertices: Uint16Array.of(0, 0, 0, MESH_STEPS, 0, 0, 0, 7, MESH_STEPS),
  triangles: Uint16Array.of(0, 1, 2),
};
const ONE: ModelMeshes = {
  insteadOf: [0, 2, 511],
  meshes: [TRIANGLE],
  drawings: [{ mesh: 0, link: 128, place: [1, 2, -3, 0, 0, 0, 1], colour: 0xfedcba }],
};

const float = fc.float({ min: -99, max: 99, noNaN: true }).map((value) => value + 0);
/** Vertices in the order in which triangles need them. */
const mesh: fc.Arbitrary<GridMesh> = fc
  .record({
    min: fc.tuple(float, float, float),
    step: fc.constantFrom(0.0009765625, 2 ** -20),
    corners: fc.array(fc.tuple(fc.nat(40), fc.nat(MESH_STEPS), fc.nat(MESH_STEPS), fc.nat(MESH_STEPS)), {
      minLength: 3,
      maxLength: 120,
    }),
  })
  .map(({ min, step, corners }) => {
    const vertices: number[] = [];
    const triangles = corners.slice(0, 3 * Math.floor(corners.length / 3)).map(([back, ...at]) => {
      const used = vertices.length / 3;
      if (back !== 0 && back <= used) return used - back;
      vertices.push(...at);
      return used;
    });
    return { min, step, vertices: Uint16Array.from(vertices), triangles: Uint16Array.from(triangles) };
  });
const models: fc.Arbitrary<ModelMeshes> = fc
  .record({
    insteadOf: fc.uniqueArray(fc.nat(511)).map((all) => all.sort((a, b) => a - b)),
    meshes: fc.array(mesh, { minLength: 1, maxLength: 4 }),
    drawings: fc.array(fc.tuple(fc.nat(), fc.nat(128), float, fc.nat(0xffffff)), { maxLength: 8 }),
  })
  .map(({ insteadOf, meshes, drawings }) => ({
    insteadOf,
    meshes,
    drawings: drawings.map(([number, link, x, colour]) => ({
      ...{ mesh: number % meshes.length, link, colour },
      place: [x, -x, 0, 0, 0, 0, 1],
    })),
  }));

function faultOf(bytes: Uint8Array): string | null {
  try {
    decodeModelMeshes(bytes);
  } catch (error) {
    if (error instanceof ProtocolError) return error.message;
    throw error;
  }
  return null;
}

interface MeshVector {
  name: string;
  hex: string;
  meshes?: Pick<ModelMeshes, 'insteadOf' | 'drawings'> & {
    meshes: { min: number[]; step: number; vertices: number[][]; triangles: number[][] }[];
  };
}
const { read: vectors } = JSON.parse(
  readFileSync(new URL('../vectors/model-meshes.json', import.meta.url), 'utf8'),
) as { read: MeshVector[] };

test.each(vectors)('vector: $name', ({ hex, meshes }) => {
  const bytes = Uint8Array.from(Buffer.from(hex, 'hex'));
  if (meshes === undefined) {
    expect(faultOf(bytes)).not.toBe(null);
    return;
  }
  const decoded = decodeModelMeshes(bytes);
  const inThrees = (all: Uint16Array) =>
    Array.from({ length: all.length / 3 }, (_, i) => [...all.subarray(3 * i, 3 * i + 3)]);
  expect({
    ...decoded,
    meshes: decoded.meshes.map(({ vertices, triangles, ...grid }) => ({
      ...{ ...grid, vertices: inThrees(vertices), triangles: inThrees(triangles) },
    })),
  }).toEqual(meshes);
  expect(Buffer.from(encodeModelMeshes(decoded)).toString('hex')).toBe(hex);
});

test('meshes come out as they went in', () => {
  expect(decodeModelMeshes(encodeModelMeshes(ONE))).toEqual(ONE);
  fc.assert(
    fc.property(models, (given) => {
      expect(decodeModelMeshes(encodeModelMeshes(given))).toEqual(given);
    }),
    { seed: 4, numRuns: 200 },
  );
});

test('whatever the bytes, it is meshes within all bounds or a ProtocolError', () => {
  fc.assert(
    fc.property(
      models,
      fc.array(fc.tuple(fc.nat(), fc.nat(255)), { maxLength: 6 }),
      fc.nat(),
      (given, changes, end) => {
        const whole = encodeModelMeshes(given);
        const bytes = whole.slice(0, end % 3 === 0 ? end % whole.length : whole.length);
        for (const [at, value] of changes) if (bytes.length > 0) bytes[at % bytes.length] = value;
        if (faultOf(bytes) !== null) return;
        const { meshes, drawings } = decodeModelMeshes(bytes);
        for (const { vertices, triangles } of meshes) {
          expect(Math.max(...vertices)).toBeLessThanOrEqual(MESH_STEPS);
          expect(Math.max(...triangles)).toBeLessThan(vertices.length / 3);
        }
        for (const drawing of drawings) expect(drawing.mesh).toBeLessThan(meshes.length);
      },
    ),
    { seed: 5, numRuns: 400 },
  );
});

test('what would be too much is refused before there is room made for it', () => {
  const drawn = { ...TRIANGLE, triangles: new Uint16Array(3 * 10_001).map((_, i) => i % 3) };
  const [drawing] = ONE.drawings;
  expect(faultOf(encodeModelMeshes({ ...ONE, meshes: [drawn] }))).toBe(null);
  expect(faultOf(encodeModelMeshes({ ...ONE, meshes: [drawn], drawings: [drawing!, drawing!] }))).toMatch(
    `drawings: must have at most ${MAX_DRAWN_TRIANGLES} triangles`,
  );
  expect(faultOf(encodeModelMeshes({ ...ONE, meshes: [drawn, drawn] }))).toMatch('meshes.1.triangles');
  expect(faultOf(new Uint8Array(MAX_MODEL_MESH_BYTES + 1))).toMatch('must have at most');
  // It says that it has 20,000 triangles, and ends.
  expect(faultOf(Uint8Array.of(1, 0, 1, 0xa0, 0x9c, 1))).toMatch('are missing');
});

test.each<[string, Partial<ModelMeshes>]>([
  ['meshes.0.step', { meshes: [{ ...TRIANGLE, step: 0 }] }],
  ['meshes.0.step', { meshes: [{ ...TRIANGLE, step: 1 }] }],
  ['meshes.0.min.1', { meshes: [{ ...TRIANGLE, min: [0, Number.NaN, 0] }] }],
  ['meshes.0.min.2', { meshes: [{ ...TRIANGLE, min: [0, 0, 101] }] }],
  ['meshes.0.triangles', { meshes: [{ ...TRIANGLE, triangles: new Uint16Array(0) }] }],
  [
    'meshes.0.vertices',
    { meshes: [{ ...TRIANGLE, vertices: Uint16Array.of(0, 0, 0, 4096, 0, 0, 0, 0, 0) }] },
  ],
  ['drawings.0.mesh', { drawings: [{ ...ONE.drawings[0]!, mesh: 1 }] }],
  ['drawings.0.link', { drawings: [{ ...ONE.drawings[0]!, link: 129 }] }],
  ['drawings.0.place', { drawings: [{ ...ONE.drawings[0]!, place: [0, 0, 0, 0, 0, 0, 0.5] }] }],
  ['drawings.0.place.0', { drawings: [{ ...ONE.drawings[0]!, place: [101, 0, 0, 0, 0, 0, 1] }] }],
  ['drawings.0.colour', { drawings: [{ ...ONE.drawings[0]!, colour: 0x1000000 }] }],
  ['insteadOf', { insteadOf: [512] }],
])('%s is checked', (path, changes) => {
  expect(faultOf(encodeModelMeshes({ ...ONE, ...changes }))).toContain(`: ${path}: `);
});
