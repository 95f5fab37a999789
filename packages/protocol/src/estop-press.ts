/**
 * STOP on the `control` channel. An operator also sends it on the `session` channel, and repeats it here until the robot
 * acknowledges it: a lost packet or a stalled channel delays it by no more than the next repeat.
 */
import * as z from 'zod/mini';
import { uint32Schema } from './identifiers.ts';

/** Latches the emergency stop. Repeats of a press change nothing, also after the stop was released. */
export interface EstopPress {
  type: 'estop';
  /** Counts up by one for each press of this operator, wraps at 2³². Repeats have the number of the press. */
  press: number;
}

/** The robot's answer to each {@link EstopPress}: the press has latched its emergency stop. */
export interface EstopAck {
  type: 'estopAck';
  press: number;
}

export const estopPressSchema = z.strictObject({
  type: z.literal('estop'),
  press: uint32Schema,
}) satisfies z.ZodMiniType<EstopPress>;

export const estopAckSchema = z.strictObject({
  type: z.literal('estopAck'),
  press: uint32Schema,
}) satisfies z.ZodMiniType<EstopAck>;
