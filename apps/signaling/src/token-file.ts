import { robotIdSchema, tokenSchema } from '@farpoint/protocol';
import { type Document, isAlias, isMap, isScalar, isSeq, parseDocument } from 'yaml';
import type { TokenSet } from './access.ts';

/**
 * Reads tokens: a list (YAML, JSON, or one per line) of tokens valid for any id, or a mapping from ids to their token
 * or tokens. Lines that begin with # are comments. A token is taken as it is written: 00123 is not 123.
 *
 * @param bound ids of a mapping are robot ids and bind the token; otherwise they are names for people
 * @throws {Error} naming the entry at fault, but never the token
 */
export function parseTokens(content: string, bound: boolean): TokenSet {
  const file = parseDocument(content.replace(/^[ \t]*#.*$/gm, ''), { prettyErrors: false });
  if (file.errors.length > 0) throw new Error('is neither YAML nor JSON nor one token a line');
  const root = written(file.contents, file);
  const free: string[] = [];
  const byId = new Map<string, readonly string[]>();
  if (typeof root === 'string')
    free.push(
      ...root
        .trim()
        .split(/\s+/)
        .map((line, index) => checkToken(line, `line ${index + 1}`)),
    );
  else if (Array.isArray(root))
    free.push(...root.map((token, index) => checkToken(token, `entry ${index + 1}`)));
  else if (root instanceof Map) {
    for (const [id, entry] of root) {
      const tokens = (Array.isArray(entry) ? entry : [entry]).map((token) => checkToken(token, id));
      if (!bound) free.push(...tokens);
      else if (robotIdSchema.safeParse(id).success) byId.set(id, tokens);
      else throw new Error(`${JSON.stringify(id)} is not a robot id`);
    }
  }
  if (free.length === 0 && byId.size === 0) throw new Error('has no tokens');
  return { bound: byId, free };
}

/** The part of a file with its scalars as text, as they are written; `null` for what is empty. */
function written(node: unknown, file: Document.Parsed): unknown {
  if (isAlias(node)) {
    // Only of single tokens: lists of lists could grow without end.
    const named = node.resolve(file);
    return isScalar(named) ? written(named, file) : null;
  }
  if (isSeq(node)) return node.items.map((item) => written(item, file));
  if (isMap(node))
    return new Map(node.items.map(({ key, value }) => [String(written(key, file)), written(value, file)]));
  if (!isScalar(node) || node.value === null) return null;
  return typeof node.value === 'string' ? node.value : (node.source ?? String(node.value));
}

function checkToken(token: unknown, where: string): string {
  const parsed = tokenSchema.safeParse(token);
  if (!parsed.success) throw new Error(`${where}: a token is text of 1–4096 characters`);
  return parsed.data;
}
