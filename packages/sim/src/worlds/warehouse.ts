import type { Mover, WorldDescription } from '../world.ts';
import { ceiling, floor, type Wall, wallBoxes } from './building.ts';
import { cone, type Piece, pallet, place, shelf } from './furniture.ts';
import { OFFICE_MATERIALS } from './materials.ts';

const QUARTER = Math.PI / 2;

/** 20 m by 12 m. */
const WALLS: Wall[] = [
  { along: 'x', at: 0, from: -0.06, to: 20.06, material: 'wallWhite' },
  { along: 'x', at: 12, from: -0.06, to: 20.06, material: 'wallWhite' },
  { along: 'y', at: 0, from: 0.06, to: 11.94, material: 'wallBrick' },
  { along: 'y', at: 20, from: 0.06, to: 11.94, material: 'wallBrick' },
];

/** Rows of shelves, back to back, along y: aisles of 2.3 m between them. */
function rows(): Piece[] {
  const pieces: Piece[] = [];
  for (let row = 0; row < 4; row++) {
    const x = 4 + row * 3.2;
    for (let bay = 0; bay < 3; bay++) {
      const y = 3.4 + bay * 2.6;
      const seed = 31 + row * 10 + bay * 2;
      pieces.push(place(shelf(2.5, 2.0, 4, 'boxes', seed), { x, y, yaw: 0 }));
      pieces.push(place(shelf(2.5, 2.0, 4, 'boxes', seed + 1), { x: x - 0.02, y, yaw: Math.PI }));
    }
  }
  return pieces;
}

const THINGS: Piece[] = [
  ...rows(),
  place(pallet(41), { x: 1.2, y: 10.6, yaw: 0 }),
  place(pallet(42), { x: 18.8, y: 1.3, yaw: QUARTER }),
  place(pallet(43), { x: 9.0, y: 11.1, yaw: 0.3 }),
  place(cone(), { x: 5.5, y: 6.2, yaw: 0 }),
  place(cone(), { x: 11.4, y: 3.4, yaw: 0 }),
  place(cone(), { x: 19.2, y: 8.4, yaw: 0 }),
];

const person = { kind: 'person', second: 0x2c3e58 } as const;
const MOVERS: Mover[] = [
  {
    name: 'picker',
    ...person,
    speed: 1.1,
    colour: 0xe8751a,
    path: [
      { x: 2.2, y: 1.2 },
      { x: 17, y: 1.2 },
      { x: 17, y: 10.9 },
      { x: 15.4, y: 10.9 },
      { x: 15.4, y: 1.7 },
      { x: 2.2, y: 1.7 },
    ],
  },
  {
    name: 'packer',
    ...person,
    speed: 0.8,
    offset: 5,
    colour: 0x2f6fb7,
    path: [
      { x: 6.3, y: 1.5 },
      { x: 6.3, y: 10.6 },
      { x: 8.5, y: 10.3 },
      { x: 8.5, y: 1.5 },
    ],
  },
  {
    name: 'trolley',
    kind: 'cart',
    speed: 0.6,
    colour: 0xe9b82c,
    second: 0x6f7a85,
    path: [
      { x: 2.2, y: 2.2 },
      { x: 2.2, y: 9.4 },
      { x: 1.4, y: 9.4 },
      { x: 1.4, y: 2.2 },
    ],
  },
];

/** A warehouse: aisles between high shelves, two people who come out of them, and a cart. */
export function warehouseWorld(): WorldDescription {
  return {
    name: 'warehouse',
    start: { x: 10.3, y: 1.3, yaw: 0 },
    lampSpacing: 3,
    materials: OFFICE_MATERIALS,
    boxes: [...WALLS.flatMap(wallBoxes), ...THINGS.flatMap(({ boxes }) => boxes)],
    panels: [
      floor(0, 0, 20, 12, 'floorConcrete'),
      ceiling(0, 0, 20, 12, 'ceilingTile'),
      ...THINGS.flatMap(({ panels }) => panels),
    ],
    ellipsoids: THINGS.flatMap(({ ellipsoids }) => ellipsoids),
    movers: MOVERS,
  };
}
