/** The furniture in the rooms of the office (office.ts has the plan). */
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

const HALF_TURN = Math.PI;
const QUARTER = Math.PI / 2;

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

export const OFFICE_PIECES: readonly Piece[] = [
  ...OFFICE,
  ...LAB,
  ...STORAGE,
  ...MEETING,
  ...HALL,
  ...CORRIDOR,
];
