/**
 * The near field: in each direction around the robot, how far it is from its footprint's edge to the nearest thing, and
 * where the nearest floor is that no sensor has seen. On the `telemetry` channel, at most ten times a second.
 */
import * as z from 'zod/mini';

/** Of 5° each, counter-clockwise from straight ahead, which is the middle of sector 0. */
export const NEAR_SECTORS = 72;
/** Distances are rounded down to steps of this, metres. */
export const NEAR_STEP_M = 0.025;
/** Seven bits, and their highest value says that there is nothing. */
const NONE = 127;
const DROP = 128;
/** What is farther from the footprint's edge is not told, metres. */
export const NEAR_REACH_M = (NONE - 1) * NEAR_STEP_M;
/** Unseen floor is told up to here, metres from the footprint's edge. */
export const NEAR_UNSEEN_M = 80 * NEAR_STEP_M;
/** A sector has three bytes: four characters of base64. */
const [SECTOR_BYTES, TEXT] = [3, /^[A-Za-z0-9+/]{288}$/];

/** What the robot would meet. */
export const nearKinds = [
  'thing', // something stands there
  'drop', // the floor is missing
] as const;
/**
 * What the robot would meet.
 *
 * @useDeclaredType
 */
export type NearKind = (typeof nearKinds)[number];

/** What is known of one direction. Distances from the footprint's edge, metres. */
export interface NearSector {
  /** The nearest thing, or the nearest place without a floor; `null` if none is known within reach. */
  hit: {
    /** What it is. */
    kind: NearKind;
    /** How far it is. */
    metres: number;
  } | null;
  /** The nearest stretch in which some floor is unseen; `null` if there is none within 2 m. */
  unseen: {
    /** Where it begins. */
    fromM: number;
    /** Where it ends. */
    toM: number;
  } | null;
}

/** What stands around the robot, by its obstacle guard. */
export interface NearField {
  type: 'nearField';
  /** When it was made, robot's monotonic clock, ms. */
  timeMs: number;
  /** Three bytes for each sector, base64. The client's `link.session.near` has them read. */
  sectors: string;
}

/** The `sectors` of a message. @param sectors {@link NEAR_SECTORS} of them */
export function nearFieldText(sectors: readonly Readonly<NearSector>[]): string {
  let text = '';
  for (let i = 0; i < NEAR_SECTORS; i++) {
    const { hit = null, unseen = null } = sectors[i] ?? {};
    const steps = hit === null ? NONE : stepsOf(hit.metres);
    const drop = hit?.kind === 'drop' && steps !== NONE ? DROP : 0;
    const [from, to] = stretchOf(unseen);
    text += String.fromCharCode(steps + drop, from, to);
  }
  return btoa(text);
}

/** What a message says of each sector. */
export function nearSectors({ sectors }: Pick<NearField, 'sectors'>): NearSector[] {
  const bytes = atob(sectors);
  const at = (i: number) => bytes.charCodeAt(i);
  return Array.from({ length: NEAR_SECTORS }, (_, i) => {
    const [first, from, to] = [at(SECTOR_BYTES * i), at(SECTOR_BYTES * i + 1), at(SECTOR_BYTES * i + 2)];
    const steps = first & NONE;
    const kind = (first & DROP) === 0 ? 'thing' : 'drop';
    return {
      hit: steps === NONE ? null : { kind, metres: steps * NEAR_STEP_M },
      unseen: from === NONE ? null : { fromM: from * NEAR_STEP_M, toM: to * NEAR_STEP_M },
    };
  });
}

/** Rounded down: never farther than it is. */
function stepsOf(metres: number): number {
  const steps = Math.floor(metres / NEAR_STEP_M + 1e-6);
  return steps >= NONE || Number.isNaN(steps) ? NONE : Math.max(0, steps);
}

/** At least one step long: what is unseen is never left out. */
function stretchOf(unseen: NearSector['unseen']): readonly [from: number, to: number] {
  if (unseen === null) return [NONE, NONE];
  const from = stepsOf(unseen.fromM);
  if (from === NONE) return [NONE, NONE];
  return [from, Math.min(NONE, Math.max(from + 1, upTo(unseen.toM)))];
}

/** Rounded up. */
function upTo(metres: number): number {
  return Math.ceil(metres / NEAR_STEP_M - 1e-6);
}

/** A drop-off at no distance and a stretch without a length mean nothing. */
function areSectors(text: string): boolean {
  if (!TEXT.test(text)) return false;
  const bytes = atob(text);
  for (let i = 0; i < bytes.length; i += SECTOR_BYTES) {
    const [from, to] = [bytes.charCodeAt(i + 1), bytes.charCodeAt(i + 2)];
    if (bytes.charCodeAt(i) === NONE + DROP || to > NONE) return false;
    if (from >= to && !(from === NONE && to === NONE)) return false;
  }
  return true;
}

export const nearFieldSchema = z.strictObject({
  type: z.literal('nearField'),
  timeMs: z.number().check(z.minimum(0)),
  sectors: z.string().check(z.refine(areSectors, 'must be three bytes for each sector, base64')),
}) satisfies z.ZodMiniType<NearField>;
