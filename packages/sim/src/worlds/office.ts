import type { Panel, WorldDescription } from '../world.ts';
import { ceiling, floor, onWall, type Wall, wallBoxes } from './building.ts';
import { OFFICE_MATERIALS } from './materials.ts';
import { OFFICE_PIECES } from './office-furniture.ts';

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

const MOVERS: WorldDescription['movers'] = [
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
];

/** The floor of an office building: six rooms, three people and a cart. */
export function officeWorld(): WorldDescription {
  return {
    name: 'office',
    start: { x: 9.2, y: 9.6, yaw: 0 },
    dock: { x: 8.5, y: 8.3, yaw: 0 },
    lampSpacing: 3,
    materials: OFFICE_MATERIALS,
    boxes: [...WALLS.flatMap(wallBoxes), ...OFFICE_PIECES.flatMap((piece) => piece.boxes)],
    panels: [
      ...FLOORS,
      ...MARKINGS,
      ...SIGNS,
      ceiling(0, 0, 20, 12, 'ceilingTile'),
      ...lamps(),
      ...OFFICE_PIECES.flatMap((piece) => piece.panels),
    ],
    ellipsoids: OFFICE_PIECES.flatMap((piece) => piece.ellipsoids),
    movers: MOVERS,
  };
}
