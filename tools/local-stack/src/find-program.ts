import { existsSync } from 'node:fs';
import { delimiter, join } from 'node:path';

/**
 * Finds the first of these programs on PATH, else the first of the other places that exists.
 *
 * @returns its path, or `null`
 */
export function findProgram(names: readonly string[], otherPlaces: readonly string[] = []): string | null {
  const folders = (process.env.PATH ?? '').split(delimiter);
  const candidates = names.flatMap((name) => folders.map((folder) => join(folder, name)));
  return [...candidates, ...otherPlaces].find((path) => existsSync(path)) ?? null;
}
