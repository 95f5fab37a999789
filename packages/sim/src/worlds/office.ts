import type { Panel, WorldDescription } from '../world.ts';
import { ceiling, floor, onWall, type Wall, wallBoxes } from './building.ts';
import {
  ball,
  box,
  chair,
  cone,
  desk,
  emptyPiece,
  type Piece,
  pallet,
  place,
  plant,
  shelf,
  sofa,
  table,
} from './furniture.ts';
import { OFFICE_MATERIALS } from './materials.ts';

const HALF_TURN = Math.PI;
const QUARTER = Math.PI / 2;

/*
 *  12 ┌───────────────────┬───────────────────────────────┐
 *     │ meeting           │ hall                          │
 *   7 ├─────────────door──┴──────opening───────────door───┤
 *     │ corridor                                          │
 *   5 ├──────door──────┬─────door────┬──────narrow door───┤
 *     │ office        door lab       │ storage            │
 *   0 └────────────────┴─────────────┴────────────────────┘
 *     0                7             13                  20
 */
const WALLS: Wall[] = [
  { along: 'x', at: 0, from: -0.06, to: 20.06, material: 'wallWhite' },
  { along: 'x', at: 12, from: -0.06, to: 20.06, material: 'wallWhite' },
  { along: 'y', at: 0, from: 0.06, to: 11.94, material: 'wallWhite' },
  { along: 'y', at: 20, from: 0.06, to: 11.94, material: 'wallBrick' },
  {
    along: 'x',
    at: 5,
    from: 0.06,
    to: 19.94,
    material: 'wallBlue',
    doors: [
      { from: 3, to: 4, trim: 'trimOak' },
      { from: 9.4, to: 10.5, trim: 'trimBlue' },
      { from: 16, to: 16.85, trim: 'trimYellow' },
    ],
  },
  {
    along: 'x',
    at: 7,
    from: 0.06,
    to: 19.94,
    material: 'wallSand',
    doors: [
      { from: 5.5, to: 6.5, trim: 'trimOak' },
      { from: 11, to: 13.5, trim: 'trimOak' },
      { from: 18, to: 19, trim: 'trimBlue' },
    ],
  },
  {
    along: 'y',
    at: 7,
    from: 0.06,
    to: 4.94,
    material: 'wallGreen',
    doors: [{ from: 2, to: 2.9, trim: 'trimOak' }],
  },
  { along: 'y', at: 13, from: 0.06, to: 4.94, material: 'wallGreen' },
  { along: 'y', at: 8, from: 7.06, to: 11.94, material: 'wallBlue' },
];

const FLOORS: Panel[] = [
  floor(0, 0, 7, 5, 'floorCarpet'),
  floor(7, 0, 13, 5, 'floorConcrete'),
  floor(13, 0, 20, 5, 'floorConcrete'),
  floor(0, 5, 20, 7, 'floorTile'),
  floor(0, 7, 8, 12, 'floorWood'),
  floor(8, 7, 20, 12, 'floorChecker'),
];

const MARKINGS: Panel[] = [
  floor(0.4, 5.97, 19.6, 6.03, 'lineYellow', 0.003),
  floor(9.4, 4.7, 10.5, 4.93, 'hazard', 0.004),
  floor(15.9, 4.5, 16.95, 4.93, 'hazard', 0.004),
  floor(15.9, 5.07, 16.95, 5.5, 'hazard', 0.004),
  floor(8.2, 0.4, 8.26, 4.6, 'lineYellow', 0.003),
  floor(11.6, 0.4, 11.66, 4.6, 'lineYellow', 0.003),
  floor(10, 9.1, 12.6, 10.9, 'rug', 0.004),
  floor(8.4, 8.0, 9.0, 8.6, 'lineBlue', 0.003),
];

const SIGNS: Panel[] = [
  onWall(3.5, 5.065, 2.35, 'north', 1.0, 0.2, 'sign'),
  onWall(9.95, 5.065, 2.35, 'north', 1.0, 0.2, 'sign'),
  onWall(16.42, 5.065, 2.35, 'north', 0.9, 0.2, 'sign'),
  onWall(6, 6.935, 2.35, 'south', 1.0, 0.2, 'sign'),
  onWall(12.25, 6.935, 2.35, 'south', 1.6, 0.2, 'signGreen'),
  onWall(12.25, 7.065, 2.35, 'north', 1.6, 0.2, 'signGreen'),
  onWall(18.5, 7.065, 2.35, 'north', 0.9, 0.2, 'sign'),
  // Corridor.
  onWall(1.6, 5.065, 1.5, 'north', 1.2, 0.9, 'poster1'),
  onWall(6.4, 5.065, 1.5, 'north', 1.2, 0.9, 'poster0'),
  onWall(12.4, 5.065, 1.5, 'north', 0.9, 1.2, 'notice'),
  onWall(14.4, 5.065, 1.5, 'north', 1.2, 0.9, 'poster2'),
  onWall(2.6, 6.935, 1.5, 'south', 0.9, 1.2, 'notice'),
  onWall(8.8, 6.935, 1.5, 'south', 1.2, 0.9, 'poster2'),
  onWall(15.6, 6.935, 1.5, 'south', 1.2, 0.9, 'poster1'),
  onWall(19.935, 6, 1.6, 'west', 1.2, 0.9, 'poster0'),
  onWall(0.065, 6, 1.6, 'east', 1.2, 0.9, 'poster2'),
  // Hall.
  onWall(10.2, 11.935, 1.55, 'south', 1.2, 0.9, 'poster0'),
  onWall(12.6, 11.935, 1.55, 'south', 1.6, 1.2, 'window'),
  onWall(15.0, 11.935, 1.55, 'south', 1.6, 1.2, 'window'),
  onWall(16.9, 11.935, 1.5, 'south', 0.9, 1.2, 'notice'),
  onWall(9.6, 7.065, 1.5, 'north', 1.2, 0.9, 'poster1'),
  onWall(15.6, 7.065, 1.5, 'north', 1.2, 0.9, 'poster2'),
  onWall(8.065, 9.5, 1.5, 'east', 1.2, 0.9, 'poster0'),
  onWall(19.935, 8.3, 1.5, 'west', 1.2, 0.9, 'poster1'),
  // Meeting room.
  onWall(0.065, 9.5, 1.5, 'east', 2.2, 1.3, 'projector'),
  onWall(3.5, 11.935, 1.5, 'south', 2.4, 1.2, 'whiteboard'),
  onWall(6.6, 11.935, 1.55, 'south', 1.2, 0.9, 'poster1'),
  onWall(7.935, 9.5, 1.55, 'west', 1.6, 1.2, 'notice'),
  // Office.
  onWall(1.6, 0.065, 1.55, 'north', 1.6, 1.2, 'window'),
  onWall(4.6, 0.065, 1.55, 'north', 1.6, 1.2, 'window'),
  onWall(0.065, 3.4, 1.5, 'east', 1.2, 0.9, 'poster2'),
  onWall(6.935, 4.0, 1.5, 'west', 0.9, 1.2, 'notice'),
  // Lab and storage.
  onWall(10, 0.065, 1.7, 'north', 2.4, 1.2, 'whiteboard'),
  onWall(7.065, 4.0, 1.5, 'east', 0.9, 1.2, 'notice'),
  onWall(12.935, 3.8, 1.5, 'west', 1.2, 0.9, 'poster0'),
  onWall(13.065, 4.2, 1.5, 'east', 0.9, 1.2, 'notice'),
  onWall(18.6, 4.935, 1.5, 'south', 1.2, 0.9, 'poster1'),
];

function lamps(): Panel[] {
  const panels: Panel[] = [];
  for (let x = 1.5; x < 20; x += 3) {
    for (const y of [1.5, 3.75, 6, 8.25, 10.5])
      panels.push(ceiling(x - 0.6, y - 0.15, x + 0.6, y + 0.15, 'lamp', 2.595));
  }
  return panels;
}

const OFFICE: Piece[] = [
  place(desk(1), { x: 1.5, y: 1.2, yaw: QUARTER }),
  place(chair('fabric'), { x: 1.5, y: 1.95, yaw: QUARTER + 0.3 }),
  place(desk(2), { x: 4.7, y: 1.2, yaw: QUARTER }),
  place(chair('fabricRed'), { x: 4.6, y: 2.0, yaw: QUARTER - 0.5 }),
  place(shelf(1.8, 1.9, 5, 'books', 3), { x: 0.06, y: 3.6, yaw: 0 }),
  place(shelf(1.4, 1.9, 5, 'books', 4), { x: 5.7, y: 4.94, yaw: -QUARTER }),
  place(plant(1.0), { x: 6.5, y: 0.5, yaw: 0 }),
  { ...emptyPiece(), boxes: [box(3.1, 0.5, 0, [0.3, 0.3, 0.4], 'steel')] },
];

const LAB: Piece[] = [
  place(table(2.6, 0.8, 0.9, 'counter'), { x: 10, y: 0.55, yaw: 0 }),
  {
    ...emptyPiece(),
    boxes: [
      box(9.1, 0.5, 0.9, [0.4, 0.35, 0.3], 'teal'),
      box(9.7, 0.45, 0.9, [0.3, 0.3, 0.45], 'cream', { left: 'label' }),
      box(10.5, 0.5, 0.9, [0.5, 0.3, 0.2], 'orange'),
      box(11.0, 0.4, 0.9, [0.2, 0.2, 0.5], 'blue'),
    ],
  },
  place(pallet(5), { x: 7.75, y: 0.75, yaw: QUARTER }),
  place(pallet(6), { x: 12.4, y: 1.1, yaw: QUARTER }),
  place(shelf(1.6, 1.8, 4, 'boxes', 7), { x: 12.94, y: 3.0, yaw: HALF_TURN }),
  place(cone(), { x: 11.2, y: 4.5, yaw: 0 }),
  place(cone(), { x: 8.7, y: 4.6, yaw: 0 }),
];

const STORAGE: Piece[] = [
  place(shelf(2.6, 2.0, 4, 'boxes', 11), { x: 14.5, y: 0.06, yaw: QUARTER }),
  place(shelf(2.6, 2.0, 4, 'boxes', 12), { x: 18.2, y: 0.06, yaw: QUARTER }),
  place(shelf(2.2, 2.0, 4, 'boxes', 13), { x: 19.94, y: 2.8, yaw: HALF_TURN }),
  place(shelf(1.6, 2.0, 4, 'boxes', 14), { x: 13.06, y: 2.6, yaw: 0 }),
  place(shelf(2.0, 1.6, 3, 'boxes', 15), { x: 16.4, y: 2.1, yaw: QUARTER }),
  place(shelf(2.0, 1.6, 3, 'boxes', 16), { x: 16.4, y: 2.09, yaw: -QUARTER }),
  place(pallet(17), { x: 18.6, y: 4.2, yaw: 0 }),
  place(pallet(18), { x: 14.3, y: 4.3, yaw: 0 }),
];

const MEETING: Piece[] = [
  place(table(3.2, 1.3, 0.75, 'darkWood'), { x: 3.6, y: 9.5, yaw: 0 }),
  ...[2.5, 3.6, 4.7].flatMap((x) => [
    place(chair('fabric'), { x, y: 10.55, yaw: QUARTER }),
    place(chair('fabricRed'), { x, y: 8.45, yaw: -QUARTER }),
  ]),
  {
    ...emptyPiece(),
    boxes: [
      box(3.4, 9.6, 0.75, [0.34, 0.24, 0.02], 'darkMetal', { top: 'keyboard' }),
      box(4.4, 9.2, 0.75, [0.3, 0.21, 0.01], 'paper'),
    ],
    ellipsoids: [ball(2.9, 9.3, 0.82, [0.1, 0.1, 0.14], 'green')],
  },
  place(plant(1.1), { x: 0.5, y: 11.5, yaw: 0 }),
  place(plant(0.9), { x: 7.5, y: 7.5, yaw: 0 }),
];

const HALL: Piece[] = [
  place(sofa('fabric', 'orange'), { x: 11.3, y: 11.45, yaw: -QUARTER }),
  place(sofa('fabricRed', 'cream'), { x: 14.2, y: 11.45, yaw: -QUARTER }),
  place(table(1.0, 0.6, 0.42, 'wood'), { x: 12.75, y: 11.2, yaw: QUARTER }),
  place(plant(1.2), { x: 9.4, y: 11.5, yaw: 0 }),
  place(plant(1.0), { x: 14.1, y: 7.45, yaw: 0 }),
  {
    ...emptyPiece(),
    boxes: [box(13.2, 9.3, 0, [0.4, 0.4, 2.6], 'wallBrick'), box(16.6, 9.3, 0, [0.4, 0.4, 2.6], 'wallBrick')],
  },
  // Kitchenette along the east wall.
  {
    ...emptyPiece(),
    boxes: [
      box(19.62, 10.4, 0, [0.64, 3.0, 0.86], 'cupboard'),
      box(19.6, 10.4, 0.86, [0.68, 3.04, 0.04], 'counter'),
      box(19.76, 10.4, 1.5, [0.36, 2.4, 0.7], 'cupboard'),
      box(19.6, 9.3, 0.9, [0.3, 0.34, 0.36], 'steel', { back: 'black' }),
      box(19.6, 10.4, 0.9, [0.2, 0.16, 0.3], 'red'),
    ],
    ellipsoids: [
      ball(19.5, 11.0, 0.95, [0.1, 0.1, 0.11], 'yellow'),
      ball(19.5, 11.2, 0.95, [0.1, 0.1, 0.11], 'blue'),
      ball(19.5, 11.4, 0.95, [0.1, 0.1, 0.11], 'green'),
    ],
  },
  place(shelf(1.6, 1.9, 5, 'books', 21), { x: 17.0, y: 7.06, yaw: QUARTER }),
  place(table(0.8, 0.8, 0.74, 'wood'), { x: 18.0, y: 11.2, yaw: 0.2 }),
  place(chair('green'), { x: 17.3, y: 11.2, yaw: HALF_TURN }),
  // Charging dock in the south-west corner.
  { ...emptyPiece(), boxes: [box(8.14, 8.3, 0, [0.16, 0.5, 0.35], 'dock')] },
  place(cone(), { x: 10.5, y: 7.5, yaw: 0 }),
];

const CORRIDOR: Piece[] = [
  place(plant(0.9), { x: 0.4, y: 6.6, yaw: 0 }),
  {
    ...emptyPiece(),
    ellipsoids: [
      ball(7.4, 5.17, 0.75, [0.16, 0.16, 0.5], 'red'),
      ball(14.9, 6.83, 0.75, [0.16, 0.16, 0.5], 'red'),
    ],
  },
  { ...emptyPiece(), boxes: [box(0.25, 5.3, 0, [0.35, 0.35, 0.95], 'steel', { front: 'label' })] },
];

/** The floor of an office building: six rooms, three people and a cart. */
export function officeWorld(): WorldDescription {
  const pieces = [...OFFICE, ...LAB, ...STORAGE, ...MEETING, ...HALL, ...CORRIDOR];
  return {
    name: 'office',
    start: { x: 9.2, y: 9.6, yaw: 0 },
    dock: { x: 8.5, y: 8.3, yaw: 0 },
    lampSpacing: 3,
    materials: OFFICE_MATERIALS,
    boxes: [...WALLS.flatMap(wallBoxes), ...pieces.flatMap((piece) => piece.boxes)],
    panels: [
      ...FLOORS,
      ...MARKINGS,
      ...SIGNS,
      ceiling(0, 0, 20, 12, 'ceilingTile'),
      ...lamps(),
      ...pieces.flatMap((piece) => piece.panels),
    ],
    ellipsoids: pieces.flatMap((piece) => piece.ellipsoids),
    movers: [
      {
        name: 'visitor',
        kind: 'person',
        path: [
          { x: 10.6, y: 8.2 },
          { x: 17.6, y: 8.2 },
          { x: 17.6, y: 10.2 },
          { x: 10.6, y: 10.2 },
        ],
        speed: 0.9,
        offset: 2.5,
        colour: 0xd24d3e,
        second: 0x2c3e58,
      },
      {
        name: 'technician',
        kind: 'person',
        path: [
          { x: 9.75, y: 5 },
          { x: 9.75, y: 4.2 },
          { x: 9.0, y: 2.2 },
          { x: 11.2, y: 2.2 },
          { x: 10.15, y: 4.2 },
          { x: 10.15, y: 5 },
        ],
        speed: 0.8,
        colour: 0x2f8f6b,
        second: 0x4a4038,
      },
      {
        name: 'colleague',
        kind: 'person',
        path: [
          { x: 16.2, y: 10.9 },
          { x: 16.1, y: 11.3 },
          { x: 16.5, y: 11.2 },
        ],
        speed: 0,
        colour: 0x3a66b0,
        second: 0x26282c,
      },
      {
        name: 'cart',
        kind: 'cart',
        path: [
          { x: 1.4, y: 5.55 },
          { x: 18.4, y: 5.55 },
          { x: 18.4, y: 6.45 },
          { x: 1.4, y: 6.45 },
        ],
        speed: 0.6,
        offset: 9,
        colour: 0xe0a020,
        second: 0xb98d5b,
      },
    ],
  };
}
