import { SimulationError } from './errors.ts';
import { figureOf, type Part } from './figures.ts';
import { boxFaces, ellipsoidFaces, type Face, rectangle, type Triple } from './mesh.ts';
import { cos, sin } from './trigonometry.ts';
import { type Material, materialIndex, type Panel, type WorldDescription } from './world.ts';

// The layout is defined by the camera (crate sim-camera, scene.rs).
const VERSION = 1;
const MATERIAL_LENGTH = 16;

const TEXTURES = [
  'flat',
  'checker',
  'tile',
  'stripes',
  'grain',
  'text',
  'books',
  'wood',
  'smooth',
  'picture',
] as const;

/** A world in the camera's format. */
export interface CompiledScene {
  numbers: Float32Array;
  /** Rigid bodies; the first contains everything stationary. */
  bodyCount: number;
  /** For each mover of the world, its parts and the body number of the first. */
  figures: { parts: Part[]; firstBody: number }[];
}

/**
 * Converts a world to the camera's flat buffer.
 *
 * @throws SimulationError `bad-world` for an undefined material
 */
export function compileScene(world: WorldDescription): CompiledScene {
  const materials = Object.values(world.materials).map(materialNumbers);
  const plain = new Map<string, number>();
  /** A material of one colour, created when first requested. */
  const plainMaterial = (colour: number, smooth: boolean): number => {
    const key = `${colour} ${smooth}`;
    let index = plain.get(key);
    if (index === undefined) {
      index = materials.length;
      plain.set(key, index);
      materials.push(blank(smooth ? 'smooth' : 'flat', colour));
    }
    return index;
  };

  const faces: number[][] = [];
  const add = (body: number, material: number, face: Face) => {
    const corners = face.corners.flat();
    while (corners.length < 12) corners.push(0);
    faces.push([body, material, face.corners.length, ...corners, ...face.u, ...face.v, 0]);
  };

  world.boxes.forEach((box, i) => {
    const what = `boxes[${i}]`;
    for (const length of [box.size.x, box.size.y, box.size.z]) {
      if (!(length > 0)) throw new SimulationError('bad-world', what, `a side is ${length} m long`);
    }
    const yaw = box.yaw ?? 0;
    for (const [side, face] of boxFaces(box.centre, box.size, cos(yaw), sin(yaw))) {
      add(0, materialIndex(world, box.faces?.[side] ?? box.material, what), face);
    }
  });
  world.panels.forEach((panel, i) => {
    add(0, materialIndex(world, panel.material, `panels[${i}]`), panelFace(panel));
  });
  world.ellipsoids.forEach((body, i) => {
    materialIndex(world, body.material, `ellipsoids[${i}]`);
    const material = plainMaterial(world.materials[body.material]!.colour, true);
    for (const face of ellipsoidFaces(body.centre, body.size)) add(0, material, face);
  });

  let bodyCount = 1;
  const figures = world.movers.map((mover) => {
    const parts = figureOf(mover);
    const firstBody = bodyCount;
    for (const part of parts) {
      for (const { face, colour, smooth } of part.faces) add(bodyCount, plainMaterial(colour, smooth), face);
      bodyCount++;
    }
    return { parts, firstBody };
  });

  const header = [VERSION, bodyCount, materials.length, faces.length, world.lampSpacing];
  return {
    numbers: Float32Array.from([...header, ...materials.flat(), ...faces.flat()]),
    bodyCount,
    figures,
  };
}

function panelFace(panel: Panel): Face {
  const middle: Triple = [panel.centre.x, panel.centre.y, panel.centre.z];
  const [c, s] = [cos(panel.yaw), sin(panel.yaw)];
  // Seen from the front, u grows to the right and v upwards.
  const right: Triple = [-s, c, 0];
  if (panel.level === 'up') return rectangle(middle, [s, -c, 0], [c, s, 0], panel.width, panel.height);
  if (panel.level === 'down') return rectangle(middle, right, [c, s, 0], panel.width, panel.height);
  return rectangle(middle, right, [0, 0, 1], panel.width, panel.height);
}

function blank(texture: (typeof TEXTURES)[number], colour: number): number[] {
  const numbers = new Array<number>(MATERIAL_LENGTH).fill(0);
  numbers[0] = TEXTURES.indexOf(texture);
  channels(colour).forEach((level, i) => {
    numbers[1 + i] = level;
  });
  return numbers;
}

function materialNumbers(material: Material, index: number): number[] {
  const numbers = blank(material.texture, material.colour);
  if ('second' in material) {
    channels(material.second).forEach((level, i) => {
      numbers[4 + i] = level;
    });
  }
  parameters(material).forEach((parameter, i) => {
    numbers[7 + i] = parameter;
  });
  numbers[11] = index * 7 + 1;
  numbers[12] = material.unmatched ?? 0;
  numbers[13] = material.emission ?? 0;
  return numbers;
}

function parameters(material: Material): number[] {
  switch (material.texture) {
    case 'flat':
      return [];
    case 'checker':
    case 'grain':
    case 'wood':
      return [material.size];
    case 'tile':
      return [material.width, material.height, material.joint, material.bond ?? 0];
    case 'stripes':
      return [material.period, material.share ?? 0.5, material.turn ?? 0];
    case 'text':
      return [material.lineHeight];
    case 'books':
    case 'picture':
      return [material.width, material.height];
  }
}

function channels(colour: number): number[] {
  return [(colour >> 16) & 255, (colour >> 8) & 255, colour & 255].map((level) => level / 255);
}
