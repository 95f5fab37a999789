/** Schemas of the issuer's own options. */
import { robotKeysSchema } from '@farpoint/grants';
import { isProtectedUrl } from '@farpoint/protocol';
import * as z from 'zod';
import { MAX_RULES, ruleSchema } from './rules.ts';

const ADDRESS =
  'must be an https address without a query (http on loopback only), e.g. https://teleop.example/';

/** An address where nobody on the way can read or change anything. */
export const addressSchema = z
  .string(ADDRESS)
  .max(512, ADDRESS)
  .refine((text) => isProtectedUrl(text) && !/[?#]/.test(text), ADDRESS);

/** YAML, or the same as JSON in a flag or variable. */
function structured<T>(schema: z.ZodType<T>, what: string): z.ZodType<T> {
  return z.preprocess((value, context) => {
    if (typeof value !== 'string') return value;
    try {
      return JSON.parse(value);
    } catch {
      context.addIssue({ code: 'custom', message: `must be ${what}, as JSON` });
      return z.NEVER;
    }
  }, schema) as z.ZodType<T>;
}

const RULES = 'a list of {claim, value, role, robots}';
export const rulesSchema = structured(
  z.array(ruleSchema, `must be ${RULES}`).max(MAX_RULES, `must have at most ${MAX_RULES} rules`),
  RULES,
);

/** Thumbprints by robot id. */
export const robotKeysOption = structured(
  z.unknown().transform((value, context) => {
    const keys = robotKeysSchema.safeParse(value);
    if (keys.success) return keys.data;
    context.addIssue({
      code: 'custom',
      message: 'must be thumbprints of robots’ keys by robot id, at most 32',
    });
    return z.NEVER;
  }),
  'thumbprints by robot id',
) as z.ZodType<Record<string, string>>;
