/** Who has a session with the robot. */
import * as z from 'zod/mini';
import { displayNameSchema, uint32Schema } from './identifiers.ts';

/** What an operator's grant lets it do. Everybody may latch the emergency stop. */
export const roles = [
  'watch', // see, and nothing that moves the robot
  'drive', // also take the lease and drive
  'supervise', // also take the lease from whoever has it, and release any emergency stop
] as const;
/**
 * What an operator's grant lets it do.
 *
 * @useDeclaredType
 */
export type Role = (typeof roles)[number];

/** More are never listed. */
export const MAX_LISTED_OPERATORS = 16;

/** An operator, as others know it. */
export interface NamedOperator {
  /** Names the operator's session; never used again while the robot runs. */
  number: number;
  /** The operator's name, by its grant. */
  name: string;
  /** The name is only what the operator calls itself: the robot asks for no grant, and nothing proves it. */
  claimed?: true | undefined;
}

/** An operator with a session. */
export interface PresentOperator extends NamedOperator {
  /** What the operator may do. */
  role: Role;
  /** Whether it holds the lease. */
  drives: boolean;
  /** Whether it is the one who gets this message. */
  you: boolean;
  /** Nothing is heard from it at present: its link is lost, or its page does not run. */
  away?: true | undefined;
}

/** Who has a session with the robot. Sent after the welcome and at every change, at most four times a second. */
export interface Operators {
  type: 'operators';
  /** The one who gets the message, then the driver, supervisors and others, each in the order in which they came. */
  operators: PresentOperator[];
  /** How many more there are than are listed; absent if none. */
  more?: number | undefined;
  /** How long the one who drives has driven, seconds; absent if nobody does, and from older robots. */
  drivesForS?: number | undefined;
}

const named = { number: uint32Schema, name: displayNameSchema, claimed: z.optional(z.literal(true)) };

export const namedOperatorSchema = z.strictObject(named) satisfies z.ZodMiniType<NamedOperator>;

export const operatorsSchema = z.strictObject({
  type: z.literal('operators'),
  operators: z
    .array(
      z.strictObject({
        ...named,
        role: z.enum(roles),
        drives: z.boolean(),
        you: z.boolean(),
        away: z.optional(z.literal(true)),
      }),
    )
    .check(z.maxLength(MAX_LISTED_OPERATORS)),
  more: z.optional(z.int().check(z.minimum(1), z.maximum(1_000_000))),
  drivesForS: z.optional(z.int().check(z.minimum(0), z.maximum(Number.MAX_SAFE_INTEGER))),
}) satisfies z.ZodMiniType<Operators>;
