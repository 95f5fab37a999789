/** What an operator can set about the headset. The browser keeps it; whatever it holds is checked here. */

/** How the view turns: in steps, steadily, or with the robot. */
/** From where the operator looks. */
export const HEADSET_VIEWS = ['first-person', 'over-shoulder', 'tabletop'] as const;
export type HeadsetView = (typeof HEADSET_VIEWS)[number];

export const TURNS = ['snap', 'smooth', 'robot'] as const;
export type Turn = (typeof TURNS)[number];

/** Seated: the eyes are where the robot's camera is. Standing: as high above the robot's floor as above one's own. */
export const POSTURES = ['seated', 'standing'] as const;
export type Posture = (typeof POSTURES)[number];

export const HANDS = ['right', 'left'] as const;
export type Hand = (typeof HANDS)[number];

export function otherHand(hand: Hand): Hand {
  return hand === 'right' ? 'left' : 'right';
}

export interface HeadsetSettings {
  readonly turn: Turn;
  /** Angle of a step, degrees. */
  readonly snapDegrees: number;
  /** How much of the view's edge is dark while it is turned: 0 (nothing) … 1. */
  readonly vignette: number;
  readonly posture: Posture;
  /** The hand whose grip and stick drive. The other hand turns the view and carries the panel. */
  readonly driveHand: Hand;
  /** The highest refresh rate of the display that is asked for, Hz. */
  readonly frameRate: number;
  /** How much coarser the edges of the picture are drawn: 0 (not at all) … 1. */
  readonly foveation: number;
  /** Share of the resolution that the headset recommends. */
  readonly resolution: number;
}

export const DEFAULT_HEADSET: HeadsetSettings = {
  turn: 'snap',
  snapDegrees: 30,
  vignette: 0.6,
  posture: 'seated',
  driveHand: 'right',
  frameRate: 90,
  foveation: 1,
  resolution: 1,
};

export const SNAP_DEGREES = { least: 5, most: 90 } as const;
export const FRAME_RATES = { least: 60, most: 240 } as const;
export const RESOLUTIONS = { least: 0.5, most: 2 } as const;

/** @param value from local storage or a form; what is not usable is replaced by its default */
export function parseHeadset(value: unknown): HeadsetSettings {
  const record = typeof value === 'object' && value !== null ? (value as Record<string, unknown>) : {};
  const { snapDegrees, vignette, frameRate, foveation, resolution } = DEFAULT_HEADSET;
  return {
    turn: oneOf(TURNS, record.turn) ?? DEFAULT_HEADSET.turn,
    snapDegrees: within(record.snapDegrees, SNAP_DEGREES.least, SNAP_DEGREES.most) ?? snapDegrees,
    vignette: within(record.vignette, 0, 1) ?? vignette,
    posture: oneOf(POSTURES, record.posture) ?? DEFAULT_HEADSET.posture,
    driveHand: oneOf(HANDS, record.driveHand) ?? DEFAULT_HEADSET.driveHand,
    frameRate: within(record.frameRate, FRAME_RATES.least, FRAME_RATES.most) ?? frameRate,
    foveation: within(record.foveation, 0, 1) ?? foveation,
    resolution: within(record.resolution, RESOLUTIONS.least, RESOLUTIONS.most) ?? resolution,
  };
}

function oneOf<Value extends string>(values: readonly Value[], value: unknown): Value | undefined {
  return values.find((candidate) => candidate === value);
}

function within(value: unknown, least: number, most: number): number | undefined {
  return typeof value === 'number' && value >= least && value <= most ? value : undefined;
}
