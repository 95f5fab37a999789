/** What is drawn of a link: the boxes, cylinders and spheres of its `visual` elements. */
import { MAX_MODEL_M, type ModelShape, type Pose } from '@farpoint/protocol';
import { UrdfFault } from './urdf-fault.ts';
import { childOf, colourOf, numbers, originOf } from './urdf-values.ts';
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
  /** Shapes whose values are none, or which are too large. */
  unread: number;
}

/** What is not a shape: a mesh, what cannot be seen, and what cannot be read. */
type NoShape = 'mesh' | 'nothing' | 'unread';

/** Of one link. A shape that is at fault is left out: the others are still worth seeing. */
export function shapesOf(link: XmlElement, materials: Materials): LinkShapes {
  const seen = link.children.filter(({ name }) => name === 'visual');
  const drawn = seen.map((visual) => shapeOf(visual, materials));
  const shapes = drawn.filter(isShape);
  const unread = drawn.filter((shape) => shape === 'unread').length;
  const meshes = seen.filter((_, i) => drawn[i] === 'mesh');
  if (meshes.length === 0) return { shapes, replaced: 0, missing: 0, unread };
  const colour = colourOfVisual(meshes[0] as XmlElement, materials) ?? DEFAULT_COLOUR;
  const solid = link.children
    .filter(({ name }) => name === 'collision')
    .map((collision) => shapeOf(collision, materials))
    .filter(isShape)
    .map((shape) => ({ ...shape, colour }));
  const stands = solid.length > 0;
  return {
    shapes: [...shapes, ...solid],
    replaced: stands ? meshes.length : 0,
    missing: stands ? 0 : meshes.length,
    unread,
  };
}

function isShape(shape: LinkShape | NoShape): shape is LinkShape {
  return typeof shape !== 'string';
}

/** The materials with a colour, by name: those outside the links first, then those that links define. */
export function materialsOf(robot: XmlElement): Materials {
  const found = new Map<string, number | null>();
  const visuals = robot.children
    .filter(({ name }) => name === 'link')
    .flatMap(({ children }) => children.filter(({ name }) => name === 'visual'));
  for (const material of [robot, ...visuals].flatMap(({ children }) => children)) {
    const name = material.name === 'material' ? material.attributes.get('name') : undefined;
    const colour = name === undefined ? undefined : ownColour(material);
    if (name !== undefined && colour !== undefined && !found.has(name)) found.set(name, colour);
  }
  return found;
}

function shapeOf(element: XmlElement, materials: Materials): LinkShape | NoShape {
  try {
    return readShape(element, materials);
  } catch (error) {
    if (error instanceof UrdfFault) return 'unread';
    throw error;
  }
}

function readShape(element: XmlElement, materials: Materials): LinkShape | NoShape {
  const [shape] = childOf(element, 'geometry')?.children ?? [];
  if (shape === undefined) return 'unread';
  const sized = sizeOf(shape);
  if (sized === null) return 'mesh';
  const colour = colourOfVisual(element, materials);
  if (colour === null || sized.size.some((metres) => metres === 0)) return 'nothing';
  return sized.size.every((metres) => metres > 0 && metres <= MAX_MODEL_M)
    ? { ...sized, pose: originOf(element), colour }
    : 'unread';
}

/** `null` for what cannot be drawn. @throws {UrdfFault} */
function sizeOf(shape: XmlElement): Pick<LinkShape, 'form' | 'size'> | null {
  const metres = (key: string, count = 1) => numbers(shape, key, count);
  switch (shape.name) {
    case 'box':
      return { form: 'box', size: metres('size', 3) };
    case 'cylinder':
      return { form: 'cylinder', size: [...metres('radius'), ...metres('length')] };
    case 'capsule': {
      // Drawn as the cylinder around it.
      const [radius = 0, length = 0] = [...metres('radius'), ...metres('length')];
      return { form: 'cylinder', size: [radius, length + 2 * radius] };
    }
    case 'sphere':
      return { form: 'sphere', size: metres('radius') };
    default:
      return null;
  }
}

function colourOfVisual(element: XmlElement, materials: Materials): number | null {
  const material = childOf(element, 'material');
  if (material === undefined) return DEFAULT_COLOUR;
  const own = ownColour(material);
  if (own !== undefined) return own;
  const named = materials.get(material.attributes.get('name') ?? '');
  return named === undefined ? DEFAULT_COLOUR : named;
}

/** `undefined` if it has none that can be read. */
function ownColour(material: XmlElement): number | null | undefined {
  const colour = childOf(material, 'color');
  if (colour === undefined) return undefined;
  try {
    return colourOf(colour);
  } catch (error) {
    if (error instanceof UrdfFault) return undefined;
    throw error;
  }
}
