/** One axis of a device: where it rests, how far it goes, and which way counts as positive. Pure. */
import { DEFAULT_STICK_RESPONSE, shapeAxis } from './dead-zone.ts';

export interface AxisMap {
  /** Index of the device's axis. */
  readonly axis: number;
  /** What the axis reads at rest, −1…1. A pedal may rest at an end. */
  readonly centre: number;
  /** The least that it reads, −1…1. */
  readonly least: number;
  /** The most that it reads, −1…1. */
  readonly most: number;
  /** Whether readings below the centre count as positive. */
  readonly inverted: boolean;
  /** Share of the deflection that counts as centred. */
  readonly deadZone: number;
}

/**
 * Bounds of the dead zone, and what an axis has that nobody has set. Chosen: below the least a stick's noise drives, beyond the
 * most half of the stick does nothing; input-choices.test.ts holds them.
 */
export const DEAD_ZONES = { least: 0.02, most: 0.6, usual: DEFAULT_STICK_RESPONSE.deadZone } as const;
/**
 * An axis that moves less than this to one side counts as not moving there. Chosen: several times the noise of a worn stick,
 * which must not become full speed; axis-map.test.ts holds it.
 */
export const LEAST_RANGE = 0.15;
/**
 * How far from 0 an axis rests that counts only once it has been read at its rest. Chosen: no centred stick rests there, every
 * pedal does; axis-map.test.ts holds it.
 */
const RESTS_ELSEWHERE = 0.25;
/** How near its rest an axis counts as resting. Chosen: as much as {@link LEAST_RANGE}; axis-map.test.ts holds it. */
const AT_REST = LEAST_RANGE;
/**
 * A pedal that is the grip is held from the first share of its way on, and let go of at the second. Chosen: a foot that trembles
 * at the threshold neither starts nor stops the robot again and again; gamepad-input.test.ts holds them.
 */
export const GRIP_SHARES = { held: 0.5, open: 0.35 } as const;

export type Reading = number | null | undefined;

/** @returns how far the axis is from its rest, −1…1; 0 for whatever is not a finite number */
export function deflection(value: Reading, { centre, least, most, inverted }: AxisMap): number {
  if (typeof value !== 'number' || !Number.isFinite(value)) return 0;
  const off = value - centre;
  const range = off < 0 ? centre - least : most - centre;
  if (!(range >= LEAST_RANGE)) return 0;
  const share = Math.min(Math.max(off / range, -1), 1);
  return inverted ? -share : share;
}

/** The same with the dead zone and the curve applied. */
export function shapedDeflection(value: Reading, map: AxisMap): number {
  return shapeAxis(deflection(value, map), { deadZone: map.deadZone, expo: DEFAULT_STICK_RESPONSE.expo });
}

/**
 * Whether the axis has to be read at its rest before it counts: browsers report 0 for a pedal that nobody has touched
 * yet, which is half of its way.
 */
export function mustRestFirst({ centre }: AxisMap): boolean {
  return Math.abs(centre) > RESTS_ELSEWHERE;
}

export function isAtRest(value: Reading, { centre }: AxisMap): boolean {
  return typeof value === 'number' && Math.abs(value - centre) <= AT_REST;
}
