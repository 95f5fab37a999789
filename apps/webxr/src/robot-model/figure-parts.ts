/** What is drawn of the robot's model: one geometry for each link, in the link's own axes, with its colours. */
import type { GridMesh, ModelPlace, ModelShape, RobotModel } from '@farpoint/operator';
import {
  Box3,
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  Color,
  CylinderGeometry,
  Matrix4,
  Quaternion,
  SphereGeometry,
  Vector3,
} from 'three';
import { placedMesh } from './placed-mesh.ts';
import type { PlacedTriangles } from './placed-triangles.ts';

/** Flat sides of a round shape: of a usual model, and of one with many shapes. */
const SIDES = { few: 28, many: 12 };
const MANY_SHAPES = 96;

export interface FigureParts {
  readonly links: RobotModel['links'];
  /** Of link 0, the base, and of each moving link; `null`: nothing is drawn of it. */
  readonly geometries: readonly (BufferGeometry | null)[];
  /** In base_link, while all joints are at 0, metres. */
  readonly bounds: Box3;
}

interface ColouredTriangles extends PlacedTriangles {
  readonly colour: number;
}

export function figureParts({
  links,
  shapes,
  meshes,
}: Pick<RobotModel, 'links' | 'shapes' | 'meshes'>): FigureParts {
  const sides = shapes.length > MANY_SHAPES ? SIDES.many : SIDES.few;
  const hidden = new Set(meshes?.insteadOf);
  const own = Array.from({ length: links.length + 1 }, (): ColouredTriangles[] => []);
  shapes.forEach((shape, i) => {
    if (!hidden.has(i)) own[shape.link]?.push({ ...placedShape(shape, sides), colour: shape.colour });
  });
  for (const { mesh, link, place, colour } of meshes?.drawings ?? [])
    own[link]?.push({ ...placedMesh(meshes?.meshes[mesh] as GridMesh, matrixOf(place)), colour });
  const geometries = own.map((parts) => (parts.length === 0 ? null : joined(parts)));
  const inBase = [new Matrix4()];
  for (const { parent, place } of links)
    inBase.push(new Matrix4().multiplyMatrices(inBase[parent] as Matrix4, matrixOf(place)));
  const bounds = new Box3();
  geometries.forEach((geometry, link) => {
    if (geometry?.boundingBox)
      bounds.union(geometry.boundingBox.clone().applyMatrix4(inBase[link] as Matrix4));
  });
  return { links, geometries, bounds };
}

/** Sets `position` and `turn` to a place of the model. */
export function readPlace([x, y, z, qx, qy, qz, qw]: ModelPlace, position: Vector3, turn: Quaternion): void {
  position.set(x, y, z);
  turn.set(qx, qy, qz, qw).normalize();
}

/** The parts as one geometry, so that a link is one draw call. */
function joined(parts: readonly ColouredTriangles[]): BufferGeometry {
  const length = parts.reduce((sum, { positions }) => sum + positions.length, 0);
  const [positions, normals, colours] = [0, 1, 2].map(() => new Float32Array(length)) as [
    ...[Float32Array, Float32Array, Float32Array],
  ];
  let at = 0;
  for (const part of parts) {
    positions.set(part.positions, at);
    normals.set(part.normals, at);
    const { r, g, b } = new Color(part.colour);
    for (const end = at + part.positions.length; at < end; at += 3) {
      colours[at] = r;
      colours[at + 1] = g;
      colours[at + 2] = b;
    }
  }
  const made = new BufferGeometry();
  made.setAttribute('position', new BufferAttribute(positions, 3));
  made.setAttribute('normal', new BufferAttribute(normals, 3));
  made.setAttribute('color', new BufferAttribute(colours, 3));
  made.computeBoundingBox();
  made.computeBoundingSphere();
  return made;
}

function placedShape(shape: ModelShape, sides: number): PlacedTriangles {
  const geometry = geometryOf(shape, sides).toNonIndexed().applyMatrix4(matrixOf(shape.place));
  const [positions, normals] = ['position', 'normal'].map((name) => geometry.getAttribute(name).array);
  return { positions: positions as Float32Array, normals: normals as Float32Array };
}

function geometryOf({ form, size }: ModelShape, sides: number): BufferGeometry {
  const [a = 0, b = 0, c = 0] = size;
  switch (form) {
    case 'box':
      return new BoxGeometry(a, b, c);
    case 'cylinder':
      // Those of three.js stand along y.
      return new CylinderGeometry(a, a, b, sides).rotateX(Math.PI / 2);
    case 'sphere':
      return new SphereGeometry(a, sides, Math.ceil(sides / 2));
  }
}

function matrixOf(place: ModelPlace): Matrix4 {
  const [position, turn] = [new Vector3(), new Quaternion()];
  readPlace(place, position, turn);
  return new Matrix4().compose(position, turn, new Vector3(1, 1, 1));
}
