/** Which files a description can make the robot read: those in the permitted folders, whatever it says. */
import { mkdirSync, mkdtempSync, symlinkSync, truncateSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { MeshFault } from '@farpoint/meshes';
import { expect, test } from 'vitest';
import { MeshFolders } from './mesh-folders.ts';

const root = mkdtempSync(join(tmpdir(), 'farpoint-meshes-'));
const share = join(root, 'share');
const meshes = join(share, 'arm_description', 'meshes');
mkdirSync(meshes, { recursive: true });
mkdirSync(join(root, 'share-secret'));
const write = (path: string) => {
  writeFileSync(path, path);
  return path;
};
const arm = write(join(meshes, 'arm.stl'));
write(join(meshes, 'arm 2.stl'));
const secret = write(join(root, 'secret.stl'));
const beside = write(join(root, 'share-secret', 'x.stl'));
write(join(meshes, 'key.txt'));
symlinkSync(secret, join(meshes, 'out.stl'));
symlinkSync(root, join(meshes, 'up'));
symlinkSync(arm, join(meshes, 'in.stl'));
const folders = new MeshFolders([join(root, 'nowhere'), share]);

function found(address: string, from = folders): string {
  try {
    return Buffer.from(from.read(address).bytes).toString();
  } catch (error) {
    if (error instanceof MeshFault) return error.code;
    throw error;
  }
}

test('packages, files and paths are found in the folders', () => {
  for (const address of [
    'package://arm_description/meshes/arm.stl',
    'package://arm_description/meshes/in.stl',
    `file://${arm}`,
    arm,
    'arm_description/meshes/arm.stl',
  ])
    expect(found(address), address).toBe(arm);
  expect(found('package://arm_description/meshes/arm%202.stl')).toBe(join(meshes, 'arm 2.stl'));
  // The folder of the package itself is enough.
  const own = new MeshFolders([join(share, 'arm_description')]);
  expect(found('package://arm_description/meshes/arm.stl', own)).toBe(arm);
  expect(found('package://other/meshes/arm.stl', own)).toBe('not-found');
});

test.each([
  ['package://arm_description/../../secret.stl', 'not-permitted'],
  ['package://arm_description/meshes/%2e%2e/%2e%2e/../secret.stl', 'not-permitted'],
  ['package://arm_description/meshes%2f..%2f..%2f..%2fsecret.stl', 'not-permitted'],
  ['package://../secret.stl', 'not-permitted'],
  ['package://./../secret.stl', 'not-permitted'],
  ['../secret.stl', 'not-permitted'],
  ['..\\secret.stl', 'not-permitted'],
  [secret, 'not-permitted'],
  [`file://${secret}`, 'not-permitted'],
  [beside, 'not-permitted'],
  ['package://arm_description/meshes/out.stl', 'not-permitted'],
  ['package://arm_description/meshes/up/secret.stl', 'not-permitted'],
  [`${meshes}/up/secret.stl`, 'not-permitted'],
  ['package://arm_description//etc/passwd.stl', 'not-found'],
  ['/dev/zero.stl', 'not-found'],
  ['package://arm_description/meshes/none.stl', 'not-found'],
  ['package://arm_description/meshes/key.txt', 'unsupported'],
  ['/etc/passwd', 'unsupported'],
  ['http://127.0.0.1/arm.stl', 'bad-address'],
  ['file://host/arm.stl', 'bad-address'],
  ['data:model/stl;base64,AAAA', 'bad-address'],
  ['package://arm_description/a%00.stl', 'bad-address'],
  ['package://arm_description/%ff.stl', 'bad-address'],
  ['arm\0.stl', 'bad-address'],
])('%j is refused: %s', (address, code) => {
  expect(found(address)).toBe(code);
});

test('folders, and files that are too long are not read', () => {
  mkdirSync(join(meshes, 'folder.stl'));
  truncateSync(write(join(meshes, 'long.stl')), 33 << 20);
  expect(found('package://arm_description/meshes/folder.stl')).toBe('not-found');
  expect(found('package://arm_description/meshes/long.stl')).toBe('too-large');
});
