import type { Box, Panel } from '../world.ts';
import { box } from './furniture.ts';

/** Chosen: as in offices, metres. */
export const WALL_THICKNESS = 0.12;
export const ROOM_HEIGHT = 2.6;
const DOOR_HEIGHT = 2.05;
const TRIM = 0.08;

/** A doorway from `from` to `to` along its wall. */
export interface Doorway {
  from: number;
  to: number;
  trim: string;
}

/** A straight wall along x (at a fixed y) or along y (at a fixed x), with doorways. */
export interface Wall {
  along: 'x' | 'y';
  at: number;
  from: number;
  to: number;
  material: string;
  doors?: Doorway[];
}

/** The wall's boxes: segments, lintels, and a coloured trim around every doorway. */
export function wallBoxes(wall: Wall): Box[] {
  const piece = (
    from: number,
    to: number,
    bottom: number,
    top: number,
    thickness: number,
    material: string,
  ) => {
    const middle = (from + to) / 2;
    return wall.along === 'x'
      ? box(middle, wall.at, bottom, [to - from, thickness, top - bottom], material)
      : box(wall.at, middle, bottom, [thickness, to - from, top - bottom], material);
  };
  const boxes: Box[] = [];
  const doors = [...(wall.doors ?? [])].sort((a, b) => a.from - b.from);
  let start = wall.from;
  for (const door of doors) {
    boxes.push(piece(start, door.from - TRIM, 0, ROOM_HEIGHT, WALL_THICKNESS, wall.material));
    for (const edge of [door.from - TRIM, door.to]) {
      boxes.push(piece(edge, edge + TRIM, 0, DOOR_HEIGHT + TRIM, WALL_THICKNESS + 0.04, door.trim));
      boxes.push(piece(edge, edge + TRIM, DOOR_HEIGHT + TRIM, ROOM_HEIGHT, WALL_THICKNESS, wall.material));
    }
    boxes.push(piece(door.from, door.to, DOOR_HEIGHT, DOOR_HEIGHT + TRIM, WALL_THICKNESS + 0.04, door.trim));
    boxes.push(piece(door.from, door.to, DOOR_HEIGHT + TRIM, ROOM_HEIGHT, WALL_THICKNESS, wall.material));
    start = door.to + TRIM;
  }
  boxes.push(piece(start, wall.to, 0, ROOM_HEIGHT, WALL_THICKNESS, wall.material));
  // A dark skirting board shows where wall and floor meet.
  start = wall.from;
  for (const end of [...doors.map((door) => door.from - TRIM), wall.to]) {
    boxes.push(piece(start, end, 0, 0.1, WALL_THICKNESS + 0.02, 'skirting'));
    start = (doors.find((door) => door.from - TRIM === end)?.to ?? 0) + TRIM;
  }
  return boxes;
}

/** A rectangle of floor. */
export function floor(x0: number, y0: number, x1: number, y1: number, material: string, z = 0): Panel {
  return {
    centre: { x: (x0 + x1) / 2, y: (y0 + y1) / 2, z },
    width: Math.abs(y1 - y0),
    height: Math.abs(x1 - x0),
    yaw: 0,
    level: 'up',
    material,
  };
}

export function ceiling(
  x0: number,
  y0: number,
  x1: number,
  y1: number,
  material: string,
  z = ROOM_HEIGHT,
): Panel {
  return { ...floor(x0, y0, x1, y1, material, z), level: 'down' };
}

/** The four directions that a wall's face may look towards. */
export const FACING = { east: 0, north: Math.PI / 2, west: Math.PI, south: -Math.PI / 2 } as const;

/** Something flat on the face of a wall that looks in direction `facing`. */
export function onWall(
  x: number,
  y: number,
  z: number,
  facing: keyof typeof FACING,
  width: number,
  height: number,
  material: string,
): Panel {
  return { centre: { x, y, z }, width, height, yaw: FACING[facing], material };
}
