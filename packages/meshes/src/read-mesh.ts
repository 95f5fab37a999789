import { MeshFault } from './mesh-fault.ts';
import { readObj } from './obj.ts';
import { readStl } from './stl.ts';

/** A longer file is not read, bytes: a binary STL of the most triangles is 25 MB. */
export const MAX_MESH_FILE_BYTES = 32 << 20;

const READERS: Readonly<Record<string, (bytes: Uint8Array) => Float32Array>> = { stl: readStl, obj: readObj };
const NAMES: Readonly<Record<string, string>> = { dae: 'COLLADA', gltf: 'glTF', glb: 'glTF', ply: 'PLY' };
const EXTENSION = /\.([A-Za-z0-9]{1,8})$/;

/** Refuses a format that is not read, without the file. @param name of the file @throws {MeshFault} `unsupported` */
export function checkMeshFormat(name: string): void {
  const extension = extensionOf(name);
  if (Object.hasOwn(READERS, extension)) return;
  const format = Object.hasOwn(NAMES, extension) ? NAMES[extension] : extension || 'a file of no known kind';
  throw new MeshFault('unsupported', `${format} is not read: STL and OBJ are`);
}

/** @returns nine numbers for each triangle, in the file's own unit @throws {MeshFault} */
export function readMesh(name: string, bytes: Uint8Array): Float32Array {
  checkMeshFormat(name);
  if (bytes.length > MAX_MESH_FILE_BYTES)
    throw new MeshFault('too-large', `it has more than ${MAX_MESH_FILE_BYTES} bytes`);
  return (READERS[extensionOf(name)] as (bytes: Uint8Array) => Float32Array)(bytes);
}

function extensionOf(name: string): string {
  return EXTENSION.exec(name)?.[1]?.toLowerCase() ?? '';
}
