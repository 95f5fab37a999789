import { robotIdSchema, tokenSchema } from '@farpoint/protocol';
import { parse } from 'yaml';
import type { TokenSet } from './access.ts';

/**
 * Reads tokens: a list (YAML, JSON, or one per line) of tokens valid for any id, or a mapping from ids to their token
 * or tokens. Lines that begin with # are comments.
 *
 * @param bound ids of a mapping are robot ids and bind the token; otherwise they are names for people
 * @throws {Error} naming the entry at fault, but never the token
 */
export function parseTokens(content: string, bound: boolean): TokenSet {
  let value: unknown;
  try {
    value = parse(content.replace(/^\s*#.*$/gm, ''));
  } catch {
    throw new Error('is neither YAML nor JSON nor one token a line');
  }
  const free: string[] = [];
  const byId = new Map<string, readonly string[]>();
  if (typeof value === 'string') free.push(...value.split(/\s+/));
  else if (typeof value === 'number') free.push(content.trim());
  else if (Array.isArray(value))
    free.push(...value.map((token, index) => checkToken(token, `entry ${index + 1}`)));
  else if (typeof value === 'object' && value !== null) {
    for (const [id, entry] of Object.entries(value)) {
      const tokens = (Array.isArray(entry) ? entry : [entry]).map((token) => checkToken(token, id));
      if (!bound) free.push(...tokens);
      else if (robotIdSchema.safeParse(id).success) byId.set(id, tokens);
      else throw new Error(`${JSON.stringify(id)} is not a robot id`);
    }
  }
  if (free.length === 0 && byId.size === 0) throw new Error('has no tokens');
  return { bound: byId, free };
}

function checkToken(value: unknown, where: string): string {
  const token = typeof value === 'number' ? String(value) : value;
  const parsed = tokenSchema.safeParse(token);
  if (!parsed.success) throw new Error(`${where}: a token is text of 1–4096 characters`);
  return parsed.data;
}
