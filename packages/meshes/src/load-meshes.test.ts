import { decodeModelMeshes, MAX_DRAWN_TRIANGLES, MAX_MODEL_MESH_BYTES } from '@farpoint/protocol';
import type { LinkMeshes, MeshUse } from '@farpoint/ros';
import { expect, test } from 'vitest';
import { loadMeshes, type MeshFile } from './load-meshes.ts';
import { MeshFault } from './mesh-fault.ts';
import { binaryStl, textStl, torus } from './testing/solids.ts';

const use = (address: string, changes: Partial<MeshUse> = {}): MeshUse => ({
  ...{ address, scale: [1, 1, 1], place: [0.25, 0, 0, 0, 0, 0, 1], colour: 0xff8800 },
  ...changes,
});
const link = (meshes: MeshUse[], changes: Partial<LinkMeshes> = {}): LinkMeshes => ({
  ...{ link: 0, meshes, standIns: [], unknown: 0 },
  ...changes,
});
const FILES: Readonly<Record<string, Uint8Array>> = {
  'ring.stl': binaryStl(torus(24, 12)),
  'words.STL': textStl(torus(24, 12)),
  'fine.stl': binaryStl(torus(500, 120)),
  'point.stl': binaryStl(new Array(18).fill(0.5)),
  'broken.stl': new Uint8Array(100),
  'arm.dae': new Uint8Array(10),
};
const reads: string[] = [];
function read(address: string): MeshFile {
  reads.push(address);
  const bytes = FILES[address];
  if (bytes === undefined) throw new MeshFault('not-found', 'no folder for meshes has it');
  return { name: address, bytes };
}
const decoded = (bytes: Uint8Array | null) => decodeModelMeshes(bytes as Uint8Array);

test('a mesh is read and sent once, however often it is drawn, and is where it was', async () => {
  reads.length = 0;
  const { bytes, left, unused, triangles } = await loadMeshes(
    [link([use('ring.stl'), use('ring.stl', { colour: 1 })]), link([use('ring.stl')], { link: 2 })],
    read,
  );
  expect(reads).toEqual(['ring.stl']);
  expect([left, unused]).toEqual([{ replaced: 0, missing: 0, why: null }, []]);
  expect(triangles).toEqual({ drawn: 3 * 576, inFiles: 3 * 576 });
  const { meshes, drawings, insteadOf } = decoded(bytes);
  expect(insteadOf).toEqual([]);
  expect(drawings.map(({ mesh, link: of, colour }) => [mesh, of, colour])).toEqual([
    [0, 0, 0xff8800],
    [0, 0, 1],
    [0, 2, 0xff8800],
  ]);
  const [ring] = meshes;
  // Each edge of a closed surface has two triangles: it has half as many vertices as triangles.
  expect(ring!.vertices.length / 3).toBe(288);
  expect(ring!.min[0]).toBeCloseTo(-0.4, 6);
  expect(ring!.min[2]).toBeCloseTo(-0.1, 6);
  expect(ring!.step * 4095).toBeCloseTo(0.8, 6);
  expect((bytes as Uint8Array).length).toBeLessThan(6 * 576 + 300);
});

test('scales apply, and a mirrored mesh is still seen from outside', async () => {
  const { bytes } = await loadMeshes(
    [link([use('words.STL', { scale: [0.001, 0.001, 0.001] }), use('ring.stl', { scale: [1, -1, 1] })])],
    read,
  );
  const { meshes } = decoded(bytes);
  expect(meshes[0]!.step * 4095).toBeCloseTo(0.0008, 9);
  for (const { min, step, vertices, triangles } of meshes) {
    // The volume is positive where triangles are counter-clockwise from outside.
    let volume = 0;
    const corner = (i: number) =>
      [0, 1, 2].map((axis) => min[axis]! + step * vertices[3 * triangles[i]! + axis]!);
    for (let i = 0; i < triangles.length; i += 3) {
      const [[ax, ay, az], [bx, by, bz], [cx, cy, cz]] = [corner(i), corner(i + 1), corner(i + 2)] as [
        ...[[number, number, number], [number, number, number], [number, number, number]],
      ];
      volume += ax * (by * cz - bz * cy) - ay * (bx * cz - bz * cx) + az * (bx * cy - by * cx);
    }
    expect(volume).toBeGreaterThan(0);
  }
  const tooFar = await loadMeshes([link([use('ring.stl', { scale: [1000, 1000, 1000] })])], read);
  expect(tooFar.bytes).toBe(null);
  expect(tooFar.left.why).toBe('ring.stl: it would reach farther than 100 m: is its scale right?');
});

test('large meshes are reduced, and small ones stay as they are', async () => {
  const { bytes, triangles } = await loadMeshes(
    [link([use('fine.stl'), use('ring.stl'), use('fine.stl', { scale: [2, 2, 2] })])],
    read,
  );
  expect((bytes as Uint8Array).length).toBeLessThan(MAX_MODEL_MESH_BYTES);
  expect(triangles.inFiles).toBe(2 * 120_000 + 576);
  expect(triangles.drawn).toBeLessThanOrEqual(MAX_DRAWN_TRIANGLES);
  expect(triangles.drawn).toBeGreaterThan(0.9 * MAX_DRAWN_TRIANGLES);
  const [fine, ring] = decoded(bytes).meshes;
  expect(ring!.triangles).toHaveLength(3 * 576);
  // It is still as large as it was, and its surface where it was.
  expect(fine!.step * 4095).toBeCloseTo(0.8, 2);
  let worst = 0;
  for (let i = 0; i < fine!.vertices.length; i += 3) {
    const [x, y, z] = [0, 1, 2].map((axis) => fine!.min[axis]! + fine!.step * fine!.vertices[i + axis]!) as [
      ...[number, number, number],
    ];
    worst = Math.max(worst, Math.abs(Math.hypot(Math.hypot(x, y) - 0.3, z) - 0.1));
  }
  expect(worst).toBeLessThan(0.002);
});

test('a link whose collision shapes stand for its meshes gets all of them, or keeps those shapes', async () => {
  const { bytes, left, unused } = await loadMeshes(
    [
      link([use('ring.stl')], { standIns: [3, 4] }),
      link([use('ring.stl'), use('arm.dae')], { link: 1, standIns: [5] }),
      link([use('ring.stl'), use('broken.stl')], { link: 2 }),
      link([use('ring.stl')], { link: 3, standIns: [6], unknown: 1 }),
      link([use('point.stl')], { link: 4 }),
      link([use('gone.stl'), use('gone.stl')], { link: 4 }),
    ],
    read,
  );
  const { insteadOf, drawings } = decoded(bytes);
  expect(insteadOf).toEqual([3, 4]);
  expect(drawings.map((each) => each.link)).toEqual([0, 2]);
  expect(left).toEqual({ replaced: 4, missing: 4, why: 'arm.dae: COLLADA is not read: STL and OBJ are' });
  expect(unused.map(({ address, fault }) => `${address} ${fault.code}`)).toEqual([
    ...['arm.dae unsupported', 'broken.stl bad-mesh', 'point.stl empty', 'gone.stl not-found'],
  ]);
});

test('a description that names endlessly many meshes gets the first', async () => {
  const many = Array.from({ length: 400 }, () => link([use('ring.stl')]));
  const { bytes, left, unused } = await loadMeshes(many, read);
  expect(decoded(bytes).drawings).toHaveLength(256);
  expect(left.missing).toBe(400 - 256);
  expect(unused[0]?.fault.code).toBe('too-many');
  const scales = Array.from({ length: 200 }, (_, i) => link([use('ring.stl', { scale: [1 + i, 1, 1] })]));
  expect(decoded((await loadMeshes(scales, read)).bytes).meshes.length).toBeLessThanOrEqual(128);
  const files = Array.from({ length: 400 }, (_, i) => link([use(`${i}.stl`)]));
  expect((await loadMeshes(files, read)).bytes).toBe(null);
});
