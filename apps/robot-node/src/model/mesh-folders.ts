/** Finds the mesh files that a robot's description names, in the permitted folders and nowhere else. */
import { closeSync, constants, fstatSync, openSync, readSync, realpathSync } from 'node:fs';
import { basename, isAbsolute, join, sep } from 'node:path';
import { checkMeshFormat, MAX_MESH_FILE_BYTES, MeshFault, type MeshFile } from '@farpoint/meshes';

const PACKAGE = /^package:\/\/([^/]+)\/(.+)$/;
const FILE = /^file:\/\/(\/.+)$/;
const SCHEME = /^[A-Za-z][A-Za-z0-9+.-]*:/;

/** Reads meshes by their addresses in a description. */
export class MeshFolders {
  /** Without symbolic links. */
  readonly #folders: readonly string[];

  /** @param folders of packages, or packages; those that do not exist have no files */
  constructor(folders: readonly string[]) {
    this.#folders = folders.flatMap((folder) => realOf(folder) ?? []);
  }

  /** @throws {MeshFault} */
  read(address: string): MeshFile {
    const paths = this.#pathsOf(address);
    checkMeshFormat(address);
    let isOutside = false;
    for (const path of paths) {
      const real = realOf(path);
      if (real === null) continue;
      // A symbolic link may lead anywhere: only where it ends counts.
      if (this.#folders.some((folder) => real.startsWith(folder.endsWith(sep) ? folder : folder + sep)))
        return { name: address, bytes: bytesOf(real) };
      isOutside = true;
    }
    if (isOutside) throw new MeshFault('not-permitted', 'it is in no folder for meshes');
    throw new MeshFault('not-found', 'no folder for meshes has it');
  }

  /** Where it may be, in the order of the folders. @throws {MeshFault} */
  #pathsOf(address: string): string[] {
    if (address.includes('\0')) throw new MeshFault('bad-address', 'its address is no path');
    const inPackage = PACKAGE.exec(address);
    const inFiles = FILE.exec(address);
    if (inPackage === null && inFiles === null && SCHEME.test(address))
      throw new MeshFault('bad-address', 'only package://, file:// and paths are followed');
    const path = decoded(inPackage?.[2] ?? inFiles?.[1] ?? address);
    const packageName = inPackage?.[1] ?? null;
    for (const part of [...path.split(/[/\\]/), packageName])
      if (part === '..' || part === '.') throw new MeshFault('not-permitted', 'its address leads elsewhere');
    if (isAbsolute(path)) return [path];
    return this.#folders.flatMap((folder) => {
      if (packageName === null) return join(folder, path);
      const isPackage = basename(folder) === packageName;
      return [join(folder, packageName, path), ...(isPackage ? [join(folder, path)] : [])];
    });
  }
}

/** Percent signs are decoded once. @throws {MeshFault} */
function decoded(path: string): string {
  try {
    const plain = decodeURIComponent(path);
    if (plain.includes('\0')) throw new URIError();
    return plain;
  } catch {
    throw new MeshFault('bad-address', 'its address is no path');
  }
}

function realOf(path: string): string | null {
  try {
    return realpathSync(path);
  } catch {
    return null;
  }
}

/** A plain file's, which must not be longer than is read. @throws {MeshFault} */
function bytesOf(path: string): Uint8Array {
  let file: number | null = null;
  try {
    // A pipe would wait for a writer, and the last name is no link any more.
    file = openSync(path, constants.O_RDONLY | constants.O_NOFOLLOW | constants.O_NONBLOCK);
    const status = fstatSync(file);
    if (!status.isFile()) throw new MeshFault('not-found', 'it is no file');
    if (status.size > MAX_MESH_FILE_BYTES)
      throw new MeshFault('too-large', `it has more than ${MAX_MESH_FILE_BYTES} bytes`);
    const bytes = Buffer.alloc(status.size);
    let length = 0;
    for (let more = -1; length < bytes.length && more !== 0; length += more)
      more = readSync(file, bytes, length, bytes.length - length, null);
    return bytes.subarray(0, length);
  } catch (error) {
    if (error instanceof MeshFault) throw error;
    throw new MeshFault('not-found', 'it cannot be read');
  } finally {
    if (file !== null) closeSync(file);
  }
}
