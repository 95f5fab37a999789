/**
 * The meshes of the robot's model as bytes. A mesh is sent once, however often it is drawn. Its vertices lie on a grid of
 * 4096 steps along its longest side and follow each other in the order in which its triangles need them first, so that both are
 * small differences. What is read is bounded: in bytes, meshes, drawings, and triangles that are drawn.
 */
import { MeshBytesReader, MeshBytesWriter, refuseMeshes } from './mesh-bytes.ts';
import { MAX_MODEL_MESH_BYTES } from './model-meshes.ts';
import { MAX_MODEL_LINKS, MAX_MODEL_M, MAX_MODEL_SHAPES, type ModelPlace } from './robot-model.ts';

/** Different meshes of a model. */
export const MAX_MESHES = 128;
/** Meshes that are drawn: one may be drawn several times. */
export const MAX_MESH_DRAWINGS = 256;
/** Triangles that are drawn, those of a mesh counted each time. */
export const MAX_DRAWN_TRIANGLES = 20_000;
/** Steps of a mesh's grid, less one. */
export const MESH_STEPS = 4095;
const VERSION = 1;
const UNIT_ERROR = 0.01;

/** A mesh on its grid: vertex i is at `min` + `step` × its three numbers, metres. */
export interface GridMesh {
  /** Its corner with the lowest x, y and z, metres. */
  min: readonly [x: number, y: number, z: number];
  /** Side of a cell of the grid, metres. */
  step: number;
  /** Three for each vertex, 0 to 4095, in the order in which the triangles need them. */
  vertices: Uint16Array;
  /** Three vertices for each triangle, counter-clockwise from outside. */
  triangles: Uint16Array;
}

/** A mesh that a link carries. */
export interface MeshDrawing {
  /** Number of the mesh. */
  mesh: number;
  /** Number of the link; 0: the base. */
  link: number;
  /** Pose of the mesh in the link. */
  place: ModelPlace;
  /** sRGB, 24 bits. */
  colour: number;
}

/** The meshes of a model. */
export interface ModelMeshes {
  /** Positions, ascending, of the model's shapes that stand for these meshes: whoever draws the meshes does not draw them. */
  insteadOf: number[];
  /** Each is there once, however often it is drawn. */
  meshes: GridMesh[];
  /** Where meshes are drawn. */
  drawings: MeshDrawing[];
}

/** @param meshes within all bounds */
export function encodeModelMeshes({ insteadOf, meshes, drawings }: ModelMeshes): Uint8Array {
  const out = new MeshBytesWriter();
  out.byte(VERSION);
  out.unsigned(insteadOf.length);
  let before = -1;
  for (const shape of insteadOf) {
    out.unsigned(shape - before - 1);
    before = shape;
  }
  out.unsigned(meshes.length);
  for (const mesh of meshes) writeMesh(out, mesh);
  out.unsigned(drawings.length);
  for (const { mesh, link, place, colour } of drawings) {
    out.unsigned(mesh);
    out.unsigned(link);
    for (const each of place) out.float(each);
    out.unsigned(colour);
  }
  return out.done();
}

/** @throws {ProtocolError} for anything but meshes within all bounds */
export function decodeModelMeshes(bytes: Uint8Array): ModelMeshes {
  if (bytes.length > MAX_MODEL_MESH_BYTES)
    refuseMeshes('', `must have at most ${MAX_MODEL_MESH_BYTES} bytes`);
  const read = new MeshBytesReader(bytes);
  if (read.byte('version') !== VERSION) refuseMeshes('version', `must be ${VERSION}`);
  const insteadOf: number[] = [];
  let next = 0;
  for (let left = read.unsigned('insteadOf', MAX_MODEL_SHAPES); left > 0; left--) {
    next += read.unsigned('insteadOf', MAX_MODEL_SHAPES);
    if (next >= MAX_MODEL_SHAPES) refuseMeshes('insteadOf', 'must be shapes of the model');
    insteadOf.push(next++);
  }
  let trianglesLeft = MAX_DRAWN_TRIANGLES;
  const meshes: GridMesh[] = [];
  for (let left = read.unsigned('meshes', MAX_MESHES); left > 0; left--) {
    const mesh = readMesh(read, `meshes.${meshes.length}`, trianglesLeft);
    trianglesLeft -= mesh.triangles.length / 3;
    meshes.push(mesh);
  }
  const drawings: MeshDrawing[] = [];
  let drawn = 0;
  for (let left = read.unsigned('drawings', MAX_MESH_DRAWINGS); left > 0; left--) {
    const drawing = readDrawing(read, `drawings.${drawings.length}`, meshes.length);
    drawn += (meshes[drawing.mesh] as GridMesh).triangles.length / 3;
    if (drawn > MAX_DRAWN_TRIANGLES)
      refuseMeshes('drawings', `must have at most ${MAX_DRAWN_TRIANGLES} triangles`);
    drawings.push(drawing);
  }
  if (read.left > 0) refuseMeshes('', 'must end after the last drawing');
  return { insteadOf, meshes, drawings };
}

function writeMesh(out: MeshBytesWriter, { min, step, vertices, triangles }: GridMesh): void {
  out.unsigned(triangles.length / 3);
  for (const each of [...min, step]) out.float(each);
  // An index is told as its distance from the next vertex that has not been used; 0 is that vertex, which follows.
  let [used, x, y, z] = [0, 0, 0, 0];
  for (const index of triangles) {
    out.unsigned(used - index);
    if (index < used) continue;
    const [nx, ny, nz] = [vertices[3 * used], vertices[3 * used + 1], vertices[3 * used + 2]] as [
      ...[number, number, number],
    ];
    out.signed(nx - x);
    out.signed(ny - y);
    out.signed(nz - z);
    [x, y, z] = [nx, ny, nz];
    used++;
  }
}

function readMesh(read: MeshBytesReader, path: string, most: number): GridMesh {
  const count = read.unsigned(`${path}.triangles`, most);
  if (count === 0) refuseMeshes(`${path}.triangles`, 'must be at least 1');
  // Each index is a byte at least: what cannot follow is not made room for.
  if (3 * count > read.left) refuseMeshes(`${path}.triangles`, 'are missing');
  const at = (axis: number) => read.float(`${path}.min.${axis}`, MAX_MODEL_M);
  const min: [number, number, number] = [at(0), at(1), at(2)];
  const step = read.float(`${path}.step`, (2 * MAX_MODEL_M) / MESH_STEPS);
  if (!(step > 0)) refuseMeshes(`${path}.step`, 'must be above 0');
  const triangles = new Uint16Array(3 * count);
  const vertices = new Uint16Array(9 * count);
  const last = [0, 0, 0];
  let used = 0;
  for (let i = 0; i < triangles.length; i++) {
    const index = used - read.unsigned(`${path}.triangles`, used);
    triangles[i] = index;
    if (index < used) continue;
    for (let axis = 0; axis < 3; axis++) {
      const value = (last[axis] as number) + read.signed(`${path}.vertices`, MESH_STEPS);
      if (value < 0 || value > MESH_STEPS) refuseMeshes(`${path}.vertices`, 'must lie on the grid');
      last[axis] = value;
      vertices[3 * used + axis] = value;
    }
    used++;
  }
  return { min, step, vertices: vertices.slice(0, 3 * used), triangles };
}

function readDrawing(read: MeshBytesReader, path: string, meshes: number): MeshDrawing {
  const mesh = read.unsigned(`${path}.mesh`, MAX_MESHES);
  if (mesh >= meshes) refuseMeshes(`${path}.mesh`, 'must be one of the meshes');
  const link = read.unsigned(`${path}.link`, MAX_MODEL_LINKS);
  const place = [0, 1, 2, 3, 4, 5, 6].map((i) =>
    read.float(`${path}.place.${i}`, i < 3 ? MAX_MODEL_M : 1.01),
  );
  const turn = Math.hypot(...place.slice(3));
  if (!(Math.abs(turn - 1) < UNIT_ERROR))
    refuseMeshes(`${path}.place`, 'must be metres and a unit quaternion');
  return { mesh, link, place: place as ModelPlace, colour: read.unsigned(`${path}.colour`, 0xffffff) };
}
