import { cos, sin } from '../trigonometry.ts';
import type { Box, Ellipsoid, Panel, PlanarPose } from '../world.ts';

/** Boxes, panels and round objects that belong together, in the frame of the piece: x is its front. */
export interface Piece {
  boxes: Box[];
  panels: Panel[];
  ellipsoids: Ellipsoid[];
}

export function emptyPiece(): Piece {
  return { boxes: [], panels: [], ellipsoids: [] };
}

/** A box, given its centre on the floor plan, the height of its underside, and its size. */
export function box(
  x: number,
  y: number,
  bottom: number,
  size: readonly [number, number, number],
  material: string,
  faces?: Box['faces'],
): Box {
  const [length, width, height] = size;
  return {
    centre: { x, y, z: bottom + height / 2 },
    size: { x: length, y: width, z: height },
    material,
    ...(faces && { faces }),
  };
}

export function ball(
  x: number,
  y: number,
  z: number,
  size: readonly [number, number, number],
  material: string,
): Ellipsoid {
  return { centre: { x, y, z }, size: { x: size[0], y: size[1], z: size[2] }, material };
}

/** The piece at its position in the world. */
export function place(piece: Partial<Piece>, at: PlanarPose): Piece {
  const [c, s] = [cos(at.yaw), sin(at.yaw)];
  const move = <T extends { centre: { x: number; y: number; z: number } }>(thing: T): T => ({
    ...thing,
    centre: {
      x: at.x + thing.centre.x * c - thing.centre.y * s,
      y: at.y + thing.centre.x * s + thing.centre.y * c,
      z: thing.centre.z,
    },
  });
  return {
    boxes: (piece.boxes ?? []).map((b) => ({ ...move(b), yaw: (b.yaw ?? 0) + at.yaw })),
    panels: (piece.panels ?? []).map((p) => ({ ...move(p), yaw: p.yaw + at.yaw })),
    ellipsoids: (piece.ellipsoids ?? []).map(move),
  };
}

/** Repeatable choices for objects on shelves: a small counter-based generator. */
export function chooser(seed: number): (count: number) => number {
  let state = seed;
  return (count) => {
    state = (Math.imul(state ^ (state >>> 15), 0x2c1b3c6d) + 0x9e3779b9) >>> 0;
    return Math.floor((((state ^ (state >>> 13)) >>> 0) / 4294967296) * count);
  };
}

const THINGS = ['red', 'orange', 'yellow', 'green', 'teal', 'blue', 'purple', 'cream', 'cardboard'] as const;

/** A shelf with its back at x = 0; every level holds books or boxes of many colours. */
export function shelf(
  width: number,
  height: number,
  levels: number,
  fill: 'books' | 'boxes',
  seed: number,
): Piece {
  const depth = 0.4;
  const pick = chooser(seed);
  const boxes: Box[] = [
    box(0.01, 0, 0, [0.02, width, height], 'shelfBack'),
    box(depth / 2, width / 2 - 0.02, 0, [depth, 0.04, height], 'shelfWood'),
    box(depth / 2, -width / 2 + 0.02, 0, [depth, 0.04, height], 'shelfWood'),
  ];
  const pitch = (height - 0.08) / levels;
  for (let level = 0; level <= levels; level++) {
    const bottom = 0.06 + level * pitch;
    boxes.push(box(depth / 2 + 0.01, 0, bottom - 0.03, [depth - 0.02, width - 0.08, 0.03], 'shelfWood'));
    if (level === levels) continue;
    if (fill === 'books') {
      boxes.push(
        box(0.16, 0, bottom, [0.26, width - 0.1, pitch - 0.05], 'shelfBack', { front: `books${level % 3}` }),
      );
      continue;
    }
    let y = -width / 2 + 0.1;
    while (y < width / 2 - 0.3) {
      const wide = 0.16 + 0.04 * pick(6);
      const tall = Math.min(pitch - 0.06, 0.14 + 0.04 * pick(6));
      const material = THINGS[pick(THINGS.length)] ?? 'cardboard';
      const label = pick(2) === 0 ? { front: 'label' } : undefined;
      if (pick(6) > 0) boxes.push(box(0.2, y + wide / 2, bottom, [0.3, wide, tall], material, label));
      y += wide + 0.03 + 0.02 * pick(3);
    }
  }
  return { ...emptyPiece(), boxes };
}

/** A desk with a screen; the person sits on the +x side. */
export function desk(seed: number): Piece {
  const pick = chooser(seed);
  return {
    boxes: [
      box(0, 0, 0.71, [0.75, 1.5, 0.04], 'wood'),
      box(0, 0.7, 0, [0.65, 0.04, 0.71], 'darkMetal'),
      box(0, -0.7, 0, [0.65, 0.04, 0.71], 'darkMetal'),
      box(-0.33, 0, 0.25, [0.03, 1.36, 0.42], 'cream'),
      box(-0.12, 0.05, 0.75, [0.16, 0.22, 0.02], 'darkMetal'),
      box(-0.14, 0.05, 0.77, [0.03, 0.06, 0.16], 'darkMetal'),
      box(-0.12, 0.05, 0.9, [0.04, 0.62, 0.36], 'black', { front: `screen${pick(2)}` }),
      box(0.15, 0.05, 0.75, [0.15, 0.42, 0.02], 'keyboard'),
      box(0.05, 0.52, 0.75, [0.3, 0.22, 0.04 + 0.03 * pick(3)], THINGS[pick(9)] ?? 'blue'),
      box(0.2, -0.45, 0.75, [0.28, 0.2, 0.01], 'paper'),
    ],
    panels: [],
    ellipsoids: [ball(0.1, -0.62, 0.8, [0.09, 0.09, 0.11], THINGS[pick(8)] ?? 'red')],
  };
}

export function chair(material: string): Piece {
  return {
    ...emptyPiece(),
    boxes: [
      box(0, 0, 0.44, [0.46, 0.46, 0.07], material),
      box(0.21, 0, 0.55, [0.06, 0.44, 0.45], material),
      box(0, 0, 0.08, [0.06, 0.06, 0.36], 'darkMetal'),
      box(0, 0, 0.03, [0.5, 0.08, 0.05], 'darkMetal'),
      box(0, 0, 0.031, [0.08, 0.5, 0.05], 'darkMetal'),
    ],
  };
}

export function table(length: number, width: number, height: number, material: string): Piece {
  const [x, y] = [length / 2 - 0.08, width / 2 - 0.08];
  const legs = [
    [x, y],
    [x, -y],
    [-x, y],
    [-x, -y],
  ].map(([a, b]) => box(a!, b!, 0, [0.07, 0.07, height - 0.04], 'darkMetal'));
  return { ...emptyPiece(), boxes: [box(0, 0, height - 0.04, [length, width, 0.04], material), ...legs] };
}

export function sofa(material: string, cushion: string): Piece {
  return {
    ...emptyPiece(),
    boxes: [
      box(0, 0, 0.08, [0.85, 1.9, 0.32], material),
      box(-0.33, 0, 0.4, [0.2, 1.9, 0.42], material),
      box(0, 0.86, 0.4, [0.85, 0.18, 0.2], material),
      box(0, -0.86, 0.4, [0.85, 0.18, 0.2], material),
      box(-0.18, 0.5, 0.42, [0.12, 0.4, 0.36], cushion),
      box(-0.18, -0.45, 0.42, [0.12, 0.4, 0.36], 'yellow'),
    ],
  };
}

export function plant(height: number): Piece {
  return {
    boxes: [box(0, 0, 0, [0.34, 0.34, 0.36], 'pot')],
    panels: [],
    ellipsoids: [
      ball(0, 0, 0.36 + height * 0.3, [0.5, 0.46, height * 0.62], 'leaves'),
      ball(0.1, 0.12, 0.36 + height * 0.62, [0.42, 0.4, height * 0.5], 'leavesLight'),
      ball(-0.12, -0.06, 0.36 + height * 0.72, [0.36, 0.4, height * 0.56], 'leaves'),
    ],
  };
}

/** Moving boxes on a pallet. */
export function pallet(seed: number): Piece {
  const pick = chooser(seed);
  const boxes = [box(0, 0, 0, [1.2, 0.8, 0.12], 'pallet')];
  for (const [x, y] of [
    [-0.3, -0.2],
    [0.3, -0.2],
    [-0.3, 0.2],
    [0.3, 0.2],
  ] as const) {
    const height = 0.3 + 0.05 * pick(4);
    boxes.push(box(x, y, 0.12, [0.55, 0.38, height], 'cardboard', { front: 'label', right: 'label' }));
    if (pick(3) > 0) boxes.push(box(x + 0.02, y, 0.12 + height, [0.45, 0.32, 0.28], 'cardboardDark'));
  }
  return { ...emptyPiece(), boxes };
}

export function cone(): Piece {
  return {
    boxes: [box(0, 0, 0, [0.34, 0.34, 0.04], 'black')],
    panels: [],
    ellipsoids: [
      ball(0, 0, 0.2, [0.28, 0.28, 0.44], 'orange'),
      ball(0, 0, 0.33, [0.2, 0.2, 0.2], 'cream'),
      ball(0, 0, 0.44, [0.13, 0.13, 0.34], 'orange'),
    ],
  };
}
