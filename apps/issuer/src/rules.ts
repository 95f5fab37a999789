/** Rules: which people get which grant, by what the provider says of them. */
import { MAX_ROBOTS, matchesPattern, robotPatternSchema } from '@farpoint/grants';
import { roles } from '@farpoint/protocol';
import * as z from 'zod';

/** Rules of one file. Chosen: more than any organisation has groups of operators; each sign-in tries them in turn. */
export const MAX_RULES = 256;

export const ruleSchema = z.strictObject({
  /** A claim by name. Where there is no claim of this name, dots lead into objects: `realm_access.roles`. */
  claim: z.string('must be the name of a claim').min(1).max(256),
  /** In which each `*` stands for any characters or none. Of a list, one element must match. */
  value: z.string('must be text, in which * stands for anything').min(1).max(256),
  role: z.enum(roles, `must be one of ${roles.join(', ')}`),
  /** Ids, or patterns of them. */
  robots: z
    .array(robotPatternSchema, 'must be a list of robot ids, in which * stands for anything')
    .min(1, 'must name a robot')
    .max(MAX_ROBOTS, `must name at most ${MAX_ROBOTS} robots`),
});
export type Rule = z.infer<typeof ruleSchema>;

/** What a provider says of a person. */
export type Claims = Readonly<Record<string, unknown>>;

/** The first rule that matches; `null` if none does. */
export function ruleFor(rules: readonly Rule[], claims: Claims): Rule | null {
  return (
    rules.find((rule) => claimTexts(claims, rule.claim).some((text) => matchesPattern(rule.value, text))) ??
    null
  );
}

/**
 * A claim's value as texts: one for text, a number or a boolean, one for each element of a list, none for anything else.
 *
 * An `email` counts only if the provider says that it is verified. At some providers, people may claim any address.
 */
export function claimTexts(claims: Claims, name: string): string[] {
  if (name === 'email' && claims.email_verified !== true) return [];
  const value = own(claims, name) ?? name.split('.').reduce<unknown>(own, claims);
  return [value].flat().filter(isSimple).map(String);
}

function own(object: unknown, name: string): unknown {
  return typeof object === 'object' &&
    object !== null &&
    !Array.isArray(object) &&
    Object.hasOwn(object, name)
    ? (object as Record<string, unknown>)[name]
    : undefined;
}

function isSimple(value: unknown): value is string | number | boolean {
  return ['string', 'number', 'boolean'].includes(typeof value);
}
