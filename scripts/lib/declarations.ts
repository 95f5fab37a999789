/** Rewrites TypeScript declarations for a tarball: without `.ts` addresses, private packages and schemas. */

const SPECIFIER = /(\bfrom '|\bimport\(['"])([^'"]+)(['"])/g;

export interface PublicDeclaration {
  text: string;
  /** Types derived from a schema. Users of the package cannot see their contents. */
  opaque: string[];
}

/**
 * Makes the declaration file that users of the package get. Schemas are removed together with their library, because
 * the types beside them say the same. Types derived from a schema become `unknown`.
 *
 * @param nameOf the address of a package's declarations, or its unchanged name
 * @throws {Error} if anything else is derived from a schema
 */
export function publicDeclaration(text: string, nameOf: (name: string) => string): PublicDeclaration {
  const opaque: string[] = [];
  const lines: string[] = [];
  let inSchema = false;
  for (const line of text.split('\n')) {
    const type = /^(?:export )?(?:declare )?type (\w+) = z\./.exec(line)?.[1];
    if (type !== undefined) {
      opaque.push(type);
      lines.push(line.replace(/= .*/, '= unknown;'));
    }
    inSchema ||= type !== undefined || /^(export )?declare const \w+: z\./.test(line);
    if (!inSchema && !/ from 'zod\/mini';$/.test(line))
      lines.push(line.replace(/\bz\.core\.\$ZodType<[^<>]*>/g, 'unknown'));
    // A statement ends with the first unindented line that ends with a semicolon.
    if (inSchema && /^\S.*;$/.test(line)) inSchema = false;
  }
  const used = lines.find((line) => /\bz\.[A-Za-z]/.test(line));
  if (used !== undefined) throw new Error(`a public type needs the schema library: ${used.trim()}`);
  // Without an export the file would not be a module.
  if (!lines.some((line) => line.startsWith('export'))) lines.push('export {};');
  const address = (_: string, before: string, name: string, after: string) =>
    before + (name.startsWith('.') ? name.replace(/\.ts$/, '.js') : nameOf(name)) + after;
  return { text: lines.join('\n').replace(SPECIFIER, address), opaque };
}

/** The relative addresses that a declaration file imports from. */
export function references(text: string): string[] {
  return [...text.matchAll(SPECIFIER)]
    .map((match) => match[2] as string)
    .filter((name) => name.startsWith('.'));
}
