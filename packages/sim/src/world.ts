import { SimulationError } from './errors.ts';

/**
 * A world as data. REP-103 axes: x forward, y left, z up, metres; yaw about z in radians. Colours are `0xRRGGBB`.
 * Materials have names, by which everything else refers to them.
 */
export interface WorldDescription {
  name: string;
  /** Where the robot starts. */
  start: PlanarPose;
  /** Where it charges; absent if the world has no dock. */
  dock?: PlanarPose;
  /** Distance between ceiling lamps along x and y. */
  lampSpacing: number;
  materials: Record<string, Material>;
  /** Solid boxes: walls, furniture, objects. They stop the robot unless their height is out of its reach. */
  boxes: Box[];
  /** Thin flat pictures: posters, signs, screens, floor markings. The robot passes through them. */
  panels: Panel[];
  /** Stationary round objects: plants, bins, balls. They stop the robot. */
  ellipsoids: Ellipsoid[];
  /** People and carts that move along closed paths. */
  movers: Mover[];
  /** Where the floor is missing, if it is anywhere. What shows them are the panels and boxes; these say where they are. */
  holes?: Hole[];
}

/** A rectangle without a floor, along the axes. */
export interface Hole {
  fromX: number;
  toX: number;
  fromY: number;
  toY: number;
  /** Of what is below it. */
  depth: number;
}

export interface PlanarPose {
  x: number;
  y: number;
  yaw: number;
}

interface MaterialBase {
  /** Main colour. */
  colour: number;
  /** Fraction of the surface on which a stereo matcher fails: glass 0.9, whiteboard 0.4, wallpaper 0. */
  unmatched?: number;
  /** 1 for lamps, screens and windows, which emit light. */
  emission?: number;
}

/** A procedural texture. Lengths in metres on the surface. */
export type Material =
  | (MaterialBase & { texture: 'flat' })
  | (MaterialBase & { texture: 'checker'; second: number; size: number })
  | (MaterialBase & {
      texture: 'tile';
      /** Colour of the joints. */
      second: number;
      width: number;
      height: number;
      joint: number;
      /** Shift of each row against the previous one, in tiles. */
      bond?: number;
    })
  | (MaterialBase & {
      texture: 'stripes';
      second: number;
      period: number;
      /** Fraction of the period in the second colour; default 0.5. */
      share?: number;
      /** 0 for vertical stripes, 1 for horizontal, 0.5 for diagonal ones. */
      turn?: number;
    })
  | (MaterialBase & { texture: 'grain'; second: number; size: number })
  | (MaterialBase & { texture: 'text'; second: number; lineHeight: number })
  | (MaterialBase & { texture: 'books'; width: number; height: number })
  | (MaterialBase & { texture: 'wood'; second: number; size: number })
  | (MaterialBase & { texture: 'picture'; second: number; width: number; height: number });

export interface Vector {
  x: number;
  y: number;
  z: number;
}

export interface Box {
  /** Centre of the box. */
  centre: Vector;
  /** Full lengths along its own axes. */
  size: Vector;
  yaw?: number;
  material: string;
  /** Materials of individual faces. `front` is the face towards +x of the box's own frame. */
  faces?: { front?: string; back?: string; left?: string; right?: string; top?: string; bottom?: string };
}

/** A rectangle that faces along `yaw`, or up or down. */
export interface Panel {
  centre: Vector;
  /** Horizontal size as seen from the front. */
  width: number;
  /** Vertical size; for a horizontal panel, the size along `yaw`. */
  height: number;
  /** Direction that the front faces. */
  yaw: number;
  level?: 'up' | 'down';
  material: string;
}

export interface Ellipsoid {
  centre: Vector;
  /** Full lengths. */
  size: Vector;
  material: string;
}

export interface Mover {
  name: string;
  kind: 'person' | 'cart';
  /** Corners of a closed path at floor level, walked repeatedly in this order. */
  path: { x: number; y: number }[];
  /** Walking speed, m/s. */
  speed: number;
  /** Distance along the path at the start, metres. */
  offset?: number;
  /** Shirt or cart colour. */
  colour: number;
  /** Trousers, or the cart's load. */
  second: number;
}

/** Index of the material with that name; throws `bad-world` if there is none. */
export function materialIndex(world: WorldDescription, name: string, user: string): number {
  const index = Object.keys(world.materials).indexOf(name);
  if (index < 0) throw new SimulationError('bad-world', user, `no material is named "${name}"`);
  return index;
}
