/** Meshes are read in a thread of their own, for the newest model. */
import { execFileSync } from 'node:child_process';
import { mkdtempSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { binaryStl, torus } from '@farpoint/meshes/testing';
import { decodeModelMeshes } from '@farpoint/protocol';
import type { LinkMeshes } from '@farpoint/ros';
import type { Logger } from '@farpoint/service';
import { expect, test } from 'vitest';
import { MeshLoader, type ModelMeshBytes } from './mesh-loader.ts';

const folder = mkdtempSync(join(tmpdir(), 'farpoint-meshes-'));
writeFileSync(join(folder, 'ring.stl'), binaryStl(torus(24, 12)));
writeFileSync(join(folder, 'fine.stl'), binaryStl(torus(500, 200)));
const linkOf = (address: string): LinkMeshes => ({
  ...{ link: 0, standIns: [0], unknown: 0 },
  meshes: [{ address, scale: [1, 1, 1], place: [0, 0, 0, 0, 0, 0, 1], colour: 0 }],
});

/** A loader, and what it says. */
function loaderOf(folders: readonly string[]) {
  const told: string[] = [];
  const tell = (details: unknown, text?: string) => told.push(text ?? String(details));
  const log = { info: tell, warn: tell, error: tell } as unknown as Logger;
  return { loader: new MeshLoader(folders, log), told };
}

test('the newest model is told, with why a mesh is not drawn', async () => {
  const { loader, told } = loaderOf([folder]);
  const meshes = await new Promise<ModelMeshBytes>((resolve) => {
    loader.load([linkOf('fine.stl')], () => expect.unreachable());
    loader.load([linkOf('ring.stl'), linkOf('arm.dae')], resolve);
  });
  expect(decodeModelMeshes(meshes.bytes as Uint8Array).drawings).toHaveLength(1);
  expect(meshes.left).toMatchObject({ replaced: 1, missing: 0, why: expect.stringContaining('COLLADA') });
  expect(told).toEqual(['a mesh of the model is not drawn', 'meshes of the model read']);
});

test('without folders nothing is read, and people are told so', () => {
  const { loader, told } = loaderOf([]);
  const taken: ModelMeshBytes[] = [];
  loader.load([linkOf('ring.stl')], (meshes) => taken.push(meshes));
  const why = 'the robot has no folder for meshes';
  expect(taken).toEqual([{ bytes: null, left: { replaced: 1, missing: 0, why } }]);
  loader.load([], () => expect.unreachable());
  expect(told).toHaveLength(1);
});

test('a pipe to which nobody writes keeps nobody waiting', async () => {
  execFileSync('mkfifo', [join(folder, 'pipe.stl')]);
  const { loader } = loaderOf([folder]);
  const { bytes, left } = await new Promise<ModelMeshBytes>((resolve) =>
    loader.load([linkOf('pipe.stl')], resolve),
  );
  expect([bytes, left.why]).toEqual([null, 'pipe.stl: it is no file']);
});
