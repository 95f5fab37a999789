/** What a robot does that drives back by itself after it has lost its operators. Part of the telemetry. */
import * as z from 'zod/mini';

/** What operators are told of. */
export const toldReturnPhases = [
  'announcing', // it says that it will drive back, and stands
  'returning', // it drives back along its track
  'ended', // it did, or gave up, and stands
] as const;
/**
 * What operators are told of.
 *
 * @useDeclaredType
 */
export type ToldReturnPhase = (typeof toldReturnPhases)[number];

/** Why a robot no longer drives back by itself. */
export const returnEnds = [
  'service-back', // an operator was heard again
  'estop', // the emergency stop was latched
  'track-end', // it is where its track begins
  'moved', // something else moved it while it waited
  'no-track', // it knows no way back
  'off-track', // it came too far from its track
  'odometry-silent', // it does not know where it is
  'sensor-silent', // it does not see where it goes
  'unseen', // no sensor sees the way back
  'blocked', // something is in the way, or the wheels do not move it
  'no-wheels', // nothing takes its velocities
  'too-long', // it was on its way for too long
] as const;
/**
 * Why a robot no longer drives back by itself.
 *
 * @useDeclaredType
 */
export type ReturnEnd = (typeof returnEnds)[number];

/** A robot that drives back by itself after it has lost its operators, or has done so since somebody last drove it. */
export interface ReturnState {
  phase: ToldReturnPhase;
  /** How far it has come back, m. */
  metres: number;
  /** Why it has ended; if and only if it has. */
  end?: ReturnEnd | undefined;
}

export const returnStateSchema = z
  .strictObject({
    phase: z.enum(toldReturnPhases),
    metres: z.number().check(z.minimum(0)),
    end: z.optional(z.enum(returnEnds)),
  })
  .check(
    z.refine(({ phase, end }) => (phase === 'ended') === (end !== undefined), {
      error: 'is given if and only if it has ended',
      path: ['end'],
    }),
  ) satisfies z.ZodMiniType<ReturnState>;
