/** What the options leave open: missing ones, the key, and whether the largest grant is not too large. */
import { statSync } from 'node:fs';
import {
  GrantKeysError,
  issueGrant,
  MAX_GRANT_LENGTH,
  MAX_SUBJECT_LENGTH,
  parseSigningKey,
  type SigningKey,
} from '@farpoint/grants';
import { OptionsError, readTextFile, TextFileError } from '@farpoint/service';
import { type GrantTerms, grantFor } from './grant-for.ts';
import type { IssuerOptions } from './options.ts';
import type { Rule } from './rules.ts';

/** Options that must be given. */
export type Required = { url: string; provider: string; clientId: string };

/** @throws {OptionsError} naming each that is missing */
export function required(
  options: IssuerOptions,
  where: (key: keyof IssuerOptions & string) => string,
): Required {
  const { url, provider, clientId, pages, rules, scope } = options;
  const missing = [
    ...Object.entries({ url, provider, clientId }).flatMap(([key, value]) => (value === null ? [key] : [])),
    ...Object.entries({ pages, rules }).flatMap(([key, value]) => (value.length === 0 ? [key] : [])),
  ] as (keyof IssuerOptions & string)[];
  if (url === null || provider === null || clientId === null || missing.length > 0)
    throw new OptionsError(missing.map((key) => ({ where: where(key), detail: 'must be given' })));
  if (!scope.split(' ').includes('openid')) throw new OptionsError(where('scope'), 'must contain openid');
  if (url.length > MAX_SUBJECT_LENGTH)
    throw new OptionsError(where('url'), `must have at most ${MAX_SUBJECT_LENGTH} characters`);
  return { url, provider, clientId };
}

/**
 * @returns whether others than its owner may read the file, too
 * @throws {OptionsError} naming nothing of the key
 */
export async function readSigningKey(
  where: string,
  path: string,
): Promise<{ key: SigningKey; exposed: boolean }> {
  try {
    const key = await parseSigningKey(readTextFile(path));
    return { key, exposed: (statSync(path).mode & 0o077) !== 0 };
  } catch (error) {
    if (error instanceof GrantKeysError) throw new OptionsError(`${where}: ${path}`, error.message);
    if (error instanceof TextFileError) throw new OptionsError(where, error.message);
    throw error;
  }
}

/** Robots refuse grants beyond a length. @throws {OptionsError} for a rule whose grant would be longer */
export async function checkLengths(
  rules: readonly Rule[],
  terms: GrantTerms,
  key: SigningKey,
  where: (key: 'rules') => string,
): Promise<void> {
  const longest = { subject: 's'.repeat(MAX_SUBJECT_LENGTH), name: '\u{ffff}'.repeat(64) };
  const grantee = { key: 'k'.repeat(43), id: 'i'.repeat(16), nowS: 1e10 };
  for (const [index, rule] of rules.entries()) {
    const { length } = await issueGrant(grantFor(longest, rule, terms, grantee), key);
    if (length > MAX_GRANT_LENGTH)
      throw new OptionsError(
        where('rules'),
        `rule ${index + 1} makes grants of ${length} characters, and robots read ${MAX_GRANT_LENGTH}: use patterns for robots, or fewer robot keys`,
      );
  }
}
