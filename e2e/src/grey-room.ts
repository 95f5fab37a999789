/** A cloud with known heights: a grey floor with a pit, a box on it, and a beam over it. */
import type { Place } from './place.ts';

/** A cloud without a pose is shown 1 m above the floor. */
const EYE_M = 1;
const STEP_M = 0.03;

export const greyRoom = {
  box: { height: 0.5 },
  beam: { from: 1.4, to: 1.7 },
  pit: { depth: 0.4 },
} as const;

/** The cloud: x ahead, y to the left, z up, from the eye. @param stepM between points, metres */
export function greyRoomPlaces(stepM = STEP_M): Place[] {
  const { box, beam, pit } = greyRoom;
  const places: Place[] = [];
  const add = (x: number, y: number, height: number) => places.push([x, y, height - EYE_M]);
  const range = (from: number, to: number) =>
    Array.from({ length: Math.round((to - from) / stepM) }, (_, i) => from + i * stepM);
  for (const x of range(0.6, 5.4)) {
    for (const y of range(-1.8, 1.8)) {
      const isPit = x > 2.4 && x < 5.1 && y < -0.3 && y > -1.5;
      add(x, y, isPit ? -pit.depth : 0);
    }
  }
  for (const y of range(0.6, 1.4)) for (const height of range(0.05, box.height)) add(2, y, height);
  for (const x of range(2, 2.6)) for (const y of range(0.6, 1.4)) add(x, y, box.height);
  for (const y of range(-0.8, 0.8)) for (const height of range(beam.from, beam.to)) add(2.5, y, height);
  return places;
}
