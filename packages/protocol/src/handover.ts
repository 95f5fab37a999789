/** The drive goes from one operator to another: one asks or offers, the other agrees, and the robot decides. */
import * as z from 'zod/mini';
import { uint32Schema } from './identifiers.ts';
import { type NamedOperator, namedOperatorSchema } from './present-operators.ts';

/** How long an operator has to answer, ms on the robot's clock. Chosen: to read it and to look up; who drives waits no longer. */
export const HANDOVER_MS = 15_000;

/** Asks who drives for the drive. On the `session` channel. */
export interface DriveAsk {
  type: 'driveAsk';
}

/** Offers the drive to an operator. Only who drives can. On the `session` channel. */
export interface DriveOffer {
  type: 'driveOffer';
  /** The operator's number in the robot's list. */
  to: number;
}

/** Answers another's request or offer. On the `session` channel. */
export interface DriveAnswer {
  type: 'driveAnswer';
  /** The {@link Handover}'s. */
  id: number;
  accept: boolean;
}

/** Takes the operator's own request or offer back. On the `session` channel. */
export interface DriveWithdraw {
  type: 'driveWithdraw';
  /** The {@link Handover}'s. */
  id: number;
}

/** Who makes the first step. */
export const handoverKinds = [
  'ask', // who wants the drive: whoever drives answers
  'offer', // who drives: the one to whom it is offered answers
] as const;
/**
 * Who makes the first step.
 *
 * @useDeclaredType
 */
export type HandoverKind = (typeof handoverKinds)[number];

/** What has become of a request or an offer. */
export const handoverEnds = [
  'accepted', // the drive has changed hands
  'refused', // the other has refused
  'withdrawn', // whoever made it has taken it back
  'expired', // nobody has answered in time
  'driver-changed', // who drove at the time no longer does, or not under the same lease
  'left', // one of the two has left
  'estop', // STOP was pressed
] as const;
/**
 * What has become of a request or an offer.
 *
 * @useDeclaredType
 */
export type HandoverEnd = (typeof handoverEnds)[number];

/** A request for the drive, or an offer of it. Sent to both operators when it is made and when it ends. */
export interface Handover {
  type: 'handover';
  /** Names it in answers; never used again while the robot runs. */
  id: number;
  /** Who makes the first step. */
  kind: HandoverKind;
  /** Who made it. */
  from: NamedOperator;
  /** Who answers it. */
  to: NamedOperator;
  /** Whether the operator that gets the message made it; otherwise it is the one who answers. */
  yours: boolean;
  /** How long it can still be answered, ms; there while it can. */
  leftMs?: number | undefined;
  /** What has become of it; there once it can no longer be answered. */
  ended?: HandoverEnd | undefined;
}

/** What operators of one robot ask of each other, through the robot. */
export type DriveRequest = DriveAsk | DriveOffer | DriveAnswer | DriveWithdraw;

export const driveAskSchema = z.strictObject({
  type: z.literal('driveAsk'),
}) satisfies z.ZodMiniType<DriveAsk>;

export const driveOfferSchema = z.strictObject({
  type: z.literal('driveOffer'),
  to: uint32Schema,
}) satisfies z.ZodMiniType<DriveOffer>;

export const driveAnswerSchema = z.strictObject({
  type: z.literal('driveAnswer'),
  id: uint32Schema,
  accept: z.boolean(),
}) satisfies z.ZodMiniType<DriveAnswer>;

export const driveWithdrawSchema = z.strictObject({
  type: z.literal('driveWithdraw'),
  id: uint32Schema,
}) satisfies z.ZodMiniType<DriveWithdraw>;

export const handoverSchema = z
  .strictObject({
    type: z.literal('handover'),
    id: uint32Schema,
    kind: z.enum(handoverKinds),
    from: namedOperatorSchema,
    to: namedOperatorSchema,
    yours: z.boolean(),
    leftMs: z.optional(z.int().check(z.minimum(0), z.maximum(HANDOVER_MS))),
    ended: z.optional(z.enum(handoverEnds)),
  })
  .check(
    z.refine(({ leftMs, ended }) => (leftMs === undefined) !== (ended === undefined), {
      error: 'is given if and only if it has ended',
      path: ['ended'],
    }),
  ) satisfies z.ZodMiniType<Handover>;
