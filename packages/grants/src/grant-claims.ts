/** What a grant says: the claims of a JWT (RFC 7519). */
import { displayNameSchema, handleSchema, robotIdSchema, roles } from '@farpoint/protocol';
import * as z from 'zod/mini';
import type { JwsKind } from './compact-jws.ts';
import { GrantRefusedError } from './refusal.ts';

export const GRANT_TYPE = 'farpoint-grant+jwt';
export const AUDIENCE = 'farpoint';
/** A longer list needs a pattern. */
export const MAX_ROBOTS = 32;
/** Characters; the compact form of the largest grant is shorter. */
export const MAX_GRANT_LENGTH = 4096;

export const GRANT: JwsKind = {
  what: 'grant',
  maxLength: MAX_GRANT_LENGTH,
  malformed: (detail) => new GrantRefusedError('grant-malformed', detail),
  forged: (detail) => new GrantRefusedError('grant-untrusted', detail),
};

/** A robot's id, in which each `*` stands for any characters or none. */
export const robotPatternSchema = z
  .string()
  .check(z.regex(/^[a-z0-9*][a-z0-9._*-]{0,63}$/, 'must be a robot id, in which * stands for anything'));

/** Seconds since 1970 (RFC 7519, NumericDate; whole ones). */
export const dateSchema = z.int().check(z.minimum(0), z.maximum(Number.MAX_SAFE_INTEGER));

/** A SHA-256 in base64url. */
export const sha256Schema = z.string().check(z.regex(/^[A-Za-z0-9_-]{43}$/));

/** Characters of an issuer or subject. */
export const MAX_SUBJECT_LENGTH = 128;
export const subjectSchema = z
  .string()
  .check(
    z.minLength(1),
    z.maxLength(MAX_SUBJECT_LENGTH),
    z.regex(/^[^\p{Cc}]*$/u, 'must have no control characters'),
  );

/** Thumbprints of robots' keys, by robot id. */
export const robotKeysSchema = z
  .record(robotIdSchema, sha256Schema)
  .check(z.refine((keys) => Object.keys(keys).length <= MAX_ROBOTS, `at most ${MAX_ROBOTS} robots`));

/** Unknown claims are ignored (RFC 7519 §4). */
export const grantClaimsSchema = z.object({
  iss: subjectSchema,
  /** Stays the same when a person gets another grant or another key. */
  sub: subjectSchema,
  /** For people. */
  name: displayNameSchema,
  aud: z.union([z.string(), z.array(z.string()).check(z.maxLength(16))]),
  iat: dateSchema,
  nbf: dateSchema,
  exp: dateSchema,
  /** Names this grant. */
  jti: handleSchema,
  robots: z.array(robotPatternSchema).check(z.minLength(1), z.maxLength(MAX_ROBOTS)),
  role: z.enum(roles),
  /** The operator's own key (RFC 7800), as its thumbprint (RFC 7638). */
  cnf: z.object({ jkt: sha256Schema }),
  /** For the operator: the thumbprints of robots' keys, by robot id. */
  robotKeys: z.optional(robotKeysSchema),
});
export type GrantClaims = z.infer<typeof grantClaimsSchema>;

/** Whether one of the patterns matches the whole id. */
export function coversRobot(patterns: readonly string[], robot: string): boolean {
  return patterns.some((pattern) => matchesPattern(pattern, robot));
}

/** Whether a pattern, in which each `*` stands for any characters or none, matches a whole text. In linear time. */
export function matchesPattern(pattern: string, text: string): boolean {
  const [first = '', ...rest] = pattern.split('*');
  const last = rest.pop();
  if (last === undefined) return pattern === text;
  if (!text.startsWith(first)) return false;
  let at = first.length;
  for (const part of rest) {
    const found = text.indexOf(part, at);
    if (found < 0) return false;
    at = found + part.length;
  }
  return text.length - last.length >= at && text.endsWith(last);
}
