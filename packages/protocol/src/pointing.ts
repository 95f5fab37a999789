/** A spot that an operator points at, and that the other operators of the robot see. */
import * as z from 'zod/mini';
import { uint32Schema } from './identifiers.ts';

/**
 * How long a spot is shown after it was last pointed at, ms. Chosen: long enough to turn to it, and short enough that it says what
 * is meant now. pointers.test.ts holds it.
 */
export const POINT_SHOWN_MS = 5000;

/** Farther from the world's origin no robot drives, metres. Chosen: it bounds what is drawn. */
const MOST_M = 100_000;
const metres = z.number().check(z.minimum(-MOST_M), z.maximum(MOST_M));
const spotSchema = z.strictObject({ x: metres, y: metres, z: metres });

/** A spot in the robot's world (REP-103: x forward, y left, z up), metres. */
export interface Spot {
  /** Forward, metres. */
  x: number;
  /** To the left, metres. */
  y: number;
  /** Up, metres. */
  z: number;
}

/** Points at a spot, for the other operators. On the `session` channel, at most ten times a second. */
export interface Point {
  type: 'point';
  /** The spot. */
  at: Spot;
}

/** Whether this operator may point. Sent after the welcome; robots that do not send it pass nothing on. */
export interface Pointing {
  type: 'pointing';
  /** Whether the robot passes on what this operator points at. */
  may: boolean;
}

/** Another operator points at a spot. It is shown for 5 s, or until the same operator points elsewhere. */
export interface Pointed {
  type: 'pointed';
  /** The number of the operator who points, in the robot's list. */
  by: number;
  /** The spot. */
  at: Spot;
}

export const pointSchema = z.strictObject({
  type: z.literal('point'),
  at: spotSchema,
}) satisfies z.ZodMiniType<Point>;

export const pointingSchema = z.strictObject({
  type: z.literal('pointing'),
  may: z.boolean(),
}) satisfies z.ZodMiniType<Pointing>;

export const pointedSchema = z.strictObject({
  type: z.literal('pointed'),
  by: uint32Schema,
  at: spotSchema,
}) satisfies z.ZodMiniType<Pointed>;
