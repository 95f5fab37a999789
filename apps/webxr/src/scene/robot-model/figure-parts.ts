/** What is drawn of the robot's model: one geometry for each link, in the link's own axes, with its colours. */
import type { ModelPlace, ModelShape, RobotModel } from '@farpoint/operator';
import {
  Box3,
  BoxGeometry,
  BufferGeometry,
  Color,
  CylinderGeometry,
  Float32BufferAttribute,
  Matrix4,
  Quaternion,
  SphereGeometry,
  Vector3,
} from 'three';

/** Flat sides of a round shape: of a usual model, and of one with many shapes. */
const SIDES = { few: 28, many: 12 };
/** Models with more shapes have coarser ones. Chosen: round shapes of a whole arm keep all their sides. */
const MANY_SHAPES = 96;

export interface FigureParts {
  readonly links: RobotModel['links'];
  /** Of link 0, the base, and of each moving link; `null`: nothing is drawn of it. */
  readonly geometries: readonly (BufferGeometry | null)[];
  /** In base_link, while all joints are at 0, metres. */
  readonly bounds: Box3;
}

export function figureParts({ links, shapes }: Pick<RobotModel, 'links' | 'shapes'>): FigureParts {
  const sides = shapes.length > MANY_SHAPES ? SIDES.many : SIDES.few;
  const geometries = Array.from({ length: links.length + 1 }, (_, link) => {
    const own = shapes.filter((shape) => shape.link === link);
    return own.length === 0 ? null : joined(own, sides);
  });
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

/** The shapes as one geometry, so that a link is one draw call. */
function joined(shapes: readonly ModelShape[], sides: number): BufferGeometry {
  const placed = shapes.map((shape) => {
    const geometry = geometryOf(shape, sides).toNonIndexed().applyMatrix4(matrixOf(shape.place));
    return { geometry, colour: new Color(shape.colour) };
  });
  const values = (name: string) =>
    placed.flatMap(({ geometry }) => [...(geometry.getAttribute(name).array as Float32Array)]);
  const colours = placed.flatMap(({ geometry, colour: { r, g, b } }) =>
    Array.from({ length: geometry.getAttribute('position').count }, () => [r, g, b]).flat(),
  );
  const made = new BufferGeometry();
  made.setAttribute('position', new Float32BufferAttribute(values('position'), 3));
  made.setAttribute('normal', new Float32BufferAttribute(values('normal'), 3));
  made.setAttribute('color', new Float32BufferAttribute(colours, 3));
  made.computeBoundingBox();
  made.computeBoundingSphere();
  return made;
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
