import type { Box, Hole, Mover, Panel, WorldDescription } from '../world.ts';
import { ceiling, floor, type Wall, wallBoxes } from './building.ts';
import { box, cone, emptyPiece, type Piece, pallet, place } from './furniture.ts';
import { OFFICE_MATERIALS } from './materials.ts';

/*
 *  12 ┌────────────────────────────┬─────┐
 *     │          hatch             │     │
 *     │   pit               ┌──────┘     │ yard,
 *     │        ┌─────┐      │stair  dock │ 1.1 m lower
 *     │        └─────┘      │down   edge │
 *     │   duct              └──────┐     │
 *     │                            │     │
 *   0 └────────────────────────────┴─────┘
 *     0                            14   18
 */
const WALLS: Wall[] = [
  { along: 'x', at: 0, from: -0.06, to: 18.06, material: 'wallWhite' },
  { along: 'x', at: 12, from: -0.06, to: 18.06, material: 'wallWhite' },
  { along: 'y', at: 0, from: 0.06, to: 11.94, material: 'wallBrick' },
  { along: 'y', at: 18, from: 0.06, to: 11.94, material: 'wallBrick' },
];

const YARD: Hole = { fromX: 14, toX: 18, fromY: 0, toY: 12, depth: 1.1 };
/** Three steps down into the yard, each 0.18 m lower and 0.3 m deep: cut into the floor. */
const STAIR: Hole = { fromX: 13.1, toX: 14, fromY: 5, toY: 6.6, depth: 0.18 };
const HOLES: Hole[] = [
  YARD,
  STAIR,
  // An inspection pit, a hatch that was left open, a duct without its cover.
  { fromX: 4, toX: 6.4, fromY: 5.4, toY: 6.6, depth: 1.4 },
  { fromX: 9, toX: 9.8, fromY: 8.6, toY: 9.4, depth: 2 },
  { fromX: 3, toX: 3.5, fromY: 1.8, toY: 3.6, depth: 0.6 },
];
/** The stair: steps, and the height of each, a usual one, metres. */
const STEPS = 3;
const RISE = 0.18;

/** The floor around the holes: strips between their edges. */
function floors(): Panel[] {
  const ys = [...new Set([0, 12, ...HOLES.flatMap(({ fromY, toY }) => [fromY, toY])])].sort((a, b) => a - b);
  return ys.slice(1).flatMap((high, i) => {
    const low = ys[i] as number;
    const middle = (low + high) / 2;
    const cuts = HOLES.filter(({ fromY, toY }) => fromY < middle && middle < toY);
    const strips: Panel[] = [];
    let from = 0;
    for (const { fromX, toX } of cuts.sort((a, b) => a.fromX - b.fromX)) {
      if (fromX > from) strips.push(floor(from, low, fromX, high, 'floorConcrete'));
      from = Math.max(from, toX);
    }
    if (from < 18) strips.push(floor(from, low, 18, high, 'floorConcrete'));
    return strips;
  });
}

/** The bottom and the sides of a hole. */
function shaft({ fromX, toX, fromY, toY, depth }: Hole): Box[] {
  const [x, y] = [(fromX + toX) / 2, (fromY + toY) / 2];
  const [length, width] = [toX - fromX, toY - fromY];
  const thick = 0.1;
  const side = (cx: number, cy: number, dx: number, dy: number) =>
    box(cx, cy, -depth, [dx, dy, depth - 0.001], 'skirting');
  return [
    box(x, y, -depth - thick, [length, width, thick], 'floorConcrete'),
    side(fromX - thick / 2, y, thick, width),
    side(toX + thick / 2, y, thick, width),
    side(x, fromY - thick / 2, length, thick),
    side(x, toY + thick / 2, length, thick),
  ];
}

function steps(): Box[] {
  return Array.from({ length: STEPS }, (_, i) => {
    const depth = RISE * (i + 1);
    const going = (STAIR.toX - STAIR.fromX) / STEPS;
    const x = STAIR.fromX + going * (i + 0.5);
    const width = STAIR.toY - STAIR.fromY;
    return box(
      x,
      (STAIR.fromY + STAIR.toY) / 2,
      -YARD.depth,
      [going, width, YARD.depth - depth],
      'floorConcrete',
    );
  });
}

const THINGS: Piece[] = [
  place(pallet(51), { x: 1.2, y: 10.6, yaw: 0 }),
  place(pallet(52), { x: 12.6, y: 1.2, yaw: 0.4 }),
  place(pallet(53), { x: 11.2, y: 10.9, yaw: 0 }),
  place(cone(), { x: 7.3, y: 3.2, yaw: 0 }),
  place(cone(), { x: 12.2, y: 7.6, yaw: 0 }),
  { ...emptyPiece(), boxes: [box(8, 6, 0, [0.4, 0.4, 2.6], 'steel')] },
];

const person = { kind: 'person', second: 0x2c3e58 } as const;
const MOVERS: Mover[] = [
  {
    name: 'loader',
    ...person,
    speed: 1.1,
    colour: 0xe8751a,
    path: [
      { x: 2, y: 4.4 },
      { x: 11.6, y: 4.4 },
      { x: 11.6, y: 2.6 },
      { x: 5, y: 2.6 },
    ],
  },
  {
    name: 'checker',
    ...person,
    speed: 0.8,
    offset: 4,
    colour: 0x2f6fb7,
    path: [
      { x: 2.4, y: 7.6 },
      { x: 7.6, y: 7.6 },
      { x: 7.6, y: 10.6 },
      { x: 3, y: 10.6 },
    ],
  },
];

/** A loading dock: an edge without a rail, a stair down, and holes in the floor. */
export function dockWorld(): WorldDescription {
  const shafts = HOLES.filter((hole) => hole !== STAIR).flatMap(shaft);
  return {
    name: 'dock',
    start: { x: 2, y: 9, yaw: 0 },
    lampSpacing: 3,
    materials: OFFICE_MATERIALS,
    boxes: [...WALLS.flatMap(wallBoxes), ...shafts, ...steps(), ...THINGS.flatMap(({ boxes }) => boxes)],
    panels: [...floors(), ceiling(0, 0, 18, 12, 'ceilingTile'), ...THINGS.flatMap(({ panels }) => panels)],
    ellipsoids: THINGS.flatMap(({ ellipsoids }) => ellipsoids),
    movers: MOVERS,
    holes: HOLES,
  };
}
