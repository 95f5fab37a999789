/** Where the controls of a controller are, roughly, in its grip space: as every current headset's controllers have them. */
import type { Hand } from '../../ground/headset-settings.ts';
import type { Control } from '../../words/controller-label-words.ts';

interface Place {
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

export function controlPlace(control: Control, hand: Hand): Place {
  const { x, y, z } = RIGHT[control];
  return { x: hand === 'right' ? x : -x, y, z };
}

/** Half the angle about the line of sight within which a hand counts as held up before the eyes, radians. Chosen by eye. */
const LOOKED_AT_RAD = 0.45;
/** Labels are there for so long after the headset has been put on, ms. Chosen: long enough to read all and try some. */
export const FIRST_MS = 60_000;

export interface LabelSight {
  /** Cosine of the angle between the line of sight and the controller. */
  readonly cosine: number;
  /** Since the headset was put on, ms. */
  readonly sinceMs: number;
  readonly menuOpen: boolean;
  /** Whether they would cover the way ahead, the sign or the menu. */
  readonly inTheWay: boolean;
}

/** Whether the labels of a hand are to be seen. */
export function showsLabels({ cosine, sinceMs, menuOpen, inTheWay }: LabelSight): boolean {
  if (inTheWay) return false;
  return menuOpen || sinceMs < FIRST_MS || cosine > Math.cos(LOOKED_AT_RAD);
}
