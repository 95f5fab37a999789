/** The meshes of a link, which somebody else reads: a description only names them. */
import type { ModelPlace, Pose } from '@farpoint/protocol';
import { faultAt, nameIn, numbers } from './urdf-values.ts';
import type { XmlElement } from './xml.ts';

const MOST_SCALE = 1e6;
const MOST_ADDRESS = 1024;

/** A mesh as a visual element has it. */
export interface MeshShape {
  /** As the description names it: `package://…`, `file://…` or a path. */
  address: string;
  /** Metres for each of the file's units; a negative one mirrors. */
  scale: [x: number, y: number, z: number];
  pose: Pose;
  /** sRGB, 24 bits. */
  colour: number;
}

/** A mesh, placed in what moves as one with its link. */
export interface MeshUse extends Omit<MeshShape, 'pose'> {
  place: ModelPlace;
}

/** The meshes of one link of the description. */
export interface LinkMeshes {
  /** The moving link to which they belong; 0: the base. */
  link: number;
  meshes: MeshUse[];
  /** Positions, in the model's shapes, of the collision shapes that stand for them until they are read. */
  standIns: number[];
  /** Visual elements of a kind that nobody draws. */
  unknown: number;
}

/** @throws {UrdfFault} */
export function meshOf(mesh: XmlElement): Pick<MeshShape, 'address' | 'scale'> {
  const address = nameIn(mesh, 'filename', MOST_ADDRESS);
  const [x = 1, y = 1, z = 1] = mesh.attributes.has('scale') ? numbers(mesh, 'scale', 3, MOST_SCALE) : [];
  if (x * y * z === 0) throw faultAt(mesh, 'the scale of <mesh> is 0');
  return { address, scale: [x, y, z] };
}
