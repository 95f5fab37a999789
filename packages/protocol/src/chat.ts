/** Short lines between the operators of one robot. The robot passes them on and keeps the last ones. */
import * as z from 'zod/mini';
import { uint32Schema } from './identifiers.ts';
import { type NamedOperator, namedOperatorSchema } from './present-operators.ts';

/** Unicode code points. */
export const MAX_CHAT_LENGTH = 200;
/** So many lines the robot keeps for those who come later. */
export const KEPT_CHAT_LINES = 20;

/** Says a line to everybody who has a session with the robot. On the `session` channel. */
export interface Chat {
  type: 'chat';
  /** One line of 1 to 200 characters, not only spaces: no control characters, line ends, or marks that reverse text. */
  text: string;
}

/** A line that an operator has said. */
export interface ChatLine {
  /** Tells the message from others. */
  type: 'chatLine';
  /** Counts up by one for each line while the robot runs. */
  number: number;
  /** Who said it. */
  from: NamedOperator;
  /** Whether the operator that gets the message said it, in this session. */
  yours: boolean;
  /** What was said: text, never markup. */
  text: string;
  /** How long ago it was said, seconds. */
  agoS: number;
}

const lineSchema = z.string().check(
  z.maxLength(MAX_CHAT_LENGTH),
  // Cs: half of a surrogate pair. The last are those that change the direction of what stands around them.
  z.regex(/^[^\p{Cc}\p{Zl}\p{Zp}\p{Cs}\u202a-\u202e\u2066-\u2069]*$/u, 'must have no control characters'),
  z.regex(/[^\p{Z}\p{Cf}]/u, 'must say something'),
);

export const chatSchema = z.strictObject({
  type: z.literal('chat'),
  text: lineSchema,
}) satisfies z.ZodMiniType<Chat>;

export const chatLineSchema = z.strictObject({
  type: z.literal('chatLine'),
  number: uint32Schema,
  from: namedOperatorSchema,
  yours: z.boolean(),
  text: lineSchema,
  agoS: z.int().check(z.minimum(0), z.maximum(Number.MAX_SAFE_INTEGER)),
}) satisfies z.ZodMiniType<ChatLine>;
