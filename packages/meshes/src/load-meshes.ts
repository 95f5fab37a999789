/** The meshes of a robot's model, read and reduced until they can be sent. */
import {
  encodeModelMeshes,
  type GridMesh,
  MAX_DRAWN_TRIANGLES,
  MAX_MESH_DRAWINGS,
  MAX_MESHES,
  MAX_MODEL_M,
  MAX_MODEL_MESH_BYTES,
  type MeshDrawing,
} from '@farpoint/protocol';
import { allMeshesLeft, type LinkMeshes, type MeshesLeft, type MeshUse } from '@farpoint/ros';
import { MeshoptSimplifier } from 'meshoptimizer';
import { onGrid } from './grid-mesh.ts';
import { type IndexedMesh, joinCorners, reduced } from './indexed-mesh.ts';
import { MeshFault } from './mesh-fault.ts';
import { readMesh } from './read-mesh.ts';
import { triangleShares } from './triangle-shares.ts';

/** Files that are looked for, and their bytes together: a description may name many. */
const MAX_FILES = 256;
const MAX_ALL_BYTES = 128 << 20;

/** A file that a description names. */
export interface MeshFile {
  /** Its name ends with what tells its format. */
  name: string;
  bytes: Uint8Array;
}

/** A mesh that could not be used. */
export interface UnusedMesh {
  /** As the description names it. */
  address: string;
  fault: MeshFault;
}

export interface LoadedMeshes {
  /** What operators are sent; `null`: nothing. */
  bytes: Uint8Array | null;
  /** What of the model is not drawn. */
  left: MeshesLeft;
  unused: UnusedMesh[];
  /** Triangles that are drawn, and those that the files have for them. */
  triangles: { drawn: number; inFiles: number };
}

/** A mesh in metres, and how often it is drawn. */
interface Scaled extends IndexedMesh {
  inFile: number;
  drawn: number;
}

/**
 * Links whose collision shapes stand for their meshes get all of their meshes, or keep those shapes.
 *
 * @param read gives a file by its address in the description; throws {@link MeshFault}
 */
export async function loadMeshes(
  links: readonly LinkMeshes[],
  read: (address: string) => MeshFile,
): Promise<LoadedMeshes> {
  await MeshoptSimplifier.ready;
  const files = new MeshFiles(read);
  const chosen: LinkMeshes[] = [];
  const kept: LinkMeshes[] = [];
  let drawings = 0;
  for (const link of links) {
    const { meshes, standIns, unknown } = link;
    const good = meshes.filter((mesh) => files.scaled(mesh) !== null);
    const isWhole = good.length === meshes.length && unknown === 0;
    const drawn = isWhole || standIns.length === 0 ? good : [];
    if (drawings + drawn.length > MAX_MESH_DRAWINGS) {
      const fault = new MeshFault('too-many', `more than ${MAX_MESH_DRAWINGS} meshes are drawn`);
      files.unused.push({ address: drawn[0]?.address ?? '', fault });
      kept.push(link);
      continue;
    }
    drawings += drawn.length;
    if (drawn.length > 0) chosen.push({ ...link, meshes: drawn });
    const rest = meshes.filter((mesh) => !drawn.includes(mesh));
    if (rest.length + unknown > 0) kept.push({ ...link, meshes: rest });
  }
  const why = files.unused[0] === undefined ? null : wordsOf(files.unused[0]);
  const left = allMeshesLeft(kept, why);
  const nothing = { bytes: null, unused: files.unused, triangles: { drawn: 0, inFiles: 0 } };
  if (drawings === 0) return { ...nothing, left };
  try {
    return { ...files.coded(chosen), left, unused: files.unused };
  } catch (error) {
    if (!(error instanceof MeshFault)) throw error;
    return { ...nothing, left: allMeshesLeft(links, error.message) };
  }
}

class MeshFiles {
  readonly unused: UnusedMesh[] = [];
  readonly #read: (address: string) => MeshFile;
  readonly #files = new Map<string, { mesh: IndexedMesh; inFile: number } | null>();
  /** By address and scale. */
  readonly #scaled = new Map<string, Scaled | null>();
  #bytes = 0;

  constructor(read: (address: string) => MeshFile) {
    this.#read = read;
  }

  /** `null` if it cannot be used. */
  scaled(mesh: MeshUse): Scaled | null {
    const key = keyOf(mesh);
    let scaled = this.#scaled.get(key);
    if (scaled !== undefined) return scaled;
    scaled = this.#try(mesh.address, () => {
      const file = this.#file(mesh.address);
      if (file === null) return null;
      if (this.#scaled.size >= MAX_MESHES)
        throw new MeshFault('too-many', `there are more than ${MAX_MESHES} meshes`);
      return { ...scaledBy(file.mesh, mesh.scale), inFile: file.inFile, drawn: 0 };
    });
    this.#scaled.set(key, scaled);
    return scaled;
  }

  /** @param links whose meshes can all be used */
  coded(links: readonly LinkMeshes[]): Pick<LoadedMeshes, 'bytes' | 'triangles'> {
    const keys = [...new Set(links.flatMap(({ meshes }) => meshes.map(keyOf)))];
    const meshes = keys.map((key) => this.#scaled.get(key) as Scaled);
    for (const { meshes: uses } of links)
      for (const mesh of uses) (this.#scaled.get(keyOf(mesh)) as Scaled).drawn++;
    const drawings = links.flatMap(({ link, meshes: uses }) =>
      uses.map((use): MeshDrawing => {
        const { place, colour } = use;
        return { mesh: keys.indexOf(keyOf(use)), link, place, colour };
      }),
    );
    const insteadOf = links.flatMap(({ standIns }) => standIns).sort((a, b) => a - b);
    const inFiles = meshes.reduce((sum, { inFile, drawn }) => sum + inFile * drawn, 0);
    // Triangles that share no corners need more bytes: fewer of them are sent.
    for (let most = MAX_DRAWN_TRIANGLES; ; most = Math.floor(most * 0.7)) {
      const shares = triangleShares(
        meshes.map(({ triangles, drawn }) => ({ triangles: triangles.length / 3, drawn })),
        most,
      );
      const grids = meshes.map((mesh, i): GridMesh => onGrid(reduced(mesh, shares[i] as number)));
      const bytes = encodeModelMeshes({ insteadOf, meshes: grids, drawings });
      if (bytes.length > MAX_MODEL_MESH_BYTES) continue;
      const drawn = grids.reduce(
        (sum, { triangles }, i) => sum + (triangles.length / 3) * (meshes[i] as Scaled).drawn,
        0,
      );
      return { bytes, triangles: { drawn, inFiles } };
    }
  }

  #file(address: string): { mesh: IndexedMesh; inFile: number } | null {
    let file = this.#files.get(address);
    if (file !== undefined) return file;
    file = this.#try(address, () => {
      if (this.#files.size >= MAX_FILES)
        throw new MeshFault('too-many', `there are more than ${MAX_FILES} files`);
      const { name, bytes } = this.#read(address);
      this.#bytes += bytes.length;
      if (this.#bytes > MAX_ALL_BYTES)
        throw new MeshFault('too-large', `the files have more than ${MAX_ALL_BYTES} bytes`);
      const corners = readMesh(name, bytes);
      // No more can be sent, and many files are kept at a time.
      const mesh = reduced(joinCorners(corners), MAX_DRAWN_TRIANGLES);
      return { mesh, inFile: corners.length / 9 };
    });
    this.#files.set(address, file);
    return file;
  }

  #try<T>(address: string, make: () => T): T | null {
    try {
      return make();
    } catch (error) {
      if (!(error instanceof MeshFault)) throw error;
      this.unused.push({ address, fault: error });
      return null;
    }
  }
}

function keyOf({ address, scale }: MeshUse): string {
  return `${scale.join(' ')} ${address}`;
}

/** In metres. @throws {MeshFault} if a part of it would be too far away, or all of it too small */
function scaledBy({ positions, triangles }: IndexedMesh, scale: MeshUse['scale']): IndexedMesh {
  const scaled = positions.map((at, i) => at * (scale[i % 3] as number));
  if (!scaled.every((at) => Math.abs(at) <= MAX_MODEL_M))
    throw new MeshFault('too-large', `it would reach farther than ${MAX_MODEL_M} m: is its scale right?`);
  const mesh = { positions: scaled, triangles: triangles.slice() };
  // A mirrored triangle would be seen from behind.
  if (scale[0] * scale[1] * scale[2] < 0)
    for (let i = 0; i < triangles.length; i += 3) {
      mesh.triangles[i + 1] = triangles[i + 2] as number;
      mesh.triangles[i + 2] = triangles[i + 1] as number;
    }
  // It is known here, before anybody counts on it, that something is left of it.
  onGrid(mesh);
  return mesh;
}

function wordsOf({ address, fault }: UnusedMesh): string {
  return `${address.slice(address.lastIndexOf('/') + 1)}: ${fault.message}`;
}
