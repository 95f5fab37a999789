/** Where the controls of a controller are, roughly, in its grip space: as every current headset's controllers have them. */
import type { Control } from '../../status/controller-label-words.ts';

export interface Place {
  readonly x: number;
  readonly y: number;
  readonly z: number;
}

/** Of a controller in the right hand, m: right, up, back. The left hand's is its mirror image. */
const RIGHT: Readonly<Record<Control, Place>> = {
  stick: { x: -0.007, y: 0.014, z: -0.044 },
  stickPress: { x: -0.007, y: 0.014, z: -0.044 },
  upper: { x: 0.009, y: 0.008, z: -0.052 },
  lower: { x: 0.008, y: 0.009, z: -0.036 },
  trigger: { x: 0, y: -0.022, z: -0.05 },
  grip: { x: -0.012, y: -0.014, z: -0.005 },
};

export function controlPlace(control: Control, hand: 'left' | 'right'): Place {
  const { x, y, z } = RIGHT[control];
  return { x: hand === 'right' ? x : -x, y, z };
}

/** Half the angle about the line of sight within which a controller counts as looked at. */
const LOOKED_AT_COS = Math.cos((20 * Math.PI) / 180);
/** Labels are shown for so long after the headset has been put on, or what the hands do has changed, ms. */
export const FIRST_MS = 20_000;

/** Whether labels are to be seen. @param cosine of the angle between the line of sight and the controller */
export function showsLabels(cosine: number, sinceMs: number): boolean {
  return sinceMs < FIRST_MS || cosine > LOOKED_AT_COS;
}
