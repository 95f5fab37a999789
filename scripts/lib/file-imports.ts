/** Finds the files that a TypeScript source imports by relative path, including types. Pure. */
import { posix } from 'node:path';

const RELATIVE = /(?:\bfrom|^\s*import|\bimport\()\s*['"](?<specifier>\.{1,2}\/[^'"\n]+)['"]/gm;
const COMMENTS = /\/\*[\s\S]*?\*\/|^\s*\/\/.*$/gm;

/** @returns the imported files, relative to the same root as `file`; does not check that they exist */
export function importedFiles(file: string, source: string): Set<string> {
  const text = source.replace(COMMENTS, '');
  const files = new Set<string>();
  for (const { groups } of text.matchAll(RELATIVE)) {
    files.add(posix.normalize(posix.join(posix.dirname(file), groups!.specifier!)));
  }
  return files;
}
