/** What is drawn of a link: the boxes, cylinders and spheres of its `visual` elements. */
import { MAX_MODEL_M, type ModelShape, type Pose } from '@farpoint/protocol';
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
  /** Meshes for which the link's collision shapes stand, and meshes for which nothing stands. */
  replaced: number;
  missing: number;
}

/** @throws {UrdfFault} */
export function shapesOf(link: XmlElement, materials: Materials): LinkShapes {
  const seen = link.children.filter(({ name }) => name === 'visual');
  const drawn = seen.map((visual) => shapeOf(visual, materials));
  const shapes = drawn.filter((shape) => shape !== 'mesh' && shape !== 'nothing');
  const meshes = seen.filter((_, i) => drawn[i] === 'mesh');
  if (meshes.length === 0) return { shapes, replaced: 0, missing: 0 };
  const colour = colourOfVisual(meshes[0] as XmlElement, materials) ?? DEFAULT_COLOUR;
  const solid = link.children
    .filter(({ name }) => name === 'collision')
    .map((collision) => shapeOf(collision, materials))
    .filter((shape) => shape !== 'mesh' && shape !== 'nothing')
    .map((shape) => ({ ...shape, colour }));
  const stands = solid.length > 0;
  return {
    shapes: [...shapes, ...solid],
    replaced: stands ? meshes.length : 0,
    missing: stands ? 0 : meshes.length,
  };
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

function shapeOf(element: XmlElement, materials: Materials): LinkShape | 'mesh' | 'nothing' {
  const geometry = childOf(element, 'geometry');
  if (geometry === undefined) throw faultAt(element, `<${element.name}> has no geometry`);
  const [shape] = geometry.children;
  const sized = shape === undefined ? null : sizeOf(shape);
  if (sized === null) return 'mesh';
  const pose = originOf(element);
  const colour = colourOfVisual(element, materials);
  return colour === null || sized.size.some((metres) => metres === 0)
    ? 'nothing'
    : { ...sized, pose, colour };
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
