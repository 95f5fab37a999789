/** Rewrites TypeScript's declarations for a tarball: no `.ts` addresses, no private packages, no schemas. */

const SPECIFIER = /(\bfrom '|\bimport\(['"])([^'"]+)(['"])/g;

export interface PublicDeclaration {
  text: string;
  /** Types that are made of a schema's: nobody outside can see what they hold. */
  opaque: string[];
}

/**
 * A declaration file as users of the package get it. Schemas are left out with the library that they are made of: the
 * types beside them say the same. Types that are made of a schema become `unknown`.
 *
 * @param nameOf the address of a package's declarations; the name itself where it stays
 * @throws {Error} where something else is made of a schema
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
    // A statement ends with the first line that is not indented and ends with a semicolon.
    if (inSchema && /^\S.*;$/.test(line)) inSchema = false;
  }
  const used = lines.find((line) => /\bz\.[A-Za-z]/.test(line));
  if (used !== undefined) throw new Error(`a public type needs the schema library: ${used.trim()}`);
  // Without an export it would be no module.
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
