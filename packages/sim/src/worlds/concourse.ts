import type { Mover, WorldDescription } from '../world.ts';
import { ceiling, floor, type Wall, wallBoxes } from './building.ts';
import { ball, box, emptyPiece, type Piece, place, plant, sofa } from './furniture.ts';
import { OFFICE_MATERIALS } from './materials.ts';

/** 18 m by 14 m. */
const WALLS: Wall[] = [
  { along: 'x', at: 0, from: -0.06, to: 18.06, material: 'wallSand' },
  { along: 'x', at: 14, from: -0.06, to: 18.06, material: 'wallSand' },
  { along: 'y', at: 0, from: 0.06, to: 13.94, material: 'wallGreen' },
  { along: 'y', at: 18, from: 0.06, to: 13.94, material: 'wallBlue' },
];

const PILLARS: Piece = {
  ...emptyPiece(),
  boxes: [4.5, 9, 13.5].flatMap((x) => [4.5, 9.5].map((y) => box(x, y, 0, [0.5, 0.5, 2.6], 'steel'))),
};

const THINGS: Piece[] = [
  PILLARS,
  place(sofa('fabric', 'red'), { x: 1.2, y: 7, yaw: 0 }),
  place(sofa('fabricRed', 'cream'), { x: 16.8, y: 7, yaw: Math.PI }),
  place(plant(1.1), { x: 0.7, y: 0.8, yaw: 0 }),
  place(plant(1.0), { x: 17.3, y: 13.2, yaw: 0 }),
  { ...emptyPiece(), ellipsoids: [ball(9, 7, 0.25, [0.5, 0.5, 0.5], 'yellow')] },
  // A low step and a suitcase: nearer than half a metre, the camera sees neither.
  { ...emptyPiece(), boxes: [box(6.7, 12.6, 0, [1.2, 0.8, 0.12], 'wood')] },
  { ...emptyPiece(), boxes: [box(11.5, 3.6, 0, [0.5, 0.25, 0.4], 'blue')] },
];

/** A person who walks round a rectangle. */
function walker(
  name: string,
  [left, low, right, high]: readonly [number, number, number, number],
  speed: number,
  colour: number,
): Mover {
  const path = [
    { x: left, y: low },
    { x: right, y: low },
    { x: right, y: high },
    { x: left, y: high },
  ];
  return { name, kind: 'person', path, speed, colour, second: 0x26282c };
}

const MOVERS: Mover[] = [
  walker('traveller', [2.6, 2.2, 15.6, 2.9], 1.4, 0xd24d3e),
  walker('guide', [3.2, 3.6, 3.6, 11.6], 1.0, 0x2f8f6b),
  walker('runner', [6.4, 5.4, 11.4, 6.2], 1.8, 0x7a4a9c),
  walker('family', [6.6, 7.8, 7.6, 11.4], 0.7, 0x3a66b0),
  walker('cleaner', [10.4, 8, 12.4, 12.4], 0.5, 0xe9b82c),
  walker('late', [14.4, 4, 15.4, 12], 1.6, 0x1e8c8c),
];

/** A concourse: a wide hall with pillars and low things on the floor, and six people who cross it. */
export function concourseWorld(): WorldDescription {
  return {
    name: 'concourse',
    start: { x: 9, y: 1.2, yaw: Math.PI / 2 },
    lampSpacing: 3,
    materials: OFFICE_MATERIALS,
    boxes: [...WALLS.flatMap(wallBoxes), ...THINGS.flatMap(({ boxes }) => boxes)],
    panels: [
      floor(0, 0, 18, 14, 'floorTile'),
      ceiling(0, 0, 18, 14, 'ceilingTile'),
      ...THINGS.flatMap(({ panels }) => panels),
    ],
    ellipsoids: THINGS.flatMap(({ ellipsoids }) => ellipsoids),
    movers: MOVERS,
  };
}
