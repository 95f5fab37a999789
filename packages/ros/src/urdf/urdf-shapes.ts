/** What is drawn of a link: the boxes, cylinders, spheres and meshes of its `visual` elements. */
import { MAX_MODEL_M, type ModelShape, type Pose } from '@farpoint/protocol';
import { type MeshShape, meshOf } from './link-meshes.ts';
import { childOf, colourOf, faultAt, nameIn, numbers, originOf } from './urdf-values.ts';
import type { XmlElement } from './xml.ts';

/** Of a shape without a material. */
const DEFAULT_COLOUR = 0x9aa7b4;

/** The materials that a description names once, for its links: 24 bits; `null`: they cannot be seen. */
export type Materials = ReadonlyMap<string, number | null>;

/** A shape, placed in its link. */
export interface LinkShape extends Pick<ModelShape, 'form' | 'size' | 'colour'> {
  pose: Pose;
}

export interface LinkShapes {
  shapes: LinkShape[];
  meshes: MeshShape[];
  /** How many of the shapes, the last ones, are collision shapes: they stand for meshes and unknown kinds. */
  standIns: number;
  /** Visual elements of a kind that nobody draws. */
  unknown: number;
}

/** @throws {UrdfFault} */
export function shapesOf(link: XmlElement, materials: Materials): LinkShapes {
  const seen = link.children.filter(({ name }) => name === 'visual');
  const drawn = seen.map((visual) => shapeOf(visual, materials));
  const shapes = drawn.filter(isShape);
  const meshes = drawn.filter((shape) => typeof shape === 'object' && 'address' in shape);
  const unknown = drawn.filter((shape) => shape === 'unknown').length;
  if (meshes.length + unknown === 0) return { shapes, meshes, standIns: 0, unknown };
  const first = seen[drawn.findIndex((shape) => !isShape(shape) && shape !== 'nothing')] as XmlElement;
  const colour = colourOfVisual(first, materials) ?? DEFAULT_COLOUR;
  const solid = link.children
    .filter(({ name }) => name === 'collision')
    .map((collision) => shapeOf(collision, materials))
    .filter(isShape)
    .map((shape) => ({ ...shape, colour }));
  return { shapes: [...shapes, ...solid], meshes, standIns: solid.length, unknown };
}

/** The materials outside the links. @throws {UrdfFault} */
export function materialsOf(robot: XmlElement): Materials {
  const found = new Map<string, number | null>();
  for (const material of robot.children) {
    const colour = material.name === 'material' ? childOf(material, 'color') : undefined;
    if (colour !== undefined) found.set(nameIn(material, 'name'), colourOf(colour));
  }
  return found;
}

type Drawn = LinkShape | MeshShape | 'unknown' | 'nothing';

function isShape(drawn: Drawn): drawn is LinkShape {
  return typeof drawn === 'object' && 'form' in drawn;
}

function shapeOf(element: XmlElement, materials: Materials): Drawn {
  const geometry = childOf(element, 'geometry');
  if (geometry === undefined) throw faultAt(element, `<${element.name}> has no geometry`);
  const [shape] = geometry.children;
  const pose = originOf(element);
  const colour = colourOfVisual(element, materials);
  if (colour === null) return 'nothing';
  if (shape?.name === 'mesh') return { ...meshOf(shape), pose, colour };
  const sized = shape === undefined ? null : sizeOf(shape);
  if (sized === null) return 'unknown';
  return sized.size.some((metres) => metres === 0) ? 'nothing' : { ...sized, pose, colour };
}

/** `null` for what cannot be drawn. */
function sizeOf(shape: XmlElement): Pick<LinkShape, 'form' | 'size'> | null {
  const metres = (key: string, count = 1) => {
    const read = numbers(shape, key, count, MAX_MODEL_M);
    if (read.some((number) => number < 0)) throw faultAt(shape, `${key} of <${shape.name}> is negative`);
    return read;
  };
  switch (shape.name) {
    case 'box':
      return { form: 'box', size: metres('size', 3) };
    case 'cylinder':
      return { form: 'cylinder', size: [...metres('radius'), ...metres('length')] };
    case 'sphere':
      return { form: 'sphere', size: metres('radius') };
    default:
      return null;
  }
}

function colourOfVisual(element: XmlElement, materials: Materials): number | null {
  const material = childOf(element, 'material');
  if (material === undefined) return DEFAULT_COLOUR;
  const own = childOf(material, 'color');
  if (own !== undefined) return colourOf(own);
  const named = materials.get(material.attributes.get('name')?.trim() ?? '');
  return named === undefined ? DEFAULT_COLOUR : named;
}
