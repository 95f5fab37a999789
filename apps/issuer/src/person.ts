/** Who signed in, in the terms of a grant. */
import { createHash } from 'node:crypto';
import { MAX_SUBJECT_LENGTH } from '@farpoint/grants';
import { type Claims, claimTexts } from './rules.ts';

export interface Person {
  /** The same at each sign-in, and no other person's. */
  subject: string;
  /** For people. */
  name: string;
}

/** UTF-16 units of a name. */
const MAX_NAME = 64;

/**
 * @param issuer the provider, which has no `#` in its name (OpenID Connect Core 1.0, section 2)
 * @param sub the provider's name for the person
 */
export function personOf(issuer: string, sub: string, claims: Claims): Person {
  const candidates = ['name', 'preferred_username', 'email'].flatMap((each) => claimTexts(claims, each));
  const name = [...candidates, sub].map(shownName).find((each) => each !== '') ?? 'Operator';
  return { subject: subjectOf(issuer, sub), name };
}

/** Provider and person in one text. What is too long or unprintable for a grant is hashed. */
export function subjectOf(issuer: string, sub: string): string {
  const whole = `${issuer}#${sub}`;
  if (whole.length <= MAX_SUBJECT_LENGTH && /^[^\p{Cc}\p{Cs}]*$/u.test(whole)) return whole;
  return `sha256:${createHash('sha256')
    .update(JSON.stringify([issuer, sub]))
    .digest('base64url')}`;
}

/** Without characters that change how the text around it is shown. */
function shownName(text: string): string {
  const plain = text
    .replace(/\s+/gu, ' ')
    .replace(/[\p{Cc}\p{Cf}\p{Cs}]/gu, '')
    .trim();
  // Not half a surrogate pair.
  return plain
    .slice(0, MAX_NAME)
    .replace(/[\uD800-\uDBFF]$/, '')
    .trim();
}
