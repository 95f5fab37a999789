import { boxFaces, ellipsoidFaces, type Face } from './mesh.ts';
import type { Mover } from './world.ts';

/** A rigid part of a mover: rotates about its pivot as the mover walks. */
export interface Part {
  /** In the mover's frame: x forward, origin on the floor. */
  pivot: { x: number; y: number; z: number };
  /** Maximum angle of its swing about the y axis, radians; negative values swing the other way. */
  swing: number;
  /** Faces in the part's frame, with their plain colour; `smooth` ones store brightness in u. */
  faces: { face: Face; colour: number; smooth: boolean }[];
}

/** Metres per stride: one step with each leg. */
export const STRIDE = 1.3;

type Triple = readonly [number, number, number];

function round(at: Triple, size: Triple, colour: number): Part['faces'] {
  const [centre, extent] = [vector(at), vector(size)];
  return ellipsoidFaces(centre, extent, 8, 5).map((face) => ({ face, colour, smooth: true }));
}

function block(at: Triple, size: Triple, colour: number): Part['faces'] {
  return boxFaces(vector(at), vector(size)).map(([, face]) => ({ face, colour, smooth: false }));
}

function vector([x, y, z]: Triple): { x: number; y: number; z: number } {
  return { x, y, z };
}

const SKIN = 0xd9a582;
const HAIR = 0x3a2a1e;
const SHOE = 0x222226;

/** The mover's parts. */
export function figureOf(mover: Mover): Part[] {
  return mover.kind === 'person' ? person(mover) : cart(mover);
}

function person({ colour: shirt, second: trousers }: Mover): Part[] {
  const leg = (side: number): Part => ({
    pivot: { x: 0, y: side * 0.1, z: 0.88 },
    swing: side * 0.42,
    faces: [
      ...round([0, 0, -0.22], [0.19, 0.18, 0.56], trousers),
      ...round([0, 0, -0.58], [0.14, 0.14, 0.58], trousers),
      ...block([0.05, 0, -0.84], [0.27, 0.1, 0.08], SHOE),
    ],
  });
  const arm = (side: number): Part => ({
    pivot: { x: 0, y: side * 0.25, z: 1.42 },
    swing: side * -0.36,
    faces: [
      ...round([0, 0, -0.17], [0.13, 0.13, 0.42], shirt),
      ...round([0.02, 0, -0.42], [0.09, 0.09, 0.36], SKIN),
      ...round([0.03, 0, -0.61], [0.1, 0.06, 0.13], SKIN),
    ],
  });
  const trunk: Part = {
    pivot: { x: 0, y: 0, z: 0 },
    swing: 0,
    faces: [
      ...round([0, 0, 1.19], [0.27, 0.46, 0.68], shirt),
      ...round([0, 0, 0.9], [0.26, 0.37, 0.32], trousers),
      ...round([0, 0, 1.5], [0.12, 0.12, 0.16], SKIN),
      ...round([0.02, 0, 1.63], [0.2, 0.17, 0.26], SKIN),
      ...round([-0.02, 0, 1.68], [0.22, 0.19, 0.2], HAIR),
    ],
  };
  return [trunk, leg(1), leg(-1), arm(1), arm(-1)];
}

function cart({ colour, second: load }: Mover): Part[] {
  const wheels = [-0.32, 0.32].flatMap((x) =>
    [-0.25, 0.25].flatMap((y) => round([x, y, 0.07], [0.14, 0.05, 0.14], SHOE)),
  );
  return [
    {
      pivot: { x: 0, y: 0, z: 0 },
      swing: 0,
      faces: [
        ...wheels,
        ...block([0, 0, 0.18], [0.9, 0.6, 0.08], colour),
        ...block([-0.43, 0.26, 0.6], [0.04, 0.04, 0.76], SHOE),
        ...block([-0.43, -0.26, 0.6], [0.04, 0.04, 0.76], SHOE),
        ...block([-0.43, 0, 0.98], [0.04, 0.56, 0.04], SHOE),
        ...block([0.15, 0.1, 0.37], [0.45, 0.36, 0.3], load),
        ...block([-0.18, -0.1, 0.34], [0.3, 0.34, 0.24], 0x3f78b5),
        ...block([0.15, 0.08, 0.61], [0.3, 0.28, 0.18], 0xd6d0c2),
      ],
    },
  ];
}
