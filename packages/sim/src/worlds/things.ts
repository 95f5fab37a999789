import type { WorldDescription } from '../world.ts';
import { box } from './furniture.ts';

/** A box on the floor, placed by where the robot starts. Metres. */
export interface Thing {
  ahead: number;
  left: number;
  height: number;
}

/** Along each side, metres. */
export const THING_SIZE = 0.3;

/** The world with boxes before, beside or behind the robot's start. */
export function withThings(world: WorldDescription, things: readonly Thing[]): WorldDescription {
  const { x, y, yaw } = world.start;
  const [c, s] = [Math.cos(yaw), Math.sin(yaw)];
  const boxes = things.map(({ ahead, left, height }) => ({
    ...box(x + ahead * c - left * s, y + ahead * s + left * c, 0, [THING_SIZE, THING_SIZE, height], 'orange'),
    yaw,
  }));
  return { ...world, boxes: [...world.boxes, ...boxes] };
}
